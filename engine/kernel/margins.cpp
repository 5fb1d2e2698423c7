#include "engine/kernel/margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/check.h"
#include "engine/kernel/numerator.h"
#include "engine/loop/loop_measures.h"
#include "engine/loop/stability.h"

namespace portrait::kernel {
namespace {

/// Three integrators: d ln|N|^2/d ln omega^2 < 3 everywhere, so that |L| falls from infinity to 0.
bool falls_everywhere(const Numerator& N) {
  return N.integrators == 3 && N.n1 * N.n1 - 2 * N.n0 * N.n2 > -std::numbers::sqrt3 * N.n0 * N.n2;
}

/// |N|^2 - |D|^2 over omega^2 changes sign once: so many positive roots as its coefficients change sign, by Descartes' rule
/// no more, and with one change just one. |D|^2's own coefficients are all positive.
bool has_one_crossover(const LoopFamily& family, const Setting& s, const Numerator& N) {
  if (N.integrators == 0) return false;
  if (falls_everywhere(N)) return true;
  const double plant_lag = family.plant == Plant::fotd ? s.tau_1 * s.tau_1 : 0;
  const double filter_lag = s.tau_f * s.tau_f, n = family.n;
  const double sum = plant_lag + n * filter_lag;
  const double pairs = n * plant_lag * filter_lag + 0.5 * n * (n - 1) * filter_lag * filter_lag;
  std::array<double, 4> f = {N.n0 * N.n0, N.n1 * N.n1 - 2 * N.n0 * N.n2, N.n2 * N.n2, 0};
  const std::array<double, 3> d = {1, sum, pairs};
  for (std::size_t i = 0, k = static_cast<std::size_t>(N.integrators); i < d.size() && k + i < f.size(); ++i)
    f[k + i] -= d[i];
  if (N.integrators + (plant_lag > 0 ? 1 : 0) + family.n > 2) f[3] = -1;
  int changes = 0;
  double last = 0;
  for (const double c : f) {
    if (c == 0) continue;
    changes += last * c < 0 ? 1 : 0;
    last = c;
  }
  return changes == 1;
}

/// lim |L| at infinity without the filter's vector of lags; inf when N is of higher degree than D.
double end_gain(const LoopFamily& family, const Setting& s, const Numerator& N) {
  const int degree = N.n2 > 0 ? 2 : N.n1 > 0 ? 1 : 0;
  const int excess = degree - N.integrators - family.n - (family.plant == Plant::fotd ? 1 : 0);
  if (excess != 0) return excess < 0 ? 0 : kInf;
  const double top = degree == 2 ? N.n2 : degree == 1 ? N.n1 : N.n0;
  return family.plant == Plant::fotd ? top / s.tau_1 : top;
}

/// Where the largest of |N|'s terms alone would meet omega^k, lags left aside.
double crossover_guess(const Numerator& N) {
  double guess = N.integrators == 1 ? N.n0 : N.integrators == 2 ? std::sqrt(N.n0) : std::cbrt(N.n0);
  if (N.integrators == 2) guess = std::max(guess, N.n1);
  if (N.integrators == 3) guess = std::max({guess, std::sqrt(N.n1), N.n2});
  return guess;
}

class Search {
 public:
  Search(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
         std::span<LoopMargins> results)
      : implementation_(implementation), family_(family), settings_(settings), results_(results) {}

  void run() {
    for (std::size_t i = 0; i < settings_.size(); ++i) sort_in(i);
    for (const auto& of_one_kind : waiting_) find_alike(of_one_kind);
  }

 private:
  /// A neutral loop that is unstable at infinity is done; one crossover waits for others; the rest goes its own way.
  void sort_in(std::size_t i) {
    results_[i] = {};
    const Setting& s = settings_[i];
    const Numerator N = numerator_of(family_, s);
    if (end_gain(family_, s, N) >= 1) return;
    if (has_one_crossover(family_, s, N))
      waiting_[has_integral_action(s) ? 1 : 0].push_back(i);
    else
      results_[i] = one_by_one(i);
  }

  void find_alike(std::span<const std::size_t> which) {
    const auto lanes = static_cast<std::size_t>(implementation_.lanes);
    for (; !which.empty(); which = which.subspan(std::min(lanes, which.size())))
      find_pack(which.first(std::min(lanes, which.size())));
  }

  void find_pack(std::span<const std::size_t> which) {
    MarginPack pack{};
    const Setting& first = settings_[which.front()];
    pack.integrators = numerator_of(family_, first).integrators;
    pack.plant_lags = family_.plant == Plant::fotd ? 1 : 0;
    pack.n = family_.n;
    pack.highest_at_ends = family_.n == 0 && family_.plant != Plant::dipdt;
    for (std::size_t lane = 0; lane < kMaxLanes; ++lane)
      fill_lane(pack, lane, settings_[which[std::min(lane, which.size() - 1)]]);
    MarginResult found;
    implementation_.find_margins(pack, found);
    for (std::size_t lane = 0; lane < which.size(); ++lane)
      results_[which[lane]] = found.done[lane] > 0 ? margins_of(found, lane) : one_by_one(which[lane]);
  }

  void fill_lane(MarginPack& pack, std::size_t lane, const Setting& s) const {
    const Numerator N = numerator_of(family_, s);
    pack.n0[lane] = N.n0, pack.n1[lane] = N.n1, pack.n2[lane] = N.n2;
    pack.tau_1[lane] = pack.plant_lags > 0 ? s.tau_1 : 1;
    pack.tau_f[lane] = pack.n > 0 ? s.tau_f : 1;
    pack.end_gain[lane] = end_gain(family_, s, N);
    pack.crossover_guess[lane] = crossover_guess(N);
  }

  static LoopMargins margins_of(const MarginResult& found, std::size_t lane) {
    LoopMargins m;
    const double phase = found.phase[lane];
    m.stable = phase > -std::numbers::pi;
    if (!m.stable) return m;
    const auto or_infinite = [](double x) { return x < 1e300 ? x : kInf; };
    m.Ms = found.Ms[lane], m.Ms_omega = or_infinite(found.Ms_omega[lane]);
    m.Mt = found.Mt[lane], m.Mt_omega = or_infinite(found.Mt_omega[lane]);
    m.GM = found.gain_above[lane] > 0 ? 1 / found.gain_above[lane] : kInf;
    m.GM_low = 1 / or_infinite(found.gain_below[lane]);
    m.PM = (std::numbers::pi - std::abs(phase)) * 180 / std::numbers::pi;
    m.DM = (std::numbers::pi + phase) / found.crossover[lane];
    return m;
  }

  LoopMargins one_by_one(std::size_t i) const {
    const Loop loop{family_, settings_[i]};
    LoopMargins m;
    m.stable = is_stable(open_loop(loop));
    if (!m.stable) return m;
    MeasureRow row;
    measure_loop(loop, std::nullopt, row);
    m.Ms = row[Measure::Ms], m.Ms_omega = row[Measure::Ms_omega];
    m.Mt = row[Measure::Mt], m.Mt_omega = row[Measure::Mt_omega];
    m.GM = row[Measure::GM], m.GM_low = row[Measure::GM_low], m.PM = row[Measure::PM], m.DM = row[Measure::DM];
    return m;
  }

  const Implementation& implementation_;
  LoopFamily family_;
  std::span<const Setting> settings_;
  std::span<LoopMargins> results_;
  std::array<std::vector<std::size_t>, 2> waiting_;  ///< without and with integral action
};

}  // namespace

void find_margins(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                  std::span<LoopMargins> results) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  Search(implementation, family, settings, results).run();
}

}  // namespace portrait::kernel
