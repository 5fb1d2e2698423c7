/// The tables of the HO-PID paper.

#include <cmath>
#include <map>
#include <numbers>

#include "engine/loop/adaptive_integral.h"
#include "engine/rules/magnitude_optimum.h"
#include "reproduce/loops.h"

namespace portrait::reproduce {
namespace {

using rules::Areas;
using rules::RulePlant;

RulePlant plant_of(std::string_view label) {
  static const std::map<std::string_view, RulePlant> plants = {
      {"GP1", lag_plant(1, {1, 1, 1, 1}, 0)},          {"GP2", lag_plant(1, {1, 1}, 0.5)},
      {"GP5", lag_plant(1, {1, 0.5, 1.0 / 3}, 0)},     {"GP6", lag_plant(1.0 / 18, {1, 1.0 / 3, 1.0 / 6}, 0)},
      {"GP7", lag_plant(1, {1, 0.5, 0.25, 0.125}, 0)},
  };
  return plants.at(label.substr(0, 3));
}

const RulePlant& printed_33() {
  static const RulePlant plant = lag_plant(1, {1, 1, 1, 1}, 0.2);
  return plant;
}
const RulePlant& used_33() {
  static const RulePlant plant = lag_plant(1, {1, 1, 1}, 0.5);
  return plant;
}
const Polynomial& filter_47() {
  static const Polynomial filter{1, 0.0132, 5.26e-5};
  return filter;
}

int whole(std::string_view label, const char* name) { return static_cast<int>(number_in_label(label, name)); }

Numbers table1(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows)
    numbers.push_back(row(rules::filtered(areas_of(plant_of(r.label), 10), 0.1, whole(r.label, "n")), 10));
  return numbers;
}

std::vector<double> gains(const RulePlant& plant, int m, double Tf, int n) {
  return rules::magnitude_optimum(rules::filtered(areas_of(plant, rules::areas_for_order(m)), Tf, n), m).value();
}

Numbers table2(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const int m = whole(r.label, "m");
    numbers.push_back(row(gains(plant_of(r.label), m, 0.1, m), 5));
  }
  return numbers;
}

// ---------------------------------------------------------------- prescribed noise gain

constexpr double kSampling = 0.002;

/// Standard deviation of u over that of white noise: mean of |C/(1 + L)|^2 up to half the sampling frequency.   [HO-PID (35)]
double noise_ratio(const RulePlant& plant, const rules::Tuned& t) {
  const OpenLoop open = open_loop(rules::general_loop(plant, t));
  const RulePlant one = lag_plant(1, {}, 0);
  const OpenLoop controller = open_loop(rules::general_loop(one, t));
  const double end = std::numbers::pi / kSampling;
  const auto f = [&](int, double x) {
    const double w = std::exp(x);
    return std::norm(response_at(controller, w) / (1.0 + response_at(open, w))) * w;
  };
  std::vector<Panel> panels;
  for (double x = std::log(1e-5); x < std::log(end); x += 0.25)
    panels.push_back({0, x, std::min(x + 0.25, std::log(end))});
  return std::sqrt(adaptive_integral(panels, f, 1e-8) / end);
}

/// TF, gains, and what comes last in the table.
std::vector<double> design(const RulePlant& plant, const PrintedRow& r, std::size_t columns, bool Ms_last) {
  const int m = whole(r.label, "m"), n = whole(r.label, "n");
  const auto found = rules::magnitude_optimum_for_noise_gain(areas_of(plant, rules::areas_for_order(m)), m, n,
                                                             number_in_label(r.label, "KHF"), kSampling)
                         .value();
  std::vector<double> values{found.Tf};
  values.insert(values.end(), found.gains.begin(), found.gains.end());
  values.resize(columns);
  const rules::Tuned t = rules::tuned(found.gains, n, found.Tf);
  values.back() = Ms_last ? peak_sensitivity(plant, t) : noise_ratio(plant, t);
  return values;
}

Numbers table3(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    std::vector<Computed> made = row(design(printed_33(), r, table.columns.size(), false), table.columns.size());
    const std::vector<double> corrected = design(used_33(), r, table.columns.size(), false);
    for (std::size_t i = 0; i < made.size(); ++i) made[i].corrected = corrected[i];
    numbers.push_back(made);
  }
  return numbers;
}

Numbers table6(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows)
    numbers.push_back(row(design(lag_plant(1, {1, 1, 1}, 1), r, table.columns.size(), true), table.columns.size()));
  return numbers;
}

// ---------------------------------------------------------------- the three cases

struct Case {
  RulePlant plant;
  double Tf;  ///< 0: filter (47) in place of a binomial one
};
const std::map<std::string_view, Case>& cases() {
  static const std::map<std::string_view, Case> all = {
      {"GP5", {plant_of("GP5"), 0.01}}, {"GP6", {plant_of("GP6"), 0.005}}, {"GP7", {plant_of("GP7"), 0}}};
  return all;
}

std::vector<double> case_gains(const Case& c, int m) {
  if (c.Tf > 0) return gains(c.plant, m, c.Tf, m);
  RulePlant with_filter = c.plant;
  with_filter.poles.push_back(filter_47());
  return gains(with_filter, m, 0, 0);
}

Numbers eq41(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows)
    numbers.push_back(row(case_gains(cases().at(r.label.substr(0, 3)), whole(r.label, "m")), 5));
  return numbers;
}

rules::Tuned case_controller(const Case& c, const std::vector<double>& gains, int n) {
  if (c.Tf > 0) return rules::tuned(gains, n, c.Tf);
  rules::Tuned t = rules::tuned(gains, 0, 0);
  t.pid.reset();
  t.controller.denominator = product({0, 1}, filter_47());
  return t;
}

/// int e^2 dt = (1/pi) int |E(jw)|^2 dw with E = S F_R/s for a setpoint step, S P/s for a disturbance step.
double squared_error(const Case& c, const rules::Tuned& t, bool tracking) {
  constexpr double kTFR = 0.01;
  const OpenLoop open = open_loop(rules::general_loop(c.plant, t));
  rules::Tuned unit;
  unit.controller = {{1}, {1}};
  const OpenLoop plant = open_loop(rules::general_loop(c.plant, unit));
  const auto f = [&](int, double x) {
    const double w = std::exp(x);
    const std::complex<double> s(0, w), S = 1.0 / (1.0 + response_at(open, w));
    const std::complex<double> E = tracking ? S / std::pow(1.0 + kTFR * s, 2) / s : S * response_at(plant, w) / s;
    return std::norm(E) * w;
  };
  std::vector<Panel> panels;
  for (double x = std::log(1e-8); x < std::log(1e7); x += 0.25) panels.push_back({0, x, x + 0.25});
  return adaptive_integral(panels, f, 1e-9) / std::numbers::pi;
}

Numbers squared_errors(const Case& c, const std::vector<rules::Tuned>& controllers) {
  Numbers numbers;
  for (const bool tracking : {true, false}) {
    std::vector<double> values;
    for (const rules::Tuned& t : controllers) values.push_back(squared_error(c, t, tracking));
    numbers.push_back(row(values, values.size()));
  }
  return numbers;
}

Numbers table7(const PublishedTable&) {
  const Case& c = cases().at("GP5");
  return squared_errors(c, {case_controller(c, case_gains(c, 2), 2), case_controller(c, case_gains(c, 3), 3),
                            case_controller(c, {2.20, 3.60, 1.60, 0.06}, 2)});
}
Numbers table8(const PublishedTable&) {
  const Case& c = cases().at("GP6");
  return squared_errors(c, {case_controller(c, case_gains(c, 2), 2), case_controller(c, case_gains(c, 3), 3),
                            case_controller(c, {529.8, 516.5, 179.2, 26.3}, 2)});
}
Numbers table9(const PublishedTable&) {
  const Case& c = cases().at("GP7");
  return squared_errors(
      c, {case_controller(c, case_gains(c, 2), 2), case_controller(c, {1.647, 2.684, 1.105, -2.65e-3}, 2)});
}

}  // namespace

std::vector<Maker> ho_pid_makers() {
  return {{"ho-pid/table1", table1}, {"ho-pid/table2", table2}, {"ho-pid/table3", table3},
          {"ho-pid/table4", table3}, {"ho-pid/table5", table3}, {"ho-pid/table6", table6},
          {"ho-pid/eq41", eq41},     {"ho-pid/table7", table7}, {"ho-pid/table8", table8},
          {"ho-pid/table9", table9}};
}

}  // namespace portrait::reproduce
