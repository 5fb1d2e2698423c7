/// Everything a portrait says, as one text of bytes: equal texts are equal portraits, bit for bit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "portraits/reader.h"

namespace portrait {

inline std::vector<double> values_of(const PortraitReader& portrait, Measure measure, std::uint64_t first,
                                     std::size_t count) {
  std::vector<double> values;
  portrait.read(measure, first, count, values);
  return values;
}

inline std::vector<Status> statuses_of(const PortraitReader& portrait, std::uint64_t first, std::size_t count) {
  std::vector<Status> statuses;
  portrait.read_statuses(first, count, statuses);
  return statuses;
}

template <typename Value>
std::string raw(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

inline std::string grid_content(const Grid& grid) {
  std::string all = grid.title + grid.text + std::string(to_string(grid.family.plant)) +
                    std::string(to_string(grid.family.prefilter)) + std::to_string(grid.family.n);
  all += raw(std::vector{grid.sampling.value_or(0), grid.horizon.dead_times, grid.horizon.automatic ? 1.0 : 0.0}) +
         raw(grid.measures);
  for (const Axis& axis : grid.axes) all += std::string(axis.name()) + raw(axis.values());
  for (const FixedParameter& fixed : grid.fixed)
    all += std::string(to_string(fixed.parameter)) + raw(std::vector{fixed.value});
  return all;
}

inline std::string value_content(PortraitReader& portrait) {
  std::string all = raw(statuses_of(portrait, 0, portrait.settings()));
  for (const Measure measure : portrait.grid().measures)
    all += raw(values_of(portrait, measure, 0, portrait.settings()));
  return all;
}

inline std::string content(const std::filesystem::path& path) {
  PortraitReader portrait(path);
  const Facts& facts = portrait.facts();
  return grid_content(portrait.grid()) + facts.program + facts.history + facts.date_created + facts.method +
         facts.compiler + facts.hdf5_version + facts.state + std::to_string(facts.threads) +
         std::to_string(facts.wall_seconds) + value_content(portrait);
}

}  // namespace portrait
