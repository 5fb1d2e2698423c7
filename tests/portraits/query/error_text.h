/// The whole message of the InputError that a call throws.
#pragma once

#include <string>

#include "engine/base/error.h"

namespace portrait {

template <typename Call>
std::string error_text(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

}  // namespace portrait
