#include "portraits/query/cloud.h"

#include <cmath>
#include <map>

#include "portraits/query/sheet.h"

namespace portrait {
namespace {

/// By x; y falls from one to the next.
class Front {
 public:
  void offer(const CloudPoint& p) {
    const auto after = by_x_.upper_bound(p.x);
    if (after != by_x_.begin() && std::prev(after)->second.y <= p.y) return;
    const auto place = by_x_.insert_or_assign(p.x, p).first;
    auto next = std::next(place);
    while (next != by_x_.end() && next->second.y >= p.y) next = by_x_.erase(next);
  }
  std::vector<CloudPoint> points() const {
    std::vector<CloudPoint> all;
    for (const auto& [x, p] : by_x_) all.push_back(p);
    return all;
  }

 private:
  std::map<double, CloudPoint> by_x_;
};

std::vector<Quantity> quantities(const Expression& x, const Expression& y, const Conditions& conditions) {
  std::vector<Quantity> used;
  collect(x, used);
  collect(y, used);
  for (const Constraint& constraint : conditions.where) collect(constraint, used);
  return used;
}

class Pass {
 public:
  Pass(const ColumnSource& source, const Expression& x, const Expression& y, const Conditions& conditions)
      : x_(x),
        y_(y),
        conditions_(conditions),
        sheet_(source, conditions.units, quantities(x, y, conditions), conditions.include_not_settled),
        page_(sheet_, source),
        stride_((setting_count(source.grid()) + kMostPoints - 1) / kMostPoints) {}

  Cloud run() {
    for (std::uint64_t tile = 0; tile < sheet_.rows().tile_count(); ++tile)
      if (sheet_.in_slice(tile) != Outlook::never && sheet_.most_eligible(tile) > 0) take_tile(tile);
    cloud_.front = front_.points();
    return std::move(cloud_);
  }

 private:
  void take_tile(std::uint64_t tile) {
    page_.open(tile);
    page_.evaluate(x_, x_values_);
    page_.evaluate(y_, y_values_);
    admissible_.assign(x_values_.size(), true);
    for (const Constraint& constraint : conditions_.where) {
      page_.evaluate(constraint.left, left_);
      page_.evaluate(constraint.right, right_);
      for (std::size_t i = 0; i < left_.size(); ++i)
        if (!holds(constraint.relation, left_[i], right_[i])) admissible_[i] = false;
    }
    for (std::size_t i = 0; i < x_values_.size(); ++i) take(i);
  }

  void take(std::size_t i) {
    if (!sheet_.has_right_status(page_.statuses()[i]) || !page_.is_in_slice(i)) return;
    if (!std::isfinite(x_values_[i]) || !std::isfinite(y_values_[i])) return;
    const CloudPoint p{page_.range().first + i, x_values_[i], y_values_[i], admissible_[i]};
    if (p.number % stride_ == 0) cloud_.points.push_back(p);
    if (!p.admissible) return;
    ++cloud_.admissible;
    front_.offer(p);
  }

  const Expression &x_, &y_;
  const Conditions& conditions_;
  Sheet sheet_;
  TilePage page_;
  std::uint64_t stride_;
  std::vector<double> x_values_, y_values_, left_, right_;
  std::vector<bool> admissible_;
  Front front_;
  Cloud cloud_;
};

}  // namespace

Cloud cloud(const ColumnSource& source, const Expression& x, const Expression& y, const Conditions& conditions) {
  require_answerable(conditions, source.grid());
  for (const Expression* expression : {&x, &y})
    require_available(*expression, source.grid(), conditions.units.plant.has_value());
  return Pass(source, x, y, conditions).run();
}

double value_at(const Expression& expression, const Setting& setting, const MeasureRow& measures,
                const QueryUnits& units) {
  Columns columns;
  columns.count = 1;
  const auto of = [&](Parameter parameter) { return get(setting, parameter); };
  for (const Expression::Use& use : expression.uses()) {
    double value = kNaN;
    if (const auto* measure = std::get_if<Measure>(&use.quantity))
      value = measures[*measure];
    else if (const auto* parameter = std::get_if<Parameter>(&use.quantity))
      value = of(*parameter);
    else
      value = controller_value<double>(std::get<ControllerValue>(use.quantity), *units.plant, of);
    columns[use.quantity] = {value};
  }
  ColumnStack stack;
  std::vector<double> value;
  expression.evaluate(columns, stack, value);
  return value.at(0);
}

}  // namespace portrait
