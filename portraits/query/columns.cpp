#include "portraits/query/columns.h"

#include <algorithm>

namespace portrait {

std::string_view to_string(Quantity quantity) {
  return std::visit([](auto q) { return to_string(q); }, quantity);
}

std::optional<Quantity> quantity_named(std::string_view name) {
  if (const auto measure = measure_named(name)) return *measure;
  if (const auto parameter = parameter_named(name)) return *parameter;
  const auto value = std::find(kControllerValueNames.begin(), kControllerValueNames.end(), name);
  if (value != kControllerValueNames.end())
    return static_cast<ControllerValue>(value - kControllerValueNames.begin());
  return std::nullopt;
}

std::vector<std::string_view> quantity_names() {
  std::vector<std::string_view> names;
  for (const Measure measure : all_measures()) names.push_back(to_string(measure));
  for (std::size_t i = 0; i < kParameterCount; ++i) names.push_back(to_string(static_cast<Parameter>(i)));
  names.insert(names.end(), kControllerValueNames.begin(), kControllerValueNames.end());
  return names;
}

std::size_t position(Quantity quantity) {
  if (const Measure* measure = std::get_if<Measure>(&quantity)) return static_cast<std::size_t>(*measure);
  if (const Parameter* parameter = std::get_if<Parameter>(&quantity))
    return kMeasureCount + static_cast<std::size_t>(*parameter);
  return kMeasureCount + kParameterCount + static_cast<std::size_t>(std::get<ControllerValue>(quantity));
}

}  // namespace portrait
