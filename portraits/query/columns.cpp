#include "portraits/query/columns.h"

namespace portrait {

std::string_view to_string(Quantity quantity) {
  return std::visit([](auto q) { return to_string(q); }, quantity);
}

std::optional<Quantity> quantity_named(std::string_view name) {
  if (const auto measure = measure_named(name)) return *measure;
  if (const auto parameter = parameter_named(name)) return *parameter;
  return std::nullopt;
}

std::vector<std::string_view> quantity_names() {
  std::vector<std::string_view> names;
  for (const Measure measure : all_measures()) names.push_back(to_string(measure));
  for (std::size_t i = 0; i < kParameterCount; ++i) names.push_back(to_string(static_cast<Parameter>(i)));
  return names;
}

std::size_t Columns::position(Quantity quantity) {
  if (const Measure* measure = std::get_if<Measure>(&quantity)) return static_cast<std::size_t>(*measure);
  return kMeasureCount + static_cast<std::size_t>(std::get<Parameter>(quantity));
}

}  // namespace portrait
