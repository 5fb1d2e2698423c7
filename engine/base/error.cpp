#include "engine/base/error.h"

#include <fmt/format.h>

namespace portrait {

std::string to_string(const Place& place) {
  if (place.line == 0) return place.source;
  if (place.column == 0) return fmt::format("{}:{}", place.source, place.line);
  return fmt::format("{}:{}:{}", place.source, place.line, place.column);
}

}  // namespace portrait
