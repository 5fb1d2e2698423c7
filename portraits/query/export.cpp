#include "portraits/query/export.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/admission.h"
#include "portraits/query/grid_values.h"

namespace portrait {
namespace {

std::vector<Quantity> used_by(const Conditions& conditions) {
  std::vector<Quantity> used;
  for (const Constraint& constraint : conditions.where) collect(constraint, used);
  return used;
}

std::string meaning_of(Quantity quantity) {
  if (const Measure* measure = std::get_if<Measure>(&quantity))
    return fmt::format("{}: {}", info(*measure).long_name, info(*measure).definition);
  if (const Parameter* parameter = std::get_if<Parameter>(&quantity)) return std::string(info(*parameter).long_name);
  return "of the controller Kc (1 + 1/(Ti s) + TD s), Ki = Kc/Ti, Kd = Kc TD, filter 1/(Tf s + 1)^n";
}

}  // namespace

Export::Export(const ColumnSource& source, const ExportRequest& request)
    : source_(source), request_(request), fixed_(source.grid().axes.size()) {
  const Grid& grid = source.grid();
  require_answerable(request.conditions, grid);
  for (const auto& [parameter, value] : request.slice) fix(parameter, value);
  if (const std::optional<double> lag = slice_of(request.conditions.units, grid))
    fix(lag_parameter(grid.family.plant).value(), *lag);
  add_columns();
}

void Export::fix(Parameter parameter, double value) {
  const std::vector<Axis>& axes = source_.grid().axes;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (axes[k].parameter() != parameter) continue;
    const std::vector<double> values = axes[k].values();
    const auto index = index_of_value(values, value);
    if (!index)
      throw InputError(fmt::format("the axis {} has no value {} (nearest: {})", axes[k].name(), number_text(value),
                                   nearest_values(values, value)));
    fixed_[k] = *index;
    return;
  }
  std::vector<std::string_view> names;
  for (const Axis& axis : axes) names.push_back(axis.name());
  throw InputError(fmt::format("{} is no axis of the portrait{}", to_string(parameter),
                               suggestion(to_string(parameter), names)));
}

void Export::add_columns() {
  const Grid& grid = source_.grid();
  const QueryUnits& units = request_.conditions.units;
  const auto add = [&](Quantity quantity) {
    quantities_.push_back(quantity);
    columns_.push_back({std::string(to_string(quantity)), unit_text(quantity, units, grid), meaning_of(quantity)});
  };
  for (const Axis& axis : grid.axes) add(axis.parameter());
  if (units.plant)
    for (const ControllerValue value : {ControllerValue::Kc, ControllerValue::Ti, ControllerValue::TD,
                                        ControllerValue::Ki, ControllerValue::Kd, ControllerValue::Tf})
      if (value != ControllerValue::Tf || grid.family.n > 0) add(value);
  quantities_.push_back(std::nullopt);
  columns_.push_back({"status", "", "outcome of the setting", true});
  for (const Measure measure : request_.measures) add(measure);
}

std::vector<Parameter> Export::free_axes() const {
  std::vector<Parameter> axes;
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    if (!fixed_[k]) axes.push_back(source_.grid().axes[k].parameter());
  return axes;
}

std::vector<std::uint64_t> Export::shape() const {
  std::vector<std::uint64_t> sizes;
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    if (!fixed_[k]) sizes.push_back(source_.grid().axes[k].size());
  return sizes;
}

/// Places in a box, row-major, of the settings in the slice: axis by axis, as Overlap does it.
std::vector<std::size_t> Export::positions_in(const Box& box) const {
  std::vector<std::size_t> places = {0};
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    std::vector<std::size_t> next;
    const std::uint64_t first = fixed_[k] ? *fixed_[k] : box.start[k];
    const std::uint64_t end = fixed_[k] ? first + 1 : box.start[k] + box.extent[k];
    if (first < box.start[k] || end > box.start[k] + box.extent[k]) return {};
    for (const std::size_t place : places)
      for (std::uint64_t i = first; i < end; ++i) next.push_back(place * box.extent[k] + (i - box.start[k]));
    places = std::move(next);
  }
  return places;
}

std::uint64_t Export::for_each(const std::function<void(const TableRows&)>& use) const {
  const Conditions& conditions = request_.conditions;
  const Sheet sheet(source_, conditions.units, used_by(conditions), conditions.include_not_settled);
  const Admission admission(sheet, conditions.where);
  TilePage page(sheet, source_);
  Counted counted;
  std::uint64_t rows = 0;
  std::vector<std::size_t> admissible, chosen;
  for (std::uint64_t tile = 0; tile < sheet.rows().tile_count(); ++tile) {
    chosen = positions_in(sheet.rows().box(tile));
    if (chosen.empty()) continue;
    if (!conditions.where.empty()) {
      Admission::Glance glance;
      if (!admission.glance(tile, counted, glance) || !glance.possible) continue;
      admission.choose(tile, glance, page, counted, admissible);
      std::erase_if(chosen, [&](std::size_t i) { return !std::binary_search(admissible.begin(), admissible.end(), i); });
      if (chosen.empty()) continue;
    }
    use(rows_at(sheet, sheet.rows().range(tile), chosen));
    rows += chosen.size();
  }
  return rows;
}

TableRows Export::rows_at(const Sheet& sheet, SettingRange range, const std::vector<std::size_t>& chosen) const {
  TableRows rows{std::vector<std::vector<double>>(columns_.size()), chosen.size()};
  std::vector<double> values;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    read(sheet, c, range, values);
    for (const std::size_t i : chosen) rows.values[c].push_back(values[i]);
  }
  return rows;
}

void Export::read(const Sheet& sheet, std::size_t column, SettingRange range, std::vector<double>& values) const {
  const std::optional<Quantity>& quantity = quantities_[column];
  if (!quantity) {
    std::vector<Status> statuses;
    source_.read_statuses(range.first, range.count, statuses);
    values.assign(statuses.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(statuses[i]);
  } else if (const Measure* measure = std::get_if<Measure>(&*quantity)) {
    source_.read(*measure, range.first, range.count, values);
    for (double& value : values) value *= sheet.factor(*measure);
  } else if (const Parameter* parameter = std::get_if<Parameter>(&*quantity)) {
    sheet.parameters().read(*parameter, range.first, range.count, values);
  } else {
    values.resize(range.count);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Setting setting = setting_at(source_.grid(), range.first + i);
      values[i] = controller_value<double>(std::get<ControllerValue>(*quantity), *sheet.units().plant,
                                           [&](Parameter p) { return get(setting, p); });
    }
  }
}

double Export::value_of(std::size_t column, const Found& found) const {
  const std::optional<Quantity>& quantity = quantities_[column];
  if (!quantity) return static_cast<double>(found.status);
  if (const Measure* measure = std::get_if<Measure>(&*quantity)) return found.measures[*measure];
  // Axes come first: their own values, which for tau_d are not just those of the setting.
  if (std::holds_alternative<Parameter>(*quantity))
    return source_.grid().axes[column][coordinates(source_.grid(), found.number)[column]];
  return controller_value<double>(std::get<ControllerValue>(*quantity), *request_.conditions.units.plant,
                                  [&](Parameter p) { return get(found.setting, p); });
}

TableRows Export::rows_of(const std::vector<Found>& found) const {
  TableRows rows{std::vector<std::vector<double>>(columns_.size()), found.size()};
  for (const Found& one : found)
    for (std::size_t c = 0; c < columns_.size(); ++c) rows.values[c].push_back(value_of(c, one));
  return rows;
}

}  // namespace portrait
