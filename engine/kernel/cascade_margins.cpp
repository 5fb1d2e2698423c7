#include "engine/kernel/cascade_margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/loop/loop_measures.h"
#include "engine/loop/margins.h"
#include "engine/loop/open_loop.h"
#include "engine/loop/stability.h"

namespace portrait::kernel {
namespace {

/// The lanes' sine takes less than 1e5.
constexpr double kHighestCrossover = 1e3;
/// Extremes of |L| are roots of polynomials that have lost some digits: this much is left for them.
constexpr double kSlack = 1e-6;

double squared(double x) { return x * x; }

double all_lags(const Loop& loop) {
  const PlantLags lags = plant_lags(loop);
  return 1 + lags.count * lags.time + loop.family.n * loop.setting.tau_f;
}

/// x up to which every second coefficient, from c_first on, sums up to no less than 0: the largest for which the negative ones
/// take no more than their share of c_first.
double positive_up_to(const Polynomial& c, std::size_t first) {
  if (first >= c.size()) return kInf;
  int negative = 0;
  const auto sign = [&](std::size_t i) { return (i - first) / 2 % 2 == 0 ? 1.0 : -1.0; };
  for (std::size_t i = first; i < c.size(); i += 2) negative += sign(i) * c[i] < 0 ? 1 : 0;
  double x = kInf;
  for (std::size_t i = first; i < c.size(); i += 2)
    if (sign(i) * c[i] < 0)
      x = std::min(
          x, std::pow(std::max(0.0, c[first]) / (negative * std::abs(c[i])), 2.0 / static_cast<double>(i - first)));
  return x;
}

/// While N is in the first quadrant, arg L is above -k pi/2 - lags w.
double leading(const Loop& loop, const Polynomial& c, int integrators) {
  if (integrators > 1) return 0;
  const double straight = (integrators == 0 ? 1 : 0.5) * std::numbers::pi / all_lags(loop);
  return std::min({squared(straight), positive_up_to(c, 0), positive_up_to(c, 1)});
}

double resting(const Loop& loop, const Polynomial& c) {
  double sum = all_lags(loop);
  for (std::size_t i = 1; i < c.size(); ++i) sum += std::pow(std::abs(c[i]) / c[0], 1.0 / static_cast<double>(i));
  return 1e-3 / sum;
}

/// Where |L| rises, as CascadeMarginPack has it.
struct Rise {
  double from, to, top;
};

Rise rise(const OpenLoop& open) {
  const std::vector<double> extremes = gain_extremes(open);
  const double end = high_frequency_gain(open), at_rest = low_frequency_gain(open);
  Rise found{kInf, 0, squared(end)};
  if (extremes.empty()) return at_rest < end ? Rise{0, kInf, squared(end)} : found;
  const double first = gain_at(open, extremes.front()), last = gain_at(open, extremes.back());
  found.from = at_rest < first ? 0 : squared(extremes.front()) * (1 - kSlack);
  found.to = last < end ? kInf : squared(extremes.back()) * (1 + kSlack);
  for (const double omega : extremes) found.top = std::max(found.top, squared(gain_at(open, omega)) * (1 + kSlack));
  return found;
}

class CascadeSearch {
 public:
  CascadeSearch(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                std::span<LoopMargins> results)
      : implementation_(implementation), family_(family), settings_(settings), results_(results) {}

  void run(bool wanted) {
    for (const bool integral : {false, true}) {
      for (std::size_t i = 0; i < settings_.size(); ++i)
        if (has_integral_action(settings_[i]) == integral) find(i, wanted);
      if (filled_ > 0) find_pack();
    }
  }

 private:
  void find(std::size_t i, bool wanted) {
    const Loop loop{family_, settings_[i]};
    const OpenLoop open = open_loop(loop);
    const std::vector<double> crossovers = gain_crossovers(open);
    results_[i].stable = is_stable(open, crossovers);
    if (!results_[i].stable || !wanted) return;
    const Polynomial numerator = controller_numerator(loop);
    const bool once = crossovers.empty() || (crossovers.size() == 1 && crossovers[0] < kHighestCrossover);
    if (!once || !(numerator[0] > 0)) {
      take_exact(loop, results_[i].measures);
      return;
    }
    const PhaseMargins turn = phase_margins(open, crossovers);
    results_[i].measures[Measure::PM] = turn.phase_deg, results_[i].measures[Measure::DM] = turn.delay;
    fill_lane(filled_, loop, open, numerator, crossovers.empty() ? 0 : crossovers[0]);
    which_[filled_++] = i;
    if (filled_ == static_cast<std::size_t>(implementation_.lanes)) find_pack();
  }

  void fill_lane(std::size_t lane, const Loop& loop, const OpenLoop& open, const Polynomial& numerator,
                 double crossover) {
    const PlantLags lags = plant_lags(loop);
    pack_.degree = static_cast<int>(numerator.size()) - 1, pack_.integrators = open.integrators;
    pack_.lags = lags.count, pack_.filters = family_.n;
    for (std::size_t i = 0; i < numerator.size(); ++i) pack_.numerator[i][lane] = numerator[i];
    pack_.lag[lane] = lags.time, pack_.tau_f[lane] = loop.setting.tau_f;
    pack_.rest[lane] = resting(loop, numerator), pack_.leads[lane] = leading(loop, numerator, open.integrators);
    const Rise of_gain = rise(open);
    pack_.rises_from[lane] = of_gain.from, pack_.rises_to[lane] = of_gain.to, pack_.top[lane] = of_gain.top;
    pack_.crossover[lane] = crossover, pack_.end[lane] = high_frequency_gain(open);
  }

  /// Lanes left over repeat the last one.
  void fill_up() {
    const std::size_t last = filled_ - 1;
    const auto repeat = [&](PackColumn& column) { std::fill(column + filled_, column + kMaxLanes, column[last]); };
    for (PackColumn& c : pack_.numerator) repeat(c);
    for (PackColumn* c : {&pack_.lag, &pack_.tau_f, &pack_.rest, &pack_.leads, &pack_.crossover, &pack_.rises_from,
                          &pack_.rises_to, &pack_.top, &pack_.end})
      repeat(*c);
  }

  void find_pack() {
    fill_up();
    MarginResult found;
    implementation_.find_cascade_margins(pack_, found);
    for (std::size_t lane = 0; lane < filled_; ++lane) {
      const std::size_t i = which_[lane];
      if (found.known[lane] > 0)
        take_lane(found, lane, results_[i].measures);
      else
        take_exact({family_, settings_[i]}, results_[i].measures);
    }
    filled_ = 0;
  }

  const Implementation& implementation_;
  LoopFamily family_;
  std::span<const Setting> settings_;
  std::span<LoopMargins> results_;
  CascadeMarginPack pack_{};
  std::array<std::size_t, kMaxLanes> which_{};
  std::size_t filled_ = 0;
};

}  // namespace

void take_lane(const MarginResult& found, std::size_t lane, MarginRow& row) {
  row[Measure::Ms] = found.Ms[lane], row[Measure::Ms_omega] = found.Ms_omega[lane];
  row[Measure::Mt] = found.Mt[lane], row[Measure::Mt_omega] = found.Mt_omega[lane];
  row[Measure::GM] = found.GM[lane], row[Measure::GM_low] = found.GM_low[lane];
}

void take_exact(const Loop& loop, MarginRow& row) {
  MeasureRow all;
  measure_loop(loop, std::nullopt, all);
  for (const Measure measure : kMarginMeasures) row[measure] = all[measure];
}

void find_cascade_margins(const Implementation& implementation, const LoopFamily& family,
                          std::span<const Setting> settings, std::span<LoopMargins> results, bool wanted) {
  CascadeSearch(implementation, family, settings, results).run(wanted);
}

}  // namespace portrait::kernel
