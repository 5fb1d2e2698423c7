/// The tables of the thesis.

#include <cmath>
#include <map>

#include "engine/loop/stability.h"
#include "engine/rules/area_model.h"
#include "engine/rules/step_response_rules.h"
#include "reproduce/loops.h"

namespace portrait::reproduce {
namespace {

using rules::Areas;
using rules::RulePlant;
using Plants = std::map<std::string_view, RulePlant>;

constexpr double kTf = 0.01;

RulePlant integrating(std::vector<double> lags, double Td, double K = 1, Polynomial zeros = {1}) {
  return lag_plant(K, std::move(lags), Td, 1, std::move(zeros));
}
const std::vector<double> kEight(8, 0.25);

const Plants& plants_4_29() {
  static const Plants all = {{"GP1", integrating({1, 0.2}, 0)},
                             {"GP2", integrating({}, 1)},
                             {"GP3", integrating({1, 1, 1, 1}, 0)},
                             {"GP4", integrating({1, 1}, 0, 1, {1, -2})}};
  return all;
}
const Plants& plants_5_45() {
  static const Plants all = {{"GP1", integrating({1, 0.2}, 0.2)},
                             {"GP2", integrating({}, 1)},
                             {"GP3", integrating({1, 1, 1, 1}, 0)},
                             {"GP4", integrating({1, 1}, 0, 1, {1, -2})}};
  return all;
}
const Plants& plants_5_46() {
  static const Plants all = {{"GP1", integrating({4}, 0.5)},
                             {"GP2", integrating({2, 2}, 0.5)},
                             {"GP3", integrating({1, 1, 1, 1}, 0.5)},
                             {"GP4", integrating({0.5}, 4)}};
  return all;
}
const Plants& plants_7_1() {
  static const Plants all = {{"GP1", integrating({1}, 0.05)},
                             {"GP2", integrating({}, 1)},
                             {"GP3", integrating({1, 1}, 1)},
                             {"GP4", integrating(kEight, 0)}};
  return all;
}
const Plants& plants_7_2() {
  static const Plants all = {{"GP1", integrating({}, 1)},
                             {"GP2", integrating({1.35}, 0.35)},
                             {"GP3", integrating({1.5, 1.5}, 1)},
                             {"GP4", integrating({0.4, 0.1, 0.5}, 0.7, 0.5, {1, -0.5})},
                             {"GP5", integrating(kEight, 0)}};
  return all;
}
const RulePlant& plant_6_5() {
  static const RulePlant plant = integrating({1, 1}, 1);
  return plant;
}
const RulePlant& plant_4_12() {
  static const RulePlant plant = integrating({1, 1}, 0);
  return plant;
}
const RulePlant& plant_5_15() {
  static const RulePlant plant = integrating({1, 1}, 0.2);
  return plant;
}

Areas with_filter(const RulePlant& plant) { return rules::filtered(areas_of(plant, 5), kTf, 1); }

// ---------------------------------------------------------------- areas

template <const Plants& (*plants)(), int count, bool filter>
Numbers area_table(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const RulePlant& plant = plants().at(r.label);
    numbers.push_back(row(filter ? with_filter(plant) : areas_of(plant, count), count));
  }
  return numbers;
}
Numbers eq5_16(const PublishedTable&) { return {row(with_filter(plant_5_15()), 5)}; }
Numbers eq6_6(const PublishedTable&) {
  return {row(areas_of(plant_6_5(), 5), 5), row(with_filter(plant_6_5()), 5)};
}

// ---------------------------------------------------------------- PI and PID

ParallelForm pi_of(const RulePlant& plant, double b) {
  return rules::integrating_pi(areas_of(plant, 3), b).value();
}
ParallelForm pid_of(const RulePlant& plant, double b) {
  return rules::integrating_pid(with_filter(plant), b).value();
}

Numbers table4_2(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const ParallelForm f = pi_of(plant_4_12(), number_in_label(r.label, "b"));
    numbers.push_back(row({f.Ki, f.Kp}));
  }
  return numbers;
}

Numbers table4_4(const PublishedTable& table) {
  const Areas A = areas_of(plant_4_12(), 3);
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const double T = rules::residence_time(A, pi_of(plant_4_12(), 0.5), 0.5) * number_in_label(r.label, "KCL");
    const ParallelForm f = rules::integrating_pi_of_speed(A, 0.5, T);
    numbers.push_back(row({f.Kp, f.Ki, T}));
  }
  return numbers;
}

Numbers pi_table(const PublishedTable& table, const Plants& plants, std::initializer_list<double> weights) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    std::vector<double> values;
    for (const double b : weights) {
      const ParallelForm f = pi_of(plants.at(r.label), b);
      values.insert(values.end(), {f.Ki, f.Kp});
    }
    numbers.push_back(row(values, values.size()));
  }
  return numbers;
}
Numbers table4_6(const PublishedTable& t) { return pi_table(t, plants_4_29(), {0, 0.5, 0.9}); }
Numbers table5_10(const PublishedTable& t) { return pi_table(t, plants_5_46(), {0, 0.5}); }

Numbers pid_table(const PublishedTable& table, const Plants& plants, std::initializer_list<double> weights) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    std::vector<double> values;
    for (const double b : weights) {
      const ParallelForm f = pid_of(plants.at(r.label), b);
      values.insert(values.end(), {f.Kp, f.Ki, f.Kd});
    }
    numbers.push_back(row(values, values.size()));
  }
  return numbers;
}
Numbers table5_8(const PublishedTable& t) { return pid_table(t, plants_5_45(), {0, 0.5, 0.7}); }
Numbers table5_12(const PublishedTable& t) { return pid_table(t, plants_5_46(), {0, 0.5}); }
Numbers tableA_13(const PublishedTable& t) { return pid_table(t, plants_7_2(), {0}); }

Numbers by_weight(const PublishedTable& table, const RulePlant& plant, bool derivative) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const double b = number_in_label(r.label, "b");
    const ParallelForm f = derivative ? pid_of(plant, b) : pi_of(plant, b);
    numbers.push_back(derivative ? row({f.Kp, f.Ki, f.Kd}) : row({f.Kp, f.Ki}));
  }
  return numbers;
}
Numbers table5_2(const PublishedTable& t) { return by_weight(t, plant_5_15(), true); }
Numbers eq6_8(const PublishedTable& t) { return by_weight(t, plant_6_5(), false); }
Numbers eq6_9(const PublishedTable& t) { return by_weight(t, plant_6_5(), true); }

Numbers table5_5(const PublishedTable& table) {
  const Areas A = with_filter(plant_5_15());
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const double T = rules::residence_time(A, pid_of(plant_5_15(), 0.5), 0.5) * number_in_label(r.label, "KCL");
    const ParallelForm f = rules::integrating_pid_of_speed(A, 0.5, T).value();
    numbers.push_back(row({f.Kp, f.Ki, f.Kd, T}));
  }
  return numbers;
}
Numbers eq5_22(const PublishedTable&) { return {row({rules::slowest_pid(with_filter(plant_5_15()), 0.5)})}; }

Numbers tableA_5(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const ParallelForm f = pi_of(plants_7_1().at(r.label), 0.5);
    numbers.push_back(row({f.Kp, f.Ki}));
  }
  return numbers;
}

// ---------------------------------------------------------------- models and reference filters

/// GP4 of either list has its dead time given by the user.
rules::AreaModel model_of(const Areas& A, std::optional<double> dead_time) {
  return dead_time ? rules::model_with_dead_time(A, *dead_time) : rules::model_without_zero(A).value();
}
std::optional<double> given_dead_time(const Plants& plants, const std::string& label) {
  if (label != "GP4") return std::nullopt;
  return &plants == &plants_5_45() ? 0.011 : 0.739;
}

/// For e^{-s}/s the thesis has a_1m = 0.0101, and went on with it. The model's areas are A_1 = T + a_1 and
/// A_2 = T^2/2 + a_1 A_1; without the filter a_1 is 0, with it T_F; A_2 - T^2/2 with the filter, not divided by A_1, is what
/// the thesis prints.
bool is_dead_time_alone(const rules::AreaModel& m) { return std::abs(m.a1) < 1e-4; }
double printed_lag(const Areas& with, const Areas& without) {
  const double T = without[1] / without[0];
  return with[2] / with[0] - T * T / 2;
}

Numbers models(const PublishedTable& table, const Plants& plants) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const RulePlant& plant = plants.at(r.label);
    const ParallelForm pd = rules::integrating_pd(with_filter(plant)).value();
    const Areas without = areas_of(plant, 5);
    const rules::AreaModel m = model_of(without, given_dead_time(plants, r.label));
    numbers.push_back(row({pd.Kp, pd.Kd, m.K, m.b1, m.Td, m.a1, m.a2}));
    if (is_dead_time_alone(m)) numbers.back()[5].corrected = printed_lag(with_filter(plant), without);
  }
  return numbers;
}
Numbers table5_13(const PublishedTable& t) { return models(t, plants_5_45()); }
Numbers tableA_14(const PublishedTable& t) { return models(t, plants_7_2()); }

/// b_F2, b_F1 from areas without the filter, as Remark 5.4 has it, and with it.
std::vector<Computed> second_order_filter(const Areas& without, const Areas& with) {
  const ParallelForm pid = rules::integrating_pid(with, 0).value();
  const auto literal = rules::integrating_pd(without);
  const auto [b1, b2] = rules::reference_filter_2(with, pid, rules::integrating_pd(with).value());
  if (!literal) return {{kNaN, b2}, {kNaN, b1}};
  const auto [l1, l2] = rules::reference_filter_2(without, pid, *literal);
  return {{l2, b2}, {l1, b1}};
}

Numbers second_order_filters(const PublishedTable& table, const Plants& plants) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows)
    numbers.push_back(second_order_filter(areas_of(plants.at(r.label), 5), with_filter(plants.at(r.label))));
  return numbers;
}
Numbers table5_14(const PublishedTable& t) { return second_order_filters(t, plants_5_45()); }
Numbers tableA_15(const PublishedTable& t) { return second_order_filters(t, plants_7_2()); }

/// b_F5 .. b_F1 and T_CL. Corrected: T_CL with the filter in its areas, and for a dead time alone the printed a_1m.
std::vector<Computed> higher_filter(const Areas& without, const Areas& with, rules::AreaModel m, double Tf,
                                    double K_CL) {
  const ParallelForm pid = rules::integrating_pid(with, 0).value();
  const auto b = rules::reference_filter_5(m, pid, Tf);
  if (is_dead_time_alone(m)) m.a1 = printed_lag(with, without);
  const auto corrected = rules::reference_filter_5(m, pid, Tf);
  std::vector<Computed> made;
  for (std::size_t i = 5; i-- > 0;) made.push_back({b[i], corrected[i]});
  const auto T = [&](const Areas& A) {
    return 1 / (A[0] * rules::integrating_pd(A).value_or(ParallelForm{kNaN, 0, 0}).Kp * K_CL);
  };
  made.push_back({T(without), T(with)});
  return made;
}

Numbers higher_filters(const PublishedTable& table, const Plants& plants) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const Areas without = areas_of(plants.at(r.label), 5);
    numbers.push_back(higher_filter(without, with_filter(plants.at(r.label)),
                                    model_of(without, given_dead_time(plants, r.label)), kTf, 3));
  }
  return numbers;
}
Numbers table5_15(const PublishedTable& t) { return higher_filters(t, plants_5_45()); }
Numbers tableA_16(const PublishedTable& t) { return higher_filters(t, plants_7_2()); }
Numbers eq6_10(const PublishedTable&) {
  const Areas without = areas_of(plant_6_5(), 5);
  return {higher_filter(without, with_filter(plant_6_5()), model_of(without, {}), kTf, 3)};
}

// ---------------------------------------------------------------- Ms and stability

Numbers figures6(const PublishedTable&) {
  const RulePlant& p = plant_6_5();
  return {row({peak_sensitivity(p, pid(pi_of(p, 0)))}), row({peak_sensitivity(p, pid(pi_of(p, 0.5)))}),
          row({peak_sensitivity(p, pid(pid_of(p, 0), 1, kTf))}),
          row({peak_sensitivity(p, pid(pid_of(p, 0.5), 1, kTf))})};
}

/// Largest alpha of (6.4) without dead time at which the loop of its own tuning is stable.
double largest_alpha(bool derivative, double b) {
  const auto stable = [&](double alpha) {
    RulePlant plant;
    plant.integrators = 1;
    plant.poles = {{1, 1, alpha}};
    const Areas A = areas_of(plant, 5);
    const auto form = derivative ? rules::integrating_pid(A, b) : rules::integrating_pi(A, b);
    if (!form) return false;
    rules::Tuned t = pid(*form, 1, 1e-9);
    if (!derivative) t.n = 0;
    return is_stable(open_loop(rules::general_loop(plant, t)));
  };
  double low = 0.3, high = 1.9;
  for (int i = 0; i < 50; ++i) (stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}
Numbers section6_1(const PublishedTable&) {
  return {row({largest_alpha(false, 0)}), row({largest_alpha(false, 0.5)}), row({largest_alpha(false, 0.9)}),
          row({largest_alpha(true, 0.5)}), row({largest_alpha(true, 0.9)})};
}

/// Largest |S| at 200 frequencies, as far apart on the logarithmic scale, from 0.01 to 10.
double sampled_peak(const RulePlant& plant, const rules::Tuned& tuned) {
  const OpenLoop open = open_loop(rules::general_loop(plant, tuned));
  double peak = 0;
  for (int i = 0; i < 200; ++i)
    peak = std::max(peak, 1 / std::abs(1.0 + response_at(open, std::pow(10, -2 + 3.0 * i / 199))));
  return peak;
}

Numbers chapter7_ms(const PublishedTable&) {
  const auto Ms = [](const char* plant, double Kp, double Ki) {
    return row({peak_sensitivity(plants_7_1().at(plant), pid({Kp, Ki, 0}))});
  };
  const auto own = [](const char* plant) {
    const RulePlant& p = plants_7_1().at(plant);
    return row({peak_sensitivity(p, pid(pi_of(p, 0.5)))});
  };
  const RulePlant& first = plants_7_1().at("GP1");
  const rules::Tuned ali_majhi = pid({12.6898, 2.14342, 0});
  return {Ms("GP1", 5.6676, 1.2633),
          {{peak_sensitivity(first, ali_majhi), sampled_peak(first, ali_majhi)}},
          own("GP2"),
          Ms("GP2", 0.7662, 0.18729),
          own("GP3"),
          Ms("GP3", 0.29137, 0.023165),
          own("GP4")};
}
Numbers chapter7_bounds(const PublishedTable&) {
  Numbers numbers;
  for (const char* plant : {"GP1", "GP2", "GP3", "GP4"}) {
    const RulePlant& p = plants_7_2().at(plant);
    numbers.push_back(row({peak_sensitivity(p, pid(pid_of(p, 0), 1, kTf))}));
  }
  return numbers;
}

// ---------------------------------------------------------------- competitors

rules::Tangent tangent(const RulePlant& plant) {
  Polynomial D{1};
  for (const Polynomial& p : plant.poles) D = product(D, p);
  return rules::steepest_tangent(plant.zeros, D, plant.Td).value();
}

Numbers kappa_tau(const PublishedTable& table, const Plants& plants, bool derivative) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const RulePlant& plant = plants.at(r.label);
    std::vector<double> values;
    for (const bool Ms_2 : {false, true}) {
      const auto w = (derivative ? rules::kappa_tau_pid : rules::kappa_tau_pi)(plant.K, tangent(plant), Ms_2);
      const ParallelForm f = parallel(w.form);
      values.insert(values.end(), {f.Kp, f.Ki});
      if (derivative) values.push_back(f.Kd);
      values.push_back(w.b);
    }
    numbers.push_back(row(values, values.size()));
  }
  return numbers;
}
Numbers tableA_1(const PublishedTable& t) { return kappa_tau(t, plants_7_1(), false); }
Numbers tableA_10(const PublishedTable& t) { return kappa_tau(t, plants_7_2(), true); }

Numbers tableA_2(const PublishedTable&) {
  Numbers numbers;
  for (const auto& [L, T, lags] : {std::tuple{0.05, 1.0, 1}, {1.0, 0.0, 0}, {1.0, 1.0, 2}}) {
    const auto w = rules::taguchi_pi(1, L, T, lags);
    numbers.push_back(row({w.form.Kc, w.form.Kc / w.form.Ti, w.b}));
  }
  return numbers;
}
Numbers tableA_7(const PublishedTable&) {
  Numbers numbers;
  for (const auto& [L, T, lags] : {std::tuple{1.0, 1.0, 0}, {0.35, 1.35, 1}, {1.0, 1.5, 2}}) {
    const auto w = rules::taguchi_pid(1, L, T, lags);
    const ParallelForm f = parallel(w.form);
    numbers.push_back({{f.Kp, f.Kp * T}, {f.Ki, f.Ki * T}, {f.Kd, f.Kd * T}, {w.b, {}}, {w.c, {}}});
  }
  return numbers;
}
Numbers tableA_3(const PublishedTable&) { return {row({0.48 / 5.24})}; }

// ---------------------------------------------------------------- measured

constexpr double kStep = 0.01;  // recovered: the printed digits come out with it

/// Trapezoids, 0 at the first sample.
std::vector<double> integrated(const std::vector<double>& x) {
  std::vector<double> sum(x.size(), 0.0);
  for (std::size_t i = 1; i < x.size(); ++i) sum[i] = sum[i - 1] + 0.5 * kStep * (x[i] + x[i - 1]);
  return sum;
}

/// Answer of (6.5) to a step at 8.
double answer_6_5(double t) {
  const double x = std::max(t - 9, 0.0);
  return x - 2 + (2 + x) * std::exp(-x);
}

/// The thesis' own recipe (section 6.3): slopes from two points, trapezoids from t_1 = 8 to `end`.  [Kos2021 (2.9)-(2.11)]
Areas areas_by_trapezoids(double end) {
  std::vector<double> I, Y;
  for (int i = 0; 8 + i * kStep < end + kStep / 2; ++i) I.push_back(1), Y.push_back(answer_6_5(8 + i * kStep));
  Areas A{(answer_6_5(22) - answer_6_5(14)) / 8};
  std::vector<double> ends{1};
  for (std::size_t k = 1; k <= 4; ++k) {
    I = integrated(I), ends.push_back(I.back());
    if (k > 1) Y = integrated(Y);
    double a = (k % 2 == 0 ? 1 : -1) * Y.back();
    for (std::size_t j = 0; j < k; ++j) a += ((k - 1 - j) % 2 == 0 ? 1 : -1) * A[j] * ends[k - j];
    A.push_back(a);
  }
  return A;
}

Numbers table6_1(const PublishedTable&) {
  const Areas to_t2 = areas_by_trapezoids(14), before_t2 = areas_by_trapezoids(13.99);
  std::vector<Computed> made;
  for (std::size_t i = 0; i < 5; ++i) made.push_back({to_t2[i], before_t2[i]});
  return {made};
}

Numbers chapter8(const PublishedTable&) {
  Numbers numbers;
  for (const Areas& A : {Areas{0.476, 0.994, 1.57}, {0.0044, 0.3651, 17.86}, {0.0204, 4.667, 610.96}}) {
    const ParallelForm f = rules::integrating_pi(A, 0).value();
    numbers.push_back(row({f.Kp, f.Ki, f.Kp / f.Ki}));
  }
  return numbers;
}

const Areas kAmplifier = {-8.5309, -1.0748, -0.0880, -5.7974e-3, -3.1956e-4};
const Areas kAmplifierFiltered = {-8.5309, -1.2454, -0.11291, -8.0556e-3, -4.8067e-4};
constexpr double kAmplifierTf = 0.02;

Numbers eq8_8(const PublishedTable&) { return {row(rules::filtered(kAmplifier, kAmplifierTf, 1), 5)}; }
Numbers eq8_9(const PublishedTable&) {
  const rules::AreaModel m = rules::model_without_zero(kAmplifier).value();
  return {row({m.Td, m.a1, m.a2})};
}
Numbers eq8_10(const PublishedTable&) {
  Numbers numbers;
  for (const double b : {0.0, 0.5}) {
    const ParallelForm f = rules::integrating_pid(kAmplifierFiltered, b).value();
    numbers.push_back(row({f.Kp, f.Ki, f.Kd}));
  }
  return numbers;
}
Numbers eq8_12(const PublishedTable&) {
  return {higher_filter(kAmplifier, kAmplifierFiltered, model_of(kAmplifier, {}), kAmplifierTf, 1.2)};
}
Numbers eq8_13(const PublishedTable&) { return {second_order_filter(kAmplifier, kAmplifierFiltered)}; }

}  // namespace

std::vector<Maker> kos2021_makers() {
  return {{"kos2021/table4.2", table4_2},
          {"kos2021/table4.4", table4_4},
          {"kos2021/table4.5", area_table<plants_4_29, 3, false>},
          {"kos2021/table4.6", table4_6},
          {"kos2021/eq5.16", eq5_16},
          {"kos2021/table5.2", table5_2},
          {"kos2021/table5.5", table5_5},
          {"kos2021/eq5.22", eq5_22},
          {"kos2021/table5.6", area_table<plants_5_45, 5, false>},
          {"kos2021/table5.7", area_table<plants_5_45, 5, true>},
          {"kos2021/table5.8", table5_8},
          {"kos2021/table5.9", area_table<plants_5_46, 3, false>},
          {"kos2021/table5.10", table5_10},
          {"kos2021/table5.11", area_table<plants_5_46, 5, true>},
          {"kos2021/table5.12", table5_12},
          {"kos2021/table5.13", table5_13},
          {"kos2021/table5.14", table5_14},
          {"kos2021/table5.15", table5_15},
          {"kos2021/eq6.6", eq6_6},
          {"kos2021/eq6.8", eq6_8},
          {"kos2021/eq6.9", eq6_9},
          {"kos2021/eq6.10", eq6_10},
          {"kos2021/figures6.11-16", figures6},
          {"kos2021/section6.1", section6_1},
          {"kos2021/table6.1", table6_1},
          {"kos2021/tableA.1", tableA_1},
          {"kos2021/tableA.2", tableA_2},
          {"kos2021/tableA.3", tableA_3},
          {"kos2021/tableA.4", area_table<plants_7_1, 3, false>},
          {"kos2021/tableA.5", tableA_5},
          {"kos2021/tableA.7", tableA_7},
          {"kos2021/tableA.10", tableA_10},
          {"kos2021/tableA.11", area_table<plants_7_2, 5, false>},
          {"kos2021/tableA.12", area_table<plants_7_2, 5, true>},
          {"kos2021/tableA.13", tableA_13},
          {"kos2021/tableA.14", tableA_14},
          {"kos2021/tableA.15", tableA_15},
          {"kos2021/tableA.16", tableA_16},
          {"kos2021/chapter7-ms", chapter7_ms},
          {"kos2021/chapter7-bounds", chapter7_bounds},
          {"kos2021/chapter8", chapter8},
          {"kos2021/eq8.8", eq8_8},
          {"kos2021/eq8.9", eq8_9},
          {"kos2021/eq8.10", eq8_10},
          {"kos2021/eq8.12", eq8_12},
          {"kos2021/eq8.13", eq8_13}};
}

}  // namespace portrait::reproduce
