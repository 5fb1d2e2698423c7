#include "portraits/query/sheet.h"

#include <algorithm>

#include "engine/base/check.h"

namespace portrait {
namespace {

/// What a value of the controller is computed from.
std::vector<Parameter> parameters_behind(ControllerValue value) {
  switch (value) {
    case ControllerValue::Kc:
      return {Parameter::kappa};
    case ControllerValue::Ti:
      return {Parameter::tau_i};
    case ControllerValue::TD:
      return {Parameter::tau_d};
    case ControllerValue::Ki:
      return {Parameter::kappa, Parameter::tau_i};
    case ControllerValue::Kd:
      return {Parameter::delta};
    case ControllerValue::Tf:
      return {Parameter::tau_f};
  }
  return {};
}

}  // namespace

Sheet::Sheet(const ColumnSource& source, const QueryUnits& units, const std::vector<Quantity>& used,
             bool include_not_settled)
    : source_(source),
      units_(units),
      include_not_settled_(include_not_settled),
      used_(used),
      rows_(source.grid()),
      parameters_(source.grid()),
      slice_(slice_of(units, source.grid())),
      status_counts_(source.tile_status_counts()) {
  for (const Measure measure : all_measures())
    factors_[static_cast<std::size_t>(measure)] = portrait::factor(measure, units);
  for (const Quantity quantity : used)
    if (const Measure* measure = std::get_if<Measure>(&quantity))
      ranges_[static_cast<std::size_t>(*measure)] = source.tile_ranges(*measure);
}

Outlook Sheet::in_slice(std::uint64_t tile) const {
  if (!slice_) return Outlook::always;
  const SettingRange range = rows_.range(tile);
  const Interval lag = parameters_.bound(sliced_parameter(), range.first, range.count);
  if (lag.low > *slice_ || lag.high < *slice_) return Outlook::never;
  return lag.low == lag.high ? Outlook::always : Outlook::maybe;
}

std::uint64_t Sheet::most_eligible(std::uint64_t tile) const {
  if (status_counts_.empty()) return rows_.range(tile).count;
  const auto of = [&](Status status) { return status_counts_[tile][static_cast<std::size_t>(status)]; };
  return of(Status::settled) + (include_not_settled_ ? of(Status::not_settled) : 0);
}

/// Unstable settings are NaN in all measures and are never asked: as many NaN say nothing of the others.
Interval Sheet::bound_of(Measure measure, std::uint64_t tile) const {
  const std::vector<TileRange>& ranges = ranges_[static_cast<std::size_t>(measure)];
  if (ranges.empty()) return {};
  const TileRange& range = ranges[tile];
  const StatusCounts* counts = status_counts(tile);
  const std::uint64_t unstable = counts ? (*counts)[static_cast<std::size_t>(Status::unstable)] : 0;
  if (!(range.least <= range.greatest)) return Interval::none();
  Interval scaled = Interval{range.least, range.greatest, false} * Interval::of(factor(measure));
  scaled.may_be_nan |= range.missing > unstable;
  return scaled;
}

Interval Sheet::bound_of(ControllerValue value, std::uint64_t tile) const {
  return controller_value<Interval>(value, *units_.plant,
                                    [&](Parameter parameter) { return bound(parameter, tile); });
}

Interval Sheet::bound(Quantity quantity, std::uint64_t tile) const {
  if (const Measure* measure = std::get_if<Measure>(&quantity)) return bound_of(*measure, tile);
  if (const ControllerValue* value = std::get_if<ControllerValue>(&quantity)) return bound_of(*value, tile);
  const SettingRange range = rows_.range(tile);
  return parameters_.bound(std::get<Parameter>(quantity), range.first, range.count);
}

Interval Sheet::bound(const Expression& expression, std::uint64_t tile, std::vector<Interval>& stack) const {
  return expression.bound([&](Quantity quantity) { return bound(quantity, tile); }, stack);
}

Outlook Sheet::outlook(const Constraint& constraint, std::uint64_t tile, std::vector<Interval>& stack) const {
  const Interval left = bound(constraint.left, tile, stack);
  const Interval right = bound(constraint.right, tile, stack);
  return portrait::outlook(constraint.relation, left, right);
}

void TilePage::open(std::uint64_t tile) {
  range_ = sheet_.rows().range(tile);
  columns_.count = range_.count;
  there_.fill(false);
  statuses_there_ = false;
}

const std::vector<Status>& TilePage::statuses() {
  if (statuses_there_) return statuses_;
  source_.read_statuses(range_.first, range_.count, statuses_);
  for (const Status status : statuses_) PORTRAIT_CHECK(status <= Status::unstable);
  statuses_there_ = true;
  return statuses_;
}

bool TilePage::is_in_slice(std::size_t i) {
  if (!sheet_.slice()) return true;
  require(sheet_.sliced_parameter());
  return columns_[sheet_.sliced_parameter()][i] == *sheet_.slice();
}

void TilePage::read(Measure measure, std::vector<double>& values) {
  source_.read(measure, range_.first, range_.count, values);
  PORTRAIT_CHECK_EQ(values.size(), columns_.count);
  const double factor = sheet_.factor(measure);
  if (factor == 1) return;
  for (double& value : values) value *= factor;
}

void TilePage::read(ControllerValue value, std::vector<double>& values) {
  for (const Parameter parameter : parameters_behind(value)) require(parameter);
  values.resize(columns_.count);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = controller_value<double>(value, *sheet_.units().plant,
                                         [&](Parameter parameter) { return columns_[parameter][i]; });
}

void TilePage::require(Quantity quantity) {
  bool& there = there_[position(quantity)];
  if (there) return;
  std::vector<double>& values = columns_[quantity];
  if (const Measure* measure = std::get_if<Measure>(&quantity))
    read(*measure, values);
  else if (const ControllerValue* value = std::get_if<ControllerValue>(&quantity))
    read(*value, values);
  else
    sheet_.parameters().read(std::get<Parameter>(quantity), range_.first, range_.count, values);
  there = true;
}

void TilePage::evaluate(const Expression& expression, std::vector<double>& values) {
  for (const Expression::Use& use : expression.uses()) require(use.quantity);
  expression.evaluate(columns_, stack_, values);
}

void collect(const Expression& expression, std::vector<Quantity>& used) {
  for (const Expression::Use& use : expression.uses())
    if (std::find(used.begin(), used.end(), use.quantity) == used.end()) used.push_back(use.quantity);
}

void collect(const Constraint& constraint, std::vector<Quantity>& used) {
  collect(constraint.left, used);
  collect(constraint.right, used);
}

}  // namespace portrait
