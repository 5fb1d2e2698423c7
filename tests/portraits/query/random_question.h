/// Random portraits and random questions about them. Only within a property: they draw from RapidCheck.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <rapidcheck.h>

#include "portraits/query/query.h"
#include "tests/portraits/query/expression_tree.h"
#include "tests/portraits/query/memory_source.h"

namespace portrait {

inline const std::vector<Quantity> kMeasured = {Measure::IAE_w, Measure::TV2_uw, Measure::IAE_d};
inline const std::vector<Quantity> kNamed = {Measure::IAE_w,   Measure::TV2_uw,  Measure::IAE_d,  Parameter::kappa,
                                             Parameter::tau_i, Parameter::delta, Parameter::tau_d};

struct TreeConstraint {
  Tree left;
  Relation relation;
  Tree right;
};

struct Case {
  Tree objective;
  std::vector<TreeConstraint> where;
  Question question;
};

inline Grid random_grid() {
  Grid grid;
  const bool fotd = *rc::gen::arbitrary<bool>();
  grid.family = {fotd ? Plant::fotd : Plant::ipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::TV2_uw};
  const Parameter derivative = *rc::gen::element(Parameter::delta, Parameter::tau_d);
  const auto size = [](std::uint64_t most) { return *rc::gen::inRange<std::uint64_t>(2, most); };
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.9, size(30)), Axis::linear(derivative, 0.1, 2, size(20))};
  if (*rc::gen::arbitrary<bool>()) grid.axes.push_back(Axis::list(Parameter::tau_i, {2, 4, 8, kInf}));
  if (grid.axes.size() == 2) grid.fixed.push_back({Parameter::tau_i, 8});
  if (fotd)
    grid.axes.insert(grid.axes.begin() + *rc::gen::inRange(0, 3), Axis::list(Parameter::tau_1, {0.5, 1.5, 3}));
  return grid;
}

/// Few different numbers, so that there are many ties, or all different, or numbers that change slowly from setting to
/// setting, so that tiles can be told apart by their ranges; some NaN and infinite ones; all four outcomes. What is
/// unstable is NaN, as in a portrait. Sometimes nothing is known of tiles, as in an older portrait.
inline MemorySource random_source(const Grid& grid) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const bool mostly_bad = *rc::gen::inRange(0, 8) == 0;
  const int kind = *rc::gen::inRange(0, 3);
  const std::vector<double> pool = {0, 0.5, 1, 1, 2, 3, 5, 8, 13, kInf, kNaN};
  MemorySource source(grid);
  for (std::uint64_t i = 0; i < setting_count(grid); ++i) {
    for (const Measure measure : grid.measures) {
      const double value = pool[random() % pool.size()];
      const double slow = 10 * std::sin(1e-3 * static_cast<double>(i) * (2 + static_cast<int>(measure)));
      source.at(measure, i) = kind == 0   ? value
                              : kind == 1 ? value + std::uniform_real_distribution<>(0, 5)(random)
                                          : std::floor(20 * slow) / 20;
    }
    const unsigned draw = random() % 16;
    const bool settled = mostly_bad ? draw == 0 : draw < 10;
    source.status(i) = settled ? Status::settled : static_cast<Status>(random() % 4);
    if (source.status(i) != Status::unstable) continue;
    for (const Measure measure : grid.measures) source.at(measure, i) = kNaN;
  }
  source.know_summaries(*rc::gen::inRange(0, 4) != 0);
  return source;
}

inline TreeConstraint random_constraint(const std::vector<Quantity>& names) {
  const auto relation = static_cast<Relation>(*rc::gen::inRange(0, 5));
  if (*rc::gen::inRange(0, 3) == 0) return {random_tree(2, names), relation, random_tree(2, names)};
  Tree bound;
  bound.number = *rc::gen::element(0.25, 1.0, 2.0, 4.0, 20.0);
  Tree measure = random_leaf(kMeasured);
  measure.symbol = "name";
  return {measure, relation == Relation::equal ? Relation::at_most : relation, bound};
}

inline Case random_case(const Grid& grid) {
  QueryUnits units;
  std::vector<Quantity> names = kNamed;
  if (*rc::gen::arbitrary<bool>()) {
    const bool fotd = grid.family.plant == Plant::fotd;
    const double Td = *rc::gen::element(0.5, 1.0, 3.0);
    units.plant = RealPlant{grid.family.plant, *rc::gen::element(-2.0, 0.5), Td,
                            fotd ? Td * *rc::gen::element(0.5, 1.5, 3.0) : 0};
    units.steps = {*rc::gen::element(0.5, 1.0, 4.0), *rc::gen::element(0.25, 1.0, 3.0)};
    names.insert(names.end(), {ControllerValue::Kc, ControllerValue::Ki, ControllerValue::Kd});
  }
  const Tree objective = random_tree(*rc::gen::inRange(0, 3), names);
  Case one{objective, {}, {.minimize = parse_expression({"--minimize", print(objective)}), .conditions = {}}};
  const int constraints = *rc::gen::inRange(0, 5);
  for (int j = 0; j < constraints; ++j) {
    one.where.push_back(random_constraint(names));
    const TreeConstraint& c = one.where.back();
    const std::string relation(to_string(c.relation));
    one.question.conditions.where.push_back(
        parse_constraint({"--where", print(c.left) + " " + relation + " " + print(c.right)}));
  }
  one.question.top = *rc::gen::inRange<std::size_t>(1, 20);
  one.question.count_excluded = *rc::gen::arbitrary<bool>();
  one.question.conditions.threads = *rc::gen::inRange(1, 4);
  one.question.conditions.include_not_settled = *rc::gen::arbitrary<bool>();
  one.question.conditions.units = units;
  return one;
}

}  // namespace portrait
