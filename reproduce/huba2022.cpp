/// The tables of Huba2022 from the rules, the kernel and the expectation of noise.

#include <cmath>
#include <map>

#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/rules/catalogue.h"
#include "engine/rules/real_dominant_poles.h"
#include "engine/sweep/method.h"
#include "reproduce/loops.h"

namespace portrait::reproduce {
namespace {

using rules::PoleSet;
using rules::RealPolesTuning;

constexpr PoleSet kSets[] = {PoleSet::one_modified, PoleSet::two_modified, PoleSet::three_modified};

Numbers pole_table(const PublishedTable& table, PoleSet set) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const RealPolesTuning t = *rules::four_real_poles(set, number_in_label(r.label, "m"));
    numbers.push_back(row({t.p_o, -1 / t.p_o, t.kappa, t.delta / t.kappa, t.tau_i, t.delta, t.kappa / t.tau_i}));
  }
  return numbers;
}
Numbers table1(const PublishedTable& t) { return pole_table(t, kSets[0]); }
Numbers table2(const PublishedTable& t) { return pole_table(t, kSets[1]); }
Numbers table3(const PublishedTable& t) { return pole_table(t, kSets[2]); }

/// Largest of what the poles of a set must make 0.
double residual(const RealPolesTuning& t, PoleSet set, double m) {
  double largest = 0;
  const int of_p_o = m == 1 ? 4 : static_cast<int>(set);
  for (const auto& [p, times] : {std::pair{t.p_o, of_p_o}, {t.p_o / m, 4 - of_p_o}}) {
    const auto P = rules::quasi_polynomial(t, p);
    for (int i = 0; i < times; ++i) largest = std::max(largest, std::abs(P[static_cast<std::size_t>(i)]));
  }
  return largest;
}

/// The printed setting of "Table 2, m = 3".
RealPolesTuning printed_setting(std::string_view number, double m) {
  const PublishedTable& t = *tables_named(std::string("huba2022/table") + std::string(number)).front();
  for (const PrintedRow& r : t.rows)
    if (number_in_label(r.label, "m") == m) {
      const auto cell = [&](std::size_t c) { return printed(*r.cells[c]).value; };
      return {cell(0), cell(2), cell(5), cell(4)};
    }
  return {};
}

Numbers residuals(const PublishedTable& table) {
  Numbers numbers;
  for (const PrintedRow& r : table.rows) {
    const double m = number_in_label(r.label, "m");
    const PoleSet set = kSets[r.label[6] - '1'];
    numbers.push_back(row({residual(printed_setting(r.label.substr(6, 1), m), set, m),
                           residual(*rules::four_real_poles(set, m), set, m)}));
  }
  return numbers;
}

// ---------------------------------------------------------------- loops with a filter: Tables 4 to 6

constexpr double kTf = 0.1, kDeadTime = 1.1, kNoise = 0.01;

struct Filtered {
  double IAE_w, IAE_d, Kd;
};

/// b = factor T_o, T_o of the dead time `b_dead_time`.
Filtered filtered(PoleSet set, double m, double b_times_m, double b_dead_time = kDeadTime) {
  const RealPolesTuning r = *rules::four_real_poles(set, m);
  const double D = kDeadTime;
  Loop loop{{Plant::dipdt, 1, Prefilter::full},
            {.kappa = r.kappa / (D * D), .tau_i = r.tau_i * D, .delta = r.delta / D, .tau_1 = 0, .tau_f = kTf}};
  loop.setting.b = -1 / r.p_o * b_dead_time * b_times_m;
  SettingMeasured found;
  measure_settings(Method::kernel, loop.family, Horizon::fixed(50), {}, {&loop.setting, 1}, {&found, 1});
  return {found.measures[Measure::IAE_w], found.measures[Measure::IAE_d], loop.setting.delta};
}

/// E|n_k - n_{k-1}| of uniform noise within +-a is 2a/3; u follows it through Kd/Tf.
double noise_variation(double Kd, double seconds) { return 2 * kNoise / 3 * Kd / kTf * seconds / 0.001; }

Numbers table4(const PublishedTable&) {
  Numbers numbers;
  for (const PoleSet set : kSets) {
    const Filtered one = filtered(set, 1, 1), unscaled = filtered(set, 1, 1, 1);
    std::array<std::vector<Computed>, 3> r;
    for (const double m : {1.0, 2.0, 3.0, 4.0}) {
      const Filtered plain = filtered(set, m, 1);
      r[0].push_back({plain.IAE_w / one.IAE_w, filtered(set, m, 1, 1).IAE_w / unscaled.IAE_w});
      r[1].push_back({filtered(set, m, m).IAE_w / one.IAE_w, filtered(set, m, m, 1).IAE_w / unscaled.IAE_w});
      r[2].push_back({plain.IAE_d / one.IAE_d, {}});
    }
    numbers.insert(numbers.end(), r.begin(), r.end());
  }
  return numbers;
}

Numbers table5(const PublishedTable&) {
  constexpr PoleSet kSet = PoleSet::two_modified;
  Numbers numbers(12);
  for (const double m : {1.0, 2.0, 3.0, 4.0}) {
    const auto ratios = [&](double b_dead_time) {
      const Filtered one = filtered(kSet, 1, 1, b_dead_time), plain = filtered(kSet, m, 1, b_dead_time);
      const double TV = plain.Kd / one.Kd;
      std::array<double, 12> v = {plain.IAE_w / one.IAE_w,
                                  filtered(kSet, m, m, b_dead_time).IAE_w / one.IAE_w,
                                  plain.IAE_d / one.IAE_d,
                                  TV,
                                  TV,
                                  TV};
      for (std::size_t i = 0; i < 3; ++i) v[6 + i] = v[i] * TV, v[9 + i] = std::pow(v[i], 0.1) * TV;
      return v;
    };
    const auto stated = ratios(kDeadTime), unscaled = ratios(1);
    for (std::size_t i = 0; i < 12; ++i) numbers[i].push_back({stated[i], unscaled[i]});
  }
  return numbers;
}

/// The corrected IAE_w has b = T_o of dead time 1.
Numbers table6(const PublishedTable&) {
  Numbers numbers(4);
  for (const double m : {1.0, 2.0, 3.0, 4.0})
    for (std::size_t k : {0u, 1u}) {
      const double factor = k == 0 ? 1 : m;
      const Filtered f = filtered(PoleSet::two_modified, m, factor);
      numbers[2 * k].push_back({f.IAE_w, filtered(PoleSet::two_modified, m, factor, 1).IAE_w});
      numbers[2 * k + 1].push_back({noise_variation(f.Kd, 50), {}});
    }
  return numbers;
}

Numbers eq42(const PublishedTable&) {
  const rules::RulePlant plant = rules::dipdt(1, 1);
  const rules::Tuned t = rules::tune(rules::rule_named("huba2022-trdp"), plant, {{"Tf", "0.1"}, {"cancel", "To"}});
  const double IAE = rules::measured(plant, t).measures[Measure::IAE_w], Kd = parallel(*t.pid).Kd;
  return {{{IAE, {}}, {noise_variation(Kd, 50), noise_variation(Kd, 20)}}};
}

// ---------------------------------------------------------------- ideal tunings

double setpoint_error(const RealPolesTuning& t, double b) {
  // With the zeros cancelled y_w never turns back, so IAE_w is its area: tau_i (PD: tau_D) less b.
  const double T = std::isinf(t.tau_i) ? t.delta / t.kappa : t.tau_i;
  return T - b;
}

Numbers trdp(const PublishedTable&) {
  const RealPolesTuning t = rules::triple_real_pole();
  const double T_o = -1 / t.p_o;
  std::vector<Computed> r = row({t.p_o, T_o, t.kappa, t.delta, t.delta / t.kappa, setpoint_error(t, T_o)});
  r.push_back({-t.p_o * std::exp(t.p_o), -std::sqrt(2.0) * t.p_o * std::exp(t.p_o)});
  return {r};
}

/// IAE by simulation with a filter so fast that it no longer counts.
Numbers qrdp(const PublishedTable&) {
  const RealPolesTuning t = *rules::four_real_poles(PoleSet::two_modified, 1);
  const double T_o = -1 / t.p_o;
  std::vector<double> IAE;
  double IAE_d = 0;
  for (const auto& [b, c] : {std::pair{0.0, 0.0}, {T_o, 0.0}, {2 * T_o, T_o * T_o}}) {
    const Loop loop{
        {Plant::dipdt, 1, Prefilter::full},
        {.kappa = t.kappa, .tau_i = t.tau_i, .delta = t.delta, .tau_1 = 0, .tau_f = 1e-4, .b = b, .c = c}};
    SettingMeasured found;
    measure_settings(Method::kernel, loop.family, Horizon::until_settled(), {}, {&loop.setting, 1}, {&found, 1});
    IAE.push_back(found.measures[Measure::IAE_w]), IAE_d = found.measures[Measure::IAE_d];
  }
  return {row({t.kappa, t.delta, t.kappa / t.tau_i, t.tau_i, t.delta / t.kappa, t.p_o, T_o, IAE[0], IAE[1], IAE[2],
               IAE_d})};
}

Numbers remark1(const PublishedTable&) {
  const RealPolesTuning three = rules::triple_real_pole(), four = *rules::four_real_poles(PoleSet::two_modified, 1);
  const double T = -1 / four.p_o, PD = setpoint_error(three, -1 / three.p_o);
  return {row({four.kappa / three.kappa, four.delta / three.delta, three.p_o / four.p_o, (four.tau_i - 2 * T) / PD,
               (four.tau_i - T) / PD, four.tau_i / PD})};
}

// ---------------------------------------------------------------- the portrait (43)

Numbers eq47(const PublishedTable&) {
  std::vector<Setting> settings;
  for (int k = 5; k <= 35; ++k)
    for (int d = 7; d <= 21; ++d)
      for (int i = 6; i <= 22; i += 2)
        settings.push_back({.kappa = k / 100.0, .tau_i = double(i), .delta = d / 20.0});
  std::vector<SettingMeasured> found(settings.size());
  measure_settings(Method::kernel, {Plant::dipdt, 0, Prefilter::pi}, Horizon::fixed(80), {}, settings, found);
  std::array<const Setting*, 2> best{};
  std::array<double, 2> least = {kInf, kInf};
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const MeasureRow& m = found[i].measures;
    if (found[i].status != Status::settled || !(m[Measure::TV2_uw] <= 0.1 && m[Measure::TV2_ud] <= 0.1) ||
        !(m[Measure::TV0_yw] <= 0.01 && m[Measure::TV1_yd] <= 0.01))
      continue;
    const double IAE = m[Measure::IAE_w] + m[Measure::IAE_d];
    if (IAE < least[0]) least[0] = IAE, best[0] = &settings[i];
    if (settings[i].delta == 0.35 && IAE < least[1]) least[1] = IAE, best[1] = &settings[i];
  }
  return {row({best[0]->kappa, best[0]->delta, best[0]->tau_i}),
          row({best[1]->kappa, best[1]->delta, best[1]->tau_i})};
}

// ---------------------------------------------------------------- series settings of others

constexpr double kSeries[3][3] = {{0.0354, 0.382, 10.74}, {0.0505, 0.4737, 9.37}, {0.0625, 0.5475, 8.64}};

double Ms_of(const Setting& setting) {
  const OpenLoop open = open_loop(Loop{{Plant::dipdt, 0, Prefilter::pi}, setting});
  return is_stable(open) ? sensitivity_peak(open).value : kInf;
}

/// (52) with delta = kappa_s tau_D, which it leaves as it is.
Setting parallel_setting(const double (&s)[3]) {
  const StandardForm p = standard(SeriesForm{s[0], s[2], s[1] / s[0]});
  return {.kappa = p.Kc, .tau_i = p.Ti, .delta = p.Kc * p.TD};
}

Numbers eq49(const PublishedTable&) {
  Numbers numbers;
  for (const auto& s : kSeries) numbers.push_back(row({Ms_of(parallel_setting(s))}));
  return numbers;
}

/// As printed, Ms is that of the printed row; corrected, that of (52).
Numbers eq50(const PublishedTable& table) {
  Numbers numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    const Setting s = parallel_setting(kSeries[i]);
    const auto cell = [&](std::size_t c) { return printed(*table.rows[i].cells[c]).value; };
    const double Ms_printed = Ms_of({.kappa = cell(0), .tau_i = cell(2), .delta = cell(1)});
    numbers.push_back(
        {{s.kappa, {}}, {s.delta, s.delta * kSeries[i][0] / s.kappa}, {s.tau_i, {}}, {Ms_printed, Ms_of(s)}});
  }
  return numbers;
}

}  // namespace

std::vector<Maker> huba2022_makers() {
  return {{"huba2022/table1", table1},       {"huba2022/table2", table2},   {"huba2022/table3", table3},
          {"huba2022/residuals", residuals}, {"huba2022/table4", table4},   {"huba2022/table5", table5},
          {"huba2022/table6", table6},       {"huba2022/eq42", eq42},       {"huba2022/trdp", trdp},
          {"huba2022/qrdp", qrdp},           {"huba2022/remark1", remark1}, {"huba2022/eq47", eq47},
          {"huba2022/eq49", eq49},           {"huba2022/eq50", eq50}};
}

}  // namespace portrait::reproduce
