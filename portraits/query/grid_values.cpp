#include "portraits/query/grid_values.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {

bool same_number(double a, double b) {
  if (a == b) return true;
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= kSameWithin * std::max(std::abs(a), std::abs(b));
}

std::optional<std::size_t> index_of_value(const std::vector<double>& values, double wanted) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!same_number(values[i], wanted)) continue;
    if (!nearest || std::abs(values[i] - wanted) < std::abs(values[*nearest] - wanted)) nearest = i;
  }
  return nearest;
}

std::string nearest_values(const std::vector<double>& values, double wanted) {
  const auto above = std::lower_bound(values.begin(), values.end(), wanted);
  if (above == values.begin()) return number_text(values.front());
  if (above == values.end()) return number_text(values.back());
  return fmt::format("{} and {}", number_text(*(above - 1)), number_text(*above));
}

}  // namespace portrait
