#include "tools/query_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "engine/loop/parameters.h"

namespace portrait::tools {
namespace {

Loop loop_of(const Grid& grid, const Found& found) { return {grid.family, found.setting}; }

std::vector<Quantity> named_in(const Constraint& constraint) {
  std::vector<Quantity> names;
  collect(constraint, names);
  return names;
}

}  // namespace

Json json_left_out(const LeftOut& left_out) {
  return {{"unstable", left_out.unstable},
          {"not_settled", left_out.not_settled},
          {"not_computed", left_out.not_computed},
          {"objective_missing", left_out.objective_missing}};
}

Json json_found(const Grid& grid, const QueryUnits& units, const Found& found) {
  Json json{{"settings", json_settings(loop_of(grid, found))},
            {"objective", json_number(found.objective)},
            {"measures", json_measures(found.measures, grid.measures)},
            {"status", to_string(found.status)}};
  if (units.plant)
    json["controller"] = json_controller(controller_for(loop_of(grid, found), *units.plant), grid.family);
  return json;
}

Json json_plant(const RealPlant& plant) {
  Json json{{"family", to_string(plant.family)}, {"K", plant.K}, {"Td", plant.Td}};
  if (lag_parameter(plant.family)) json[std::string(lag_name(plant.family))] = plant.T1;
  return json;
}

void add_units(Json& json, const Grid& grid, const Conditions& conditions) {
  const QueryUnits& units = conditions.units;
  json["units"] = units.plant ? "real" : "normalised";
  json["steps"] = {{"w", units.steps.w}, {"d", units.steps.d}};
  if (units.plant) json["plant"] = json_plant(*units.plant);
  Json list = Json::array();
  for (const Constraint& constraint : conditions.where) {
    Json names = Json::object();
    for (const Quantity quantity : named_in(constraint))
      names[std::string(to_string(quantity))] = unit_text(quantity, units, grid);
    list.push_back({{"constraint", constraint.text()}, {"units", names}});
  }
  json["constraints"] = list;
}

std::string units_text(const Grid& grid, const Conditions& conditions) {
  std::size_t width = 0;
  for (const Constraint& constraint : conditions.where) width = std::max(width, constraint.text().size());
  std::string text;
  for (const Constraint& constraint : conditions.where) {
    std::string first = constraint.text();
    for (const Quantity quantity : named_in(constraint)) {
      text += fmt::format("  {:<{}}   {}: {}\n", first, width, to_string(quantity),
                          unit_text(quantity, conditions.units, grid));
      first.clear();
    }
  }
  return text;
}

std::string setting_text(const Grid& grid, const Found& found) {
  return portrait::setting_text(loop_of(grid, found));
}

std::string unit_note(const QueryUnits& units) {
  const StepSizes& steps = units.steps;
  const bool unit_steps = steps.w == 1 && steps.d == 1;
  return fmt::format("{}{}", units.plant ? "real units" : "normalised",
                     unit_steps && !units.plant ? ""
                     : unit_steps
                         ? ", unit steps"
                         : fmt::format(", steps w = {}, d = {}", number_text(steps.w), number_text(steps.d)));
}

std::string found_text(const Grid& grid, const QueryUnits& units, const Found& found) {
  const Loop loop = loop_of(grid, found);
  std::string text;
  if (units.plant) {
    text += fmt::format("\ncontroller for {}\n", plant_text(*units.plant));
    text += controller_text(controller_for(loop, *units.plant), loop.family);
  }
  return text + "\n" + measures_table(found.measures, grid.measures, unit_note(units));
}

std::string csv_text(const Grid& grid, const std::vector<Found>& rows) {
  std::string text;
  for (const Parameter p : parameters_of(grid.family)) text += fmt::format("{},", to_string(p));
  text += "objective,status";
  for (const Measure m : grid.measures) text += fmt::format(",{}", to_string(m));
  text += "\n";
  for (const Found& found : rows) {
    for (const Parameter p : parameters_of(grid.family)) text += number_text(get(found.setting, p)) + ",";
    text += fmt::format("{},{}", number_text(found.objective), to_string(found.status));
    for (const Measure m : grid.measures) text += fmt::format(",{}", number_text(found.measures[m]));
    text += "\n";
  }
  return text;
}

}  // namespace portrait::tools
