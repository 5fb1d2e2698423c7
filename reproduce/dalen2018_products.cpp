/// The tables of Dalen2018 on the method product that is best for an index: 1, 3, 4, 5.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/sweep/method.h"
#include "reproduce/dalen2018.h"

namespace portrait::reproduce {
namespace {

using rules::IntegratingPlant;

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
  const SampledPlant plant = sampled_plant(p, dt);
  SampledIndices sum;
  const std::vector<double> both = sampled_run(plant, f, 0, in, 2 * in).error;
  for (std::size_t k = 0; k < both.size(); ++k) {
    const double t = static_cast<double>(k) * dt;
    sum.ITAE += t * std::abs(both[k]), sum.ITSE += t * both[k] * both[k];
  }
  const std::vector<double> alone = sampled_run(plant, f, kNever, 0, in).error;
  for (std::size_t k = 0; k < alone.size(); ++k)
    sum.IAE_vu += std::abs(alone[k]), sum.ITAE_vu += static_cast<double>(k) * dt * std::abs(alone[k]);
  return sum;
}

/// The same along cbar; T_1 is 45 tau, and 20 for k = 1, tau = 0.1.
std::vector<SampledIndices> sampled_along_cbar(std::string_view label) {
  const IntegratingPlant p{number_in_label(label, "k"), number_in_label(label, "tau")};
  const double T1 = p.k == 1 && p.tau == 0.1 ? 20 : 45 * p.tau;
  std::vector<SampledIndices> found;
  for (int i = 0; i <= 50; ++i)
    found.push_back(sampled_indices(p, rules::delta_tuning(p, 1.5 + 0.05 * i, 1.6), T1));
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
    numbers.push_back(
        {{index_of(rows, Measure::Ms), {}},
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
  const MeasureRow& at(int d, int c) const {
    const int number = d * kCbars + c;
    return found[static_cast<std::size_t>(number)].measures;
  }
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

}  // namespace

std::vector<Maker> dalen2018_product_makers() {
  return {{"dalen2018/table1", table1},
          {"dalen2018/table3", table3},
          {"dalen2018/table4", table4},
          {"dalen2018/table5", table5}};
}

}  // namespace portrait::reproduce
