/// Portraits of a few settings and questions about them, for tests with numbers worked out by hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "portraits/query/query.h"
#include "tests/portraits/query/memory_source.h"

namespace portrait {

/// kappa 0.1, 0.2, ... along one axis, delta 0.5, tau_i 8.
inline Grid line(std::uint64_t settings) {
  Grid grid;
  grid.family = {Plant::dipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::TV2_uw};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.1 * static_cast<double>(settings), settings)};
  grid.fixed = {{Parameter::delta, 0.5}, {Parameter::tau_i, 8}};
  return grid;
}

/// Five settings on the line, IAE_d 10, 20, ...
inline MemorySource five(std::vector<double> IAE_w, std::vector<double> TV2_uw) {
  MemorySource source(line(5));
  source.set(Measure::IAE_w, std::move(IAE_w));
  source.set(Measure::TV2_uw, std::move(TV2_uw));
  source.set(Measure::IAE_d, {10, 20, 30, 40, 50});
  return source;
}

inline Question question(const std::string& minimize, const std::vector<std::string>& where = {},
                         std::size_t top = 1) {
  Question asked{.minimize = parse_expression({"--minimize", minimize}), .conditions = {}, .top = top};
  for (const std::string& text : where) asked.conditions.where.push_back(parse_constraint({"--where", text}));
  return asked;
}

inline std::vector<std::uint64_t> numbers(const Answer& answer) {
  std::vector<std::uint64_t> found;
  for (const Found& one : answer.top) found.push_back(one.number);
  return found;
}

using Numbers = std::vector<std::uint64_t>;

}  // namespace portrait
