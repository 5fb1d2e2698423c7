/// The tables of Dalen2018.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/loop/loop_measures.h"
#include "engine/loop/stability.h"
#include "engine/reference/measure.h"
#include "engine/reference/response.h"
#include "engine/rules/delta_tuning.h"
#include "engine/rules/field.h"
#include "engine/rules/pareto_pi.h"
#include "engine/rules/reaction_curve.h"
#include "engine/sweep/method.h"
#include "reproduce/loops.h"

namespace portrait::reproduce {
namespace {

using rules::IntegratingPlant;
using rules::LagDelayPlant;
using rules::PiLoop;
using rules::RulePlant;

constexpr double kMs = 1.59;
constexpr IntegratingPlant kUnit = {1, 1};

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
  const auto disturbances = rules::pareto_pi(loop, kMs, 0);
  const auto p = rules::pi_of_sensitivity(loop, kInf, kMs);
  return {row({disturbances->least.IAE_vy, disturbances->least.IAE_vu, p->Kc, disturbances->Kp, disturbances->Ti})};
}

// ---------------------------------------------------------------- the plants of the examples

const RulePlant& column() {  // (47)
  static const RulePlant plant = lag_plant(34, {54, 0.5, 0.5}, 0);
  return plant;
}
const RulePlant& submersible() {  // (48)
  static const RulePlant plant = [] {
    RulePlant p = lag_plant(-2.6158, {0.8131, 0.5}, 0, 0, {1, 2.299});
    p.poles.push_back({1, 1.738 * 7.692, 7.692 * 7.692});
    return p;
  }();
  return plant;
}

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

// ---------------------------------------------------------------- the paper's own sampled loop

/// Error and plant input of k e^{-tau s}/s under PI: u held over dt, the integral by Euler, unit steps at the plant's
/// output and input from the samples `out` and `in` on, `steps` samples in all. REQUIRES: tau/dt is whole.
struct SampledRun {
  std::vector<double> error, input;
};

SampledRun sampled_run(const IntegratingPlant& p, const StandardForm& f, double dt, int out, int in, int steps) {
  const int delay = static_cast<int>(std::lround(p.tau / dt));
  SampledRun run{std::vector<double>(static_cast<std::size_t>(steps) + 1), {}};
  run.input = run.error;
  double y = 0, integral = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double e = -(y + (i >= out ? 1 : 0));
    run.error[k] = e, run.input[k] = f.Kc * (e + integral / f.Ti) + (i >= in ? 1 : 0), integral += dt * e;
    if (i >= delay) y += dt * p.k * run.input[k - static_cast<std::size_t>(delay)];
  }
  return run;
}

// ---------------------------------------------------------------- best method products: Tables 1, 3, 4, 5

/// Everything at one cbar, delta = 1.6, k = tau = 1.
std::vector<MeasureRow> along_cbar() {
  std::vector<Setting> settings;
  for (int i = 0; i <= 50; ++i) {
    const StandardForm f = rules::delta_tuning(kUnit, 1.5 + 0.05 * i, 1.6);
    settings.push_back({.kappa = f.Kc, .tau_i = f.Ti});
  }
  std::vector<SettingMeasured> found(settings.size());
  measure_settings(Method::kernel, {Plant::ipdt, 0, Prefilter::none}, Horizon::until_settled(), {}, settings,
                   found);
  std::vector<MeasureRow> rows;
  for (std::size_t i = 0; i < found.size(); ++i) {
    rows.push_back(found[i].measures);
    rows.back()[Measure::TV_uw] -= settings[i].kappa;  // the paper's TV leaves the first kick out
  }
  return rows;
}

template <typename Row, typename Index>
double best_cbar(const std::vector<Row>& rows, const Index& index) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (index(rows[i]) < index(rows[best])) best = i;
  return 1.5 + 0.05 * static_cast<double>(best);
}

/// Both steps together, y of the input step being k tau times larger; T_1 in dead times.
struct Together {
  double gain, T1;

  double ISE(const MeasureRow& m) const { return m[Measure::ISE_w] + gain * gain * m[Measure::ISE_d]; }
  double ITSE(const MeasureRow& m) const {
    return m[Measure::ITSE_w] + gain * gain * (m[Measure::ITSE_d] + T1 * m[Measure::ISE_d]);
  }
  double ITAE(const MeasureRow& m) const {
    return m[Measure::ITAE_w] + gain * (m[Measure::ITAE_d] + T1 * m[Measure::IAE_d]);
  }
  double TV(const MeasureRow& m) const { return m[Measure::TV_uw] / gain + m[Measure::TV_ud]; }
};
Together together(std::string_view label) {
  const double k = number_in_label(label, "k"), tau = number_in_label(label, "tau");
  return {k * tau, 100 / tau};
}

double index_of(const std::vector<MeasureRow>& rows, Measure measure) {
  return best_cbar(rows, [&](const MeasureRow& m) { return m[measure]; });
}

Numbers table3(const PublishedTable&) {
  const auto rows = along_cbar();
  return {row({index_of(rows, Measure::Ms), index_of(rows, Measure::IAE_d), index_of(rows, Measure::ITAE_d),
               index_of(rows, Measure::ITAE_w), index_of(rows, Measure::IAE_w)})};
}

/// Indices of the paper's loop sampled with 0.01: of both steps in one run, the input step at T_1, and of the input step alone.
struct SampledIndices {
  double IAE_vu = 0, ITAE_vu = 0, ITAE = 0, ITSE = 0;
};

SampledIndices sampled_indices(const IntegratingPlant& p, const StandardForm& f, double T1) {
  constexpr double dt = 0.01;
  constexpr int kNever = std::numeric_limits<int>::max();
  const int in = static_cast<int>(std::lround(T1 / dt));
  SampledIndices sum;
  const std::vector<double> both = sampled_run(p, f, dt, 0, in, 2 * in).error;
  for (std::size_t k = 0; k < both.size(); ++k) {
    const double t = static_cast<double>(k) * dt;
    sum.ITAE += t * std::abs(both[k]), sum.ITSE += t * both[k] * both[k];
  }
  const std::vector<double> alone = sampled_run(p, f, dt, kNever, 0, in).error;
  for (std::size_t k = 0; k < alone.size(); ++k)
    sum.IAE_vu += std::abs(alone[k]), sum.ITAE_vu += static_cast<double>(k) * dt * std::abs(alone[k]);
  return sum;
}

/// The same along cbar; T_1 is 45 tau, and 20 for k = 1, tau = 0.1.
std::vector<SampledIndices> sampled_along_cbar(std::string_view label) {
  const IntegratingPlant p{number_in_label(label, "k"), number_in_label(label, "tau")};
  const double T1 = p.k == 1 && p.tau == 0.1 ? 20 : 45 * p.tau;
  std::vector<SampledIndices> found;
  for (int i = 0; i <= 50; ++i) found.push_back(sampled_indices(p, rules::delta_tuning(p, 1.5 + 0.05 * i, 1.6), T1));
  return found;
}

Numbers table4(const PublishedTable& table) {
  const auto rows = along_cbar();
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const Together both = together(r.label);
    const auto sampled = sampled_along_cbar(r.label);
    const auto best = [&](double SampledIndices::*index) {
      return best_cbar(sampled, [&](const SampledIndices& s) { return s.*index; });
    };
    numbers.push_back({{index_of(rows, Measure::Ms), {}},
                       {index_of(rows, Measure::IAE_d), best(&SampledIndices::IAE_vu)},
                       {best_cbar(rows, [&](const MeasureRow& m) { return both.ITAE(m); }), best(&SampledIndices::ITAE)},
                       {index_of(rows, Measure::ITAE_d), best(&SampledIndices::ITAE_vu)}});
  }
  return numbers;
}

Numbers table5(const PublishedTable& table) {
  const auto rows = along_cbar();
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const Together both = together(r.label);
    const auto best = [&](double (Together::*index)(const MeasureRow&) const) {
      return best_cbar(rows, [&](const MeasureRow& m) { return (both.*index)(m); });
    };
    numbers.push_back(row({index_of(rows, Measure::ITAE_w), best(&Together::ITSE), best(&Together::ISE),
                           best(&Together::TV), index_of(rows, Measure::IAE_w)}));
    numbers.back()[1].corrected =
        best_cbar(sampled_along_cbar(r.label), [](const SampledIndices& s) { return s.ITSE; });
  }
  return numbers;
}

/// J's parts over delta = 1.1 .. 3.4 and cbar = 2 .. 5.
struct AlongDelta {
  static constexpr int kCbars = 61, kDeltas = 24;
  std::vector<SettingMeasured> found;
  std::vector<rules::PiErrors> weights;  ///< by delta

  explicit AlongDelta(Horizon horizon) : found(kCbars * kDeltas), weights(kDeltas, {2.17, 15.10}) {
    std::vector<Setting> settings;
    for (int d = 0; d < kDeltas; ++d)
      for (int c = 0; c < kCbars; ++c) {
        const StandardForm f = rules::delta_tuning(kUnit, 2 + 0.05 * c, delta(d));
        settings.push_back({.kappa = f.Kc, .tau_i = f.Ti});
      }
    measure_settings(Method::kernel, kFamily, horizon, {}, settings, found);
  }
  /// IAE^o of each delta in place of that of Ms = 1.59: by P control with that delta, and the least of the curves.
  void weigh_by_own(Horizon horizon) {
    for (int d = 0; d < kDeltas; ++d) {
      const Setting p{.kappa = std::numbers::pi / 2 / (1 + delta(d)), .tau_i = kInf};
      SettingMeasured alone;
      measure_settings(Method::kernel, kFamily, horizon, {}, {&p, 1}, {&alone, 1});
      rules::PiErrors& w = weights[static_cast<std::size_t>(d)];
      w = {alone.measures[Measure::IAE_w], kInf};
      for (int c = 0; c < kCbars; ++c) w.IAE_vu = std::min(w.IAE_vu, at(d, c)[Measure::IAE_d]);
    }
  }
  double J(double s_r, int d, int c) const {
    const rules::PiErrors& w = weights[static_cast<std::size_t>(d)];
    return s_r * at(d, c)[Measure::IAE_w] / w.IAE_vy + (1 - s_r) * at(d, c)[Measure::IAE_d] / w.IAE_vu;
  }
  /// cbar that is least in the mean square of J(cbar, delta) less its least over cbar.              [Dalen2018 (43)]
  double best(double s_r) const {
    std::vector<double> sums(kCbars, 0.0);
    for (int d = 0; d < kDeltas; ++d) {
      double least = kInf;
      for (int c = 0; c < kCbars; ++c) least = std::min(least, J(s_r, d, c));
      for (int c = 0; c < kCbars; ++c) sums[static_cast<std::size_t>(c)] += std::pow(J(s_r, d, c) - least, 2);
    }
    return 2 + 0.05 * static_cast<double>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  }

 private:
  static constexpr LoopFamily kFamily{Plant::ipdt, 0, Prefilter::none};
  static double delta(int d) { return 1.1 + 0.1 * d; }
  const MeasureRow& at(int d, int c) const { return found[static_cast<std::size_t>(d * kCbars + c)].measures; }
};

Numbers table1(const PublishedTable& table) {
  const AlongDelta printed(Horizon::until_settled());
  AlongDelta corrected(Horizon::fixed(50));
  corrected.weigh_by_own(Horizon::fixed(50));
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const double s_r = number_in_label(r.label, "s_r");
    numbers.push_back({{printed.best(s_r), corrected.best(s_r)}});
  }
  return numbers;
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

/// Hold of 0.1, IAE by trapezoids, steps at 0 and 50, 100 in all.
std::array<double, 3> sampled_example2(const StandardForm& f) {
  constexpr int kSteps = 1000, kInput = 500;
  constexpr double dt = 0.1;
  const auto [error, input] = sampled_run(kUnit, f, dt, 0, kInput, kSteps);
  double IAE_y = 0, IAE_u = 0, TV = 0;
  for (std::size_t k = 1; k <= kSteps; ++k) {
    TV += std::abs(input[k] - input[k - 1]);
    (k <= kInput ? IAE_y : IAE_u) += dt / 2 * (std::abs(error[k]) + std::abs(error[k - 1]));
  }
  return {IAE_y, IAE_u, TV};
}

ColumnOfTen sampled_column(ColumnOfTen column, const StandardForm& f) {
  const auto [IAE_y, IAE_u, TV] = sampled_example2(f);
  column.values[2] = IAE_y, column.values[3] = IAE_u, column.values[5] = TV;
  column.values[4] = 0.5 * (IAE_y / 2.17 + IAE_u / 15.10);
  return column;
}

Numbers table6(const PublishedTable&) {
  const RulePlant plant = rules::ipdt(1, 1);
  const rules::ParetoPi po = rules::pareto_pi(rules::pi_loop(kUnit), kMs, 0.5).value();
  const StandardForm forms[] = {rules::delta_tuning(kUnit, 2.5, 1.79), rules::simc_pi(kUnit, 1.24), form_of(po)};
  const StandardForm rounded[] = {forms[0], forms[1], {0.41, 6.28, 0}};
  std::vector<ColumnOfTen> columns, corrected;
  for (std::size_t i = 0; i < 3; ++i) {
    columns.push_back(measured_column(plant, forms[i], po.least));
    corrected.push_back(sampled_column(measured_column(plant, rounded[i], po.least), rounded[i]));
  }
  return side_by_side(columns, corrected);
}

/// int_0^10 |y| after the input step: what a window that ends ten late counts to the wrong side.
double first_ten(const LagDelayPlant& p, const StandardForm& f) {
  const Loop loop{{Plant::fotd, 0, Prefilter::none},
                  {.kappa = f.Kc * p.K, .tau_i = f.Ti / p.tau, .delta = 0, .tau_1 = p.T / p.tau}};
  const reference::Response r = reference::simulate(loop, Horizon::fixed(3));
  double sum = 0;
  constexpr int kPoints = 2000;
  for (int i = 0; i < kPoints; ++i)
    sum += std::abs(reference::y_at(r.steps[reference::kDisturbance], (i + 0.5) * 2.5 / kPoints)) * 10 / kPoints;
  return sum * p.K;
}

ColumnOfTen slipped_column(ColumnOfTen column, const LagDelayPlant& p, const StandardForm& f,
                           const rules::PiErrors& least) {
  const double slip = first_ten(p, f);
  column.values[2] += slip, column.values[3] -= slip;
  column.values[4] = 0.5 * (column.values[2] / least.IAE_vy + column.values[3] / least.IAE_vu);
  return column;
}

constexpr LagDelayPlant kHeater = {5.7, 60, 4};

Numbers table8(const PublishedTable&) {
  const RulePlant plant = rules::jotd(kHeater.K, kHeater.tau, kHeater.T, 1);
  const IntegratingPlant ipdt{kHeater.K / kHeater.T, kHeater.tau};
  const rules::ParetoPi po = rules::pareto_pi(rules::pi_loop(kHeater), kMs, 0.5).value();
  std::vector<ColumnOfTen> columns, corrected;
  for (const StandardForm& f :
       {rules::delta_tuning(ipdt, 2.5, 1.56), rules::simc_pi(kHeater, 1.10 * kHeater.tau), form_of(po)}) {
    columns.push_back(measured_column(plant, f, po.least));
    corrected.push_back(slipped_column(columns.back(), kHeater, f, po.least));
  }
  return side_by_side(columns, corrected);
}

const IntegratingPlant kColumn = {0.597, 0.923}, kSubmersible = {-0.145, 1.729};

const rules::ParetoPi& column_front() {
  static const rules::ParetoPi po = rules::pareto_pi(general_pi_loop(column(), kColumn), kMs, 0.5).value();
  return po;
}
const rules::ParetoPi& submersible_front() {
  static const rules::ParetoPi po =
      rules::pareto_pi(general_pi_loop(submersible(), kSubmersible), kMs, 0.5).value();
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

// ---------------------------------------------------------------- distances from the front: Tables 2, 7, 9, 11, 13

constexpr int kIntervals = 16;

/// Mean over a grid of Ms of (J of the PI on the curve of cbar less J of the front)^2, J with the references of Ms = 1.59
/// throughout.                                                                                  [Dalen2018 (41), (42)]
/// The paper does not state the grid. Here it is dense and uniform in the delta of Algorithm 1 with cbar = 2.5, from Ms = 2.0
/// to 1.3: the mean is an integral, by Simpson's rule.
struct Distances {
  PiLoop loop;
  std::vector<double> Ms, weight;
  rules::PiErrors least;
  std::vector<double> front;

  enum class Weights { least, of_front };

  explicit Distances(PiLoop a_loop, Weights weights = Weights::least) : loop(std::move(a_loop)) {
    const rules::ParetoPi po = rules::pareto_pi(loop, kMs, 0.5).value();
    least = weights == Weights::least ? po.least : po.errors;
    const double first = delta_of(2.0), last = delta_of(1.3);
    for (int i = 0; i <= kIntervals; ++i) {
      const StandardForm f = rules::delta_tuning(loop.scale, 2.5, first + (last - first) * i / kIntervals);
      Ms.push_back(loop.Ms(f.Kc, f.Ti));
      weight.push_back((i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3 * kIntervals));
      front.push_back(rules::pareto_pi(loop, Ms.back(), 0.5, least)->J);
    }
  }
  double delta_of(double peak) const {
    const StandardForm f = rules::pi_of_sensitivity(loop, 2.5, peak).value();
    return rules::relative_delay_margin(f.Kc * loop.scale.k * loop.scale.tau, f.Ti / loop.scale.tau);
  }
  double J(const rules::PiErrors& e) const { return 0.5 * (e.IAE_vy / least.IAE_vy + e.IAE_vu / least.IAE_vu); }
  /// `form` gives the PI of one Ms.
  template <typename Form>
  double of(const Form& form) const {
    double sum = 0;
    for (std::size_t i = 0; i < Ms.size(); ++i) {
      const StandardForm f = form(Ms[i]);
      sum += weight[i] * std::pow(J(loop.errors(f.Kc, f.Ti)) - front[i], 2);
    }
    return sum;
  }
  double of_cbar(double cbar) const {
    return of([&](double peak) { return rules::pi_of_sensitivity(loop, cbar, peak).value(); });
  }
};

/// SIMC of a lag plant at a prescribed Ms, by its Tc.
StandardForm simc_of_sensitivity(const PiLoop& loop, const LagDelayPlant& p, double Ms) {
  double low = -0.5 * p.tau, high = 20 * p.tau;
  for (int i = 0; i < 60; ++i) {
    const double Tc = 0.5 * (low + high);
    const StandardForm f = rules::simc_pi(p, Tc);
    (loop.Ms(f.Kc, f.Ti) < Ms ? high : low) = Tc;
  }
  return rules::simc_pi(p, high);
}

/// The integrals of each step over a window of time alone.
PiLoop within_window(PiLoop loop, const RulePlant& plant, double seconds) {
  loop.errors = [plant, seconds](double Kp, double Ti) {
    const auto m = reference::measure_in_units(rules::general_loop(plant, pi(Kp, Ti)), Horizon::fixed(seconds));
    return rules::PiErrors{m.measured.measures[Measure::IAE_w], m.measured.measures[Measure::IAE_d]};
  };
  return loop;
}

Numbers with_correction(const std::vector<double>& values, const std::vector<double>& corrected) {
  Numbers numbers{row(values, values.size())};
  for (std::size_t i = 0; i < corrected.size(); ++i) numbers[0][i].corrected = corrected[i];
  return numbers;
}

Numbers table2(const PublishedTable&) {
  const Distances d(rules::pi_loop(kUnit));
  return {row({d.of_cbar(2.5), d.of_cbar(2.7), d.of_cbar(4)})};
}

std::vector<double> beside_simc(const Distances& d, const LagDelayPlant& half) {
  return {d.of_cbar(2.5), d.of_cbar(2.7), d.of([&](double Ms) { return simc_of_sensitivity(d.loop, half, Ms); })};
}
Numbers table7(const PublishedTable&) {
  const PiLoop loop = rules::pi_loop(kHeater);
  const RulePlant plant = rules::jotd(kHeater.K, kHeater.tau, kHeater.T, 1);
  return with_correction(beside_simc(Distances(loop), kHeater),
                         beside_simc(Distances(within_window(loop, plant, 155)), kHeater));
}
Numbers table9(const PublishedTable&) {
  const PiLoop loop = general_pi_loop(column(), kColumn);
  const LagDelayPlant half{34, 54.25, 0.75};
  return with_correction(beside_simc(Distances(loop), half),
                         beside_simc(Distances(within_window(loop, column(), 40)), half));
}

const Distances& submersible_distances() {
  static const Distances d(general_pi_loop(submersible(), kSubmersible));
  return d;
}
/// Corrected: windows of 125 s, and the weights of Table 12.
const Distances& submersible_windows() {
  static const Distances d(within_window(general_pi_loop(submersible(), kSubmersible), submersible(), 125),
                           Distances::Weights::of_front);
  return d;
}
Numbers table11(const PublishedTable&) {
  const auto of = [](const Distances& d) { return std::vector{d.of_cbar(2.5), d.of_cbar(2.7), d.of_cbar(4)}; };
  return with_correction(of(submersible_distances()), of(submersible_windows()));
}

/// zeta at a prescribed Ms: Ti stays, Kp falls with zeta.
StandardForm zeta_of_sensitivity(const PiLoop& loop, double Ms) {
  const auto form = [](double zeta) {
    return rules::delta_tuning({kSubmersible.k * zeta, kSubmersible.tau}, 2.7, 2.7);
  };
  double low = 0.2, high = 3;
  for (int i = 0; i < 60; ++i) {
    const double zeta = 0.5 * (low + high);
    const StandardForm f = form(zeta);
    (loop.Ms(f.Kc, f.Ti) < Ms ? high : low) = zeta;
  }
  return form(high);
}
Numbers table13(const PublishedTable&) {
  const auto of = [](const Distances& d) {
    return std::vector{d.of_cbar(2.5), d.of([&](double Ms) { return zeta_of_sensitivity(d.loop, Ms); })};
  };
  return with_correction(of(submersible_distances()), of(submersible_windows()));
}

}  // namespace

std::vector<Maker> dalen2018_makers() {
  return {{"dalen2018/rules", known_rules},     {"dalen2018/pade", pade},       {"dalen2018/eq49", eq49},
          {"dalen2018/references", references}, {"dalen2018/prc", prc},         {"dalen2018/table1", table1},
          {"dalen2018/table2", table2},         {"dalen2018/table3", table3},   {"dalen2018/table4", table4},
          {"dalen2018/table5", table5},         {"dalen2018/table6", table6},   {"dalen2018/table7", table7},
          {"dalen2018/table8", table8},         {"dalen2018/table9", table9},   {"dalen2018/table10", table10},
          {"dalen2018/table11", table11},       {"dalen2018/table12", table12}, {"dalen2018/table13", table13},
          {"dalen2018/table14", table14}};
}

}  // namespace portrait::reproduce
