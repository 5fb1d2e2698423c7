#include "grids/parameter_entries.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "grids/axis_entry.h"
#include "grids/validity.h"

namespace portrait {
namespace {

std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kParameterCount; ++i) names.push_back(to_string(static_cast<Parameter>(i)));
  return names;
}

/// Why a loop of this family has no such parameter. REQUIRES: it has none.
std::string why_not(Parameter parameter, const LoopFamily& family) {
  if (const auto place = gain_place(parameter)) {
    PORTRAIT_CHECK(!has_gains(family));
    return fmt::format("\"{}\" is a gain: all of them together take the place of kappa, tau_i and delta",
                       to_string(parameter));
  }
  switch (parameter) {
    case Parameter::kappa:
    case Parameter::tau_i:
    case Parameter::delta:
    case Parameter::tau_d:
      return fmt::format("\"{}\" has no place beside gains K_-1, K_0, ...: give one or the other",
                         to_string(parameter));
    case Parameter::tau_j:
      return fmt::format("\"tau_j\" belongs to plant \"jotd\", not to \"{}\"", to_string(family.plant));
    case Parameter::tau_1:
      return fmt::format("\"tau_1\" belongs to plant \"fotd\", not to \"{}\"", to_string(family.plant));
    case Parameter::tau_f:
      return "\"tau_f\" belongs to a filter: it needs n >= 1 (n is 0)";
    default:
      return fmt::format("with prefilter = \"{}\" \"{}\" can only be 0", to_string(family.prefilter),
                         to_string(parameter));
  }
}

/// b and c may stand at 0 where they do not apply, so that a grid file can keep them when its prefilter changes.
bool is_idle(const Entry& entry, Parameter parameter, const LoopFamily& family) {
  if (applies(parameter, family)) return false;
  const bool may_be_zero = parameter == Parameter::b || parameter == Parameter::c;
  if (may_be_zero && is_number(entry.value) && number_in(entry.key, entry.value) == 0) return true;
  throw InputError(entry.place, why_not(parameter, family));
}

void read_entry(const Entry& entry, Grid& grid) {
  const Parameter parameter = parameter_named(entry.key).value();
  if (is_idle(entry, parameter, grid.family)) return;
  const auto& content = entry.value.content;
  if (std::holds_alternative<Value::List>(content) || std::holds_alternative<Value::Table>(content))
    grid.axes.push_back(axis_in(parameter, entry.value));
  else if (is_number(entry.value))
    grid.fixed.push_back({parameter, number_in(entry.key, entry.value)});
  else
    throw_wrong_kind(entry.key, entry.value, "a number, a list of numbers or a table {from, to, step or count}");
}

void need_parameters(const Value& parameters, const LoopFamily& family) {
  if (has_gains(family)) {
    need(parameters, "K_-1", "the integral gain, 0 for none");
    need(parameters, "K_0", "the proportional gain");
  } else {
    need(parameters, "kappa", "the controller's gain");
    need(parameters, "tau_i", "write inf for no integral action");
  }
  if (family.plant == Plant::fotd) need(parameters, "tau_1", "plant \"fotd\" needs it");
  if (family.plant == Plant::jotd) need(parameters, "tau_j", "plant \"jotd\" needs it");
  if (family.n >= 1) need(parameters, "tau_f", "n >= 1 needs it");
}

void refuse_both_derivatives(const Value::Table& table) {
  const Entry* delta = find(table, "delta");
  const Entry* tau_d = find(table, "tau_d");
  if (!delta || !tau_d) return;
  throw InputError((delta < tau_d ? tau_d : delta)->place,  // the later one
                   "\"delta\" and \"tau_d\" say the same, delta = kappa tau_d: give one of the two");
}

/// Every parameter of the family that the file leaves out is 0; what may not be left out has been asked for before.
void complete_fixed(const Value::Table& table, Grid& grid) {
  for (const Parameter parameter : parameters_of(grid.family)) {
    if (has_gains(grid.family) && parameter == Parameter::tau_d) continue;
    const bool said_otherwise =
        parameter == Parameter::tau_d || (parameter == Parameter::delta && find(table, "tau_d"));
    if (!said_otherwise && !find(table, to_string(parameter))) grid.fixed.push_back({parameter, 0});
  }
  std::sort(grid.fixed.begin(), grid.fixed.end(),
            [](const FixedParameter& a, const FixedParameter& b) { return a.parameter < b.parameter; });
}

void refuse_too_many(const Value& parameters, const Grid& grid) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  std::uint64_t count = 1;
  double about = 1;
  for (const Axis& axis : grid.axes) {
    about *= static_cast<double>(axis.size());
    count = count > kMost / axis.size() ? kMost + 1 : count * axis.size();
  }
  if (count > kMost)
    throw InputError(parameters.place,
                     fmt::format("the grid has {:.3g} settings: it must have fewer than 2^63", about));
}

void refuse_invalid(const Value& parameters, const Grid& grid) {
  const auto invalid = find_invalid(grid);
  if (!invalid) return;
  const Entry* entry = find(std::get<Value::Table>(parameters.content), to_string(invalid->culprit));
  PORTRAIT_CHECK(entry != nullptr);  // what the file leaves out is 0, which offends nobody
  throw InputError(entry->place, invalid->reason);
}

}  // namespace

void read_parameters(const Value& parameters, Grid& grid) {
  const Value::Table& table = table_in("parameters", parameters);
  allow_only(table, parameter_names());
  refuse_both_derivatives(table);
  for (const Entry& entry : table) read_entry(entry, grid);
  need_parameters(parameters, grid.family);
  complete_fixed(table, grid);
  refuse_too_many(parameters, grid);
  refuse_invalid(parameters, grid);
}

}  // namespace portrait
