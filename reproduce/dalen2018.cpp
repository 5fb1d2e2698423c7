/// The tables of Dalen2018 on rules and on the examples; dalen2018_products.cpp and dalen2018_distances.cpp have the others.

#include "reproduce/dalen2018.h"

#include <array>
#include <cmath>

#include "engine/loop/loop_measures.h"
#include "engine/loop/stability.h"
#include "engine/reference/response.h"
#include "engine/rules/reaction_curve.h"

namespace portrait::reproduce {
namespace {

using rules::IntegratingPlant;
using rules::LagDelayPlant;
using rules::PiLoop;
using rules::RulePlant;

MeasureRow margins_of(const RulePlant& plant, const StandardForm& form) {
  MeasureRow m;
  const OpenLoop open = open_loop(rules::general_loop(plant, rules::tuned(form)));
  if (is_stable(open)) measure_loop(open, m);
  return m;
}

// ---------------------------------------------------------------- rules as alpha and beta

Numbers known_rules(const PublishedTable&) {
  const RulePlant plant = rules::ipdt(1, 1);
  const auto line = [&](const StandardForm& f) {
    const MeasureRow m = margins_of(plant, f);
    return row({f.Kc, f.Ti, f.Kc * f.Ti, rules::relative_delay_margin(f.Kc, f.Ti), m[Measure::Ms], m[Measure::GM]});
  };
  const StandardForm zn = rules::ziegler_nichols_pi(rules::ultimate(kUnit));
  return {line(zn), line(rules::delta_tuning(kUnit, zn.Kc * zn.Ti, 1.6)),
          line(rules::imc_pi(kUnit, std::sqrt(10.0))), line(rules::simc_pi(kUnit, 1))};
}

Numbers pade(const PublishedTable&) {
  const double c = rules::pade_triple_root();
  const StandardForm f = rules::pade_tuning(kUnit, c);
  return {row({c, f.Kc * f.Ti})};
}

Numbers eq49(const PublishedTable&) {
  return {row({margins_of(rules::ipdt(1, 1), rules::delta_tuning(kUnit, 2.5, 1.79))[Measure::PM]})};
}

Numbers references(const PublishedTable&) {
  const PiLoop loop = rules::pi_loop(kUnit);
  const auto disturbances = rules::pareto_pi(loop, kPrescribedMs, 0);
  const auto p = rules::pi_of_sensitivity(loop, kInf, kPrescribedMs);
  return {row({disturbances->least.IAE_vy, disturbances->least.IAE_vu, p->Kc, disturbances->Kp, disturbances->Ti})};
}

}  // namespace

// ---------------------------------------------------------------- what the examples share

const rules::RulePlant& column() {  // (47)
  static const RulePlant plant = lag_plant(34, {54, 0.5, 0.5}, 0);
  return plant;
}
const rules::RulePlant& submersible() {  // (48)
  static const RulePlant plant = [] {
    RulePlant p = lag_plant(-2.6158, {0.8131, 0.5}, 0, 0, {1, 2.299});
    p.poles.push_back({1, 1.738 * 7.692, 7.692 * 7.692});
    return p;
  }();
  return plant;
}

SampledPlant sampled_plant(const rules::IntegratingPlant& p, double dt) {
  return {1, p.k * dt, dt, static_cast<int>(std::lround(p.tau / dt))};
}
SampledPlant sampled_plant(const rules::LagDelayPlant& p, double dt) {
  const double keep = std::exp(-dt / p.T);
  return {keep, p.K * (1 - keep), dt, static_cast<int>(std::lround(p.tau / dt))};
}

SampledRun sampled_run(const SampledPlant& p, const StandardForm& f, int out, int in, int steps) {
  SampledRun run{std::vector<double>(static_cast<std::size_t>(steps) + 1), {}};
  run.input = run.error;
  double y = 0, integral = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double e = -(y + (i >= out ? 1 : 0));
    run.error[k] = e, run.input[k] = f.Kc * (e + integral / f.Ti) + (i >= in ? 1 : 0), integral += p.dt * e;
    y = p.keep * y + (i >= p.delay ? p.gain * run.input[k - static_cast<std::size_t>(p.delay)] : 0);
  }
  return run;
}

namespace {

IntegratingPlant reaction(const RulePlant& plant) {
  Polynomial N = plant.zeros, D{1};
  for (double& a : N) a *= plant.K;
  for (const Polynomial& p : plant.poles) D = product(D, p);
  const rules::ReactionCurve curve = rules::reaction_curve(N, D, plant.Td).value();
  return {curve.slope, curve.lag};
}

Numbers prc(const PublishedTable&) {
  const IntegratingPlant four = reaction(column()), five = reaction(submersible());
  return {row({four.k, four.tau}), row({five.k, five.tau})};
}

// ---------------------------------------------------------------- the examples: Tables 6, 8, 10, 12, 14

/// What a column of these tables holds, from top to bottom.
struct ColumnOfTen {
  std::array<double, 10> values;
};

ColumnOfTen measured_column(const RulePlant& plant, const StandardForm& f, const rules::PiErrors& least) {
  const rules::TunedMeasures found = rules::measured(plant, rules::tuned(f));
  const MeasureRow& m = found.measures;
  const double J = 0.5 * (m[Measure::IAE_w] / least.IAE_vy + m[Measure::IAE_d] / least.IAE_vu);
  // The plant's own input: the disturbance adds its step, and the first kick of u is left out.
  const double TV = m[Measure::TV_uw] - std::abs(f.Kc) + m[Measure::TV_ud] + 1;
  return {{f.Kc, f.Ti, m[Measure::IAE_w], m[Measure::IAE_d], J, TV, m[Measure::GM], m[Measure::PM], m[Measure::DM],
           m[Measure::Ms]}};
}

Numbers side_by_side(const std::vector<ColumnOfTen>& columns, const std::vector<ColumnOfTen>& corrected = {}) {
  Numbers numbers;
  for (std::size_t r = 0; r < 10; ++r) {
    std::vector<Computed>& cells = numbers.emplace_back();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      cells.push_back({columns[c].values[r], {}});
      if (c < corrected.size()) cells.back().corrected = corrected[c].values[r];
    }
  }
  return numbers;
}

StandardForm form_of(const rules::ParetoPi& p) { return {p.Kp, p.Ti, 0}; }

/// When the input steps, where IAE_vy ends and IAE_vu begins, when all ends; in samples of 0.1.
struct Experiment {
  int in, split, end;
};

/// IAE, J and TV of the paper's own loop in place of the exact ones: hold of 0.1, IAE by trapezoids.
ColumnOfTen sampled_column(ColumnOfTen column, const SampledPlant& p, const StandardForm& f, const Experiment& x,
                           const rules::PiErrors& least) {
  const auto [error, input] = sampled_run(p, f, 0, x.in, x.end);
  double IAE_y = 0, IAE_u = 0, TV = 0;
  for (std::size_t k = 1; k < error.size(); ++k) {
    TV += std::abs(input[k] - input[k - 1]);
    (static_cast<int>(k) <= x.split ? IAE_y : IAE_u) += p.dt / 2 * (std::abs(error[k]) + std::abs(error[k - 1]));
  }
  column.values[2] = IAE_y, column.values[3] = IAE_u, column.values[5] = TV;
  column.values[4] = 0.5 * (IAE_y / least.IAE_vy + IAE_u / least.IAE_vu);
  return column;
}

Numbers table6(const PublishedTable&) {
  const RulePlant plant = rules::ipdt(1, 1);
  const rules::ParetoPi po = rules::pareto_pi(rules::pi_loop(kUnit), kPrescribedMs, 0.5).value();
  const StandardForm forms[] = {rules::delta_tuning(kUnit, 2.5, 1.79), rules::simc_pi(kUnit, 1.24), form_of(po)};
  const StandardForm rounded[] = {forms[0], forms[1], {0.41, 6.28, 0}};
  std::vector<ColumnOfTen> columns, corrected;
  for (std::size_t i = 0; i < 3; ++i) {
    columns.push_back(measured_column(plant, forms[i], po.least));
    corrected.push_back(sampled_column(measured_column(plant, rounded[i], po.least), sampled_plant(kUnit, 0.1),
                                       rounded[i], {500, 500, 1000}, {2.17, 15.10}));
  }
  return side_by_side(columns, corrected);
}

Numbers table8(const PublishedTable&) {
  const RulePlant plant = rules::jotd(kHeater.K, kHeater.tau, kHeater.T, 1);
  const IntegratingPlant ipdt{kHeater.K / kHeater.T, kHeater.tau};
  const rules::ParetoPi po = rules::pareto_pi(rules::pi_loop(kHeater), kPrescribedMs, 0.5).value();
  std::vector<ColumnOfTen> columns, corrected;
  for (const StandardForm& f :
       {rules::delta_tuning(ipdt, 2.5, 1.56), rules::simc_pi(kHeater, 1.10 * kHeater.tau), form_of(po)}) {
    columns.push_back(measured_column(plant, f, po.least));
    corrected.push_back(
        sampled_column(columns.back(), sampled_plant(kHeater, 0.1), f, {1400, 1499, 3500}, po.least));
  }
  return side_by_side(columns, corrected);
}

const rules::ParetoPi& column_front() {
  static const rules::ParetoPi po =
      rules::pareto_pi(general_pi_loop(column(), kColumn), kPrescribedMs, 0.5).value();
  return po;
}
const rules::ParetoPi& submersible_front() {
  static const rules::ParetoPi po =
      rules::pareto_pi(general_pi_loop(submersible(), kSubmersible), kPrescribedMs, 0.5).value();
  return po;
}

Numbers table10(const PublishedTable&) {
  const rules::ParetoPi& po = column_front();
  const LagDelayPlant half{34, 54.25, 0.75};
  std::vector<ColumnOfTen> columns, corrected;
  for (const StandardForm& f :
       {rules::delta_tuning(kColumn, 2.7, 1.63), rules::simc_pi(half, 1.33 * 0.75), form_of(po)})
    columns.push_back(measured_column(column(), f, po.least));
  for (const StandardForm& f : {rules::delta_tuning(kColumn, 2.5, 1.63195), rules::simc_pi(half, 1.0085)})
    corrected.push_back(measured_column(column(), f, po.least));
  return side_by_side(columns, corrected);
}

/// `form` beside the Pareto optimum; corrected: J with the optimum's own integrals for weights.
Numbers beside_front(const StandardForm& form) {
  const rules::ParetoPi& po = submersible_front();
  std::vector<ColumnOfTen> columns, corrected;
  for (const StandardForm& f : {form, form_of(po)}) {
    columns.push_back(measured_column(submersible(), f, po.least));
    corrected.push_back(measured_column(submersible(), f, po.errors));
  }
  return side_by_side(columns, corrected);
}

Numbers table12(const PublishedTable&) { return beside_front(rules::delta_tuning(kSubmersible, 2.5, 2.20)); }
Numbers table14(const PublishedTable&) {
  return beside_front(rules::delta_tuning({kSubmersible.k * 0.74, kSubmersible.tau}, 2.7, 2.7));
}

std::vector<Maker> example_makers() {
  return {{"dalen2018/rules", known_rules},     {"dalen2018/pade", pade},       {"dalen2018/eq49", eq49},
          {"dalen2018/references", references}, {"dalen2018/prc", prc},         {"dalen2018/table6", table6},
          {"dalen2018/table8", table8},         {"dalen2018/table10", table10}, {"dalen2018/table12", table12},
          {"dalen2018/table14", table14}};
}

}  // namespace

std::vector<Maker> dalen2018_makers() {
  std::vector<Maker> all = example_makers();
  for (const auto& more : {dalen2018_product_makers(), dalen2018_distance_makers()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace portrait::reproduce
