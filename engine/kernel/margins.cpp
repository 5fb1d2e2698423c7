#include "engine/kernel/margins.h"

#include <array>

#include "engine/base/check.h"
#include "engine/kernel/cascade_margins.h"
#include "engine/kernel/resolution.h"
#include "engine/loop/stability.h"

namespace portrait::kernel {
namespace {

void fill_lane(MarginPack& pack, std::size_t lane, const Loop& loop) {
  const Setting& s = loop.setting;
  const double lag = plant_lags(loop).time;
  pack.kappa[lane] = s.kappa, pack.tau_i[lane] = s.tau_i, pack.delta[lane] = s.delta;
  pack.tau_1[lane] = lag, pack.tau_f[lane] = s.tau_f;
}

LoopMargins margins_of(const MarginResult& found, std::size_t lane) {
  LoopMargins m;
  m.stable = found.stable[lane] > 0;
  if (!m.stable) return m;
  take_lane(found, lane, m.measures);
  m.measures[Measure::PM] = found.PM[lane], m.measures[Measure::DM] = found.DM[lane];
  return m;
}

LoopMargins one_by_one(const Loop& loop) {
  LoopMargins m;
  m.stable = is_stable(open_loop(loop));
  if (m.stable) take_exact(loop, m.measures);
  return m;
}

class Search {
 public:
  Search(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
         std::span<LoopMargins> results)
      : implementation_(implementation), family_(family), settings_(settings), results_(results) {}

  void run() {
    find_alike(false);
    find_alike(true);
  }

 private:
  void find_alike(bool integral) {
    pack_.plant = plant_kind(family_), pack_.n = family_.n, pack_.integral = integral;
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      if (has_integral_action(settings_[i]) != integral) continue;
      which_[filled_] = i;
      fill_lane(pack_, filled_++, {family_, settings_[i]});
      if (filled_ == static_cast<std::size_t>(implementation_.lanes)) find_pack();
    }
    if (filled_ > 0) find_pack();
  }

  void find_pack() {
    for (std::size_t lane = filled_; lane < kMaxLanes; ++lane)
      fill_lane(pack_, lane, {family_, settings_[which_[filled_ - 1]]});
    MarginResult found;
    implementation_.find_margins(pack_, found);
    for (std::size_t lane = 0; lane < filled_; ++lane) {
      const std::size_t i = which_[lane];
      results_[i] = found.known[lane] > 0 ? margins_of(found, lane) : one_by_one({family_, settings_[i]});
    }
    filled_ = 0;
  }

  const Implementation& implementation_;
  LoopFamily family_;
  std::span<const Setting> settings_;
  std::span<LoopMargins> results_;
  MarginPack pack_{};
  std::array<std::size_t, kMaxLanes> which_{};
  std::size_t filled_ = 0;
};

}  // namespace

void find_margins(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                  std::span<LoopMargins> results, bool wanted) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  if (plant_kind(family) == PlantKind::cascade)
    find_cascade_margins(implementation, family, settings, results, wanted);
  else
    Search(implementation, family, settings, results).run();
}

}  // namespace portrait::kernel
