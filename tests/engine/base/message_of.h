/// What an action says when it throws.
#pragma once

#include <exception>
#include <string>

namespace portrait {

/// Any other exception than `Thrown` passes through.
template <typename Thrown = std::exception, typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Thrown& thrown) {
    return thrown.what();
  }
  return "nothing was thrown";
}

}  // namespace portrait
