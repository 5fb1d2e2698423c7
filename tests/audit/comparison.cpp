#include "tests/audit/comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace portrait::audit {
namespace {

std::optional<Kind> kind_of(Measure m) {
  const std::string_view name = to_string(m);
  if (m == Measure::Ms_omega || m == Measure::Mt_omega || m == Measure::noise_gain) return std::nullopt;
  if (info(m).step == '-') return Kind::margins;
  return name.starts_with("I") ? Kind::integrals : Kind::variations;
}

/// Of the signal that a variation or a peak belongs to: TV_uw for u_max_w.
double variation_of_signal(const MeasureRow& row, Measure m) {
  const std::string name(to_string(m));
  const char signal = name.starts_with("TV") ? name[name.find('_') + 1] : name[0];
  return row[*measure_named(std::string("TV_") + signal + name.back())];
}

double error_of(Measure m, Kind kind, double found, const MeasureRow& truth) {
  const double right = truth[m];
  if (found == right || (std::isnan(found) && std::isnan(right))) return 0;
  const double off = std::abs(found - right);
  if (!std::isfinite(off)) return kInf;
  const double variation = kind == Kind::variations ? variation_of_signal(truth, m) : 0;
  return off / std::max({1e-3, std::abs(right), variation});
}

}  // namespace

WorstOfKinds compared(const MeasureRow& found, const MeasureRow& truth) {
  WorstOfKinds worst;
  for (const Measure m : standard_measures()) {
    const std::optional<Kind> kind = kind_of(m);
    if (!kind) continue;
    Worst& of_kind = worst[static_cast<std::size_t>(*kind)];
    const double error = error_of(m, *kind, found[m], truth);
    if (error >= of_kind.error) of_kind = {error, found[m], truth[m], m, 0, {}};
  }
  return worst;
}

bool exceeds(const WorstOfKinds& worst) {
  for (std::size_t k = 0; k < kKinds; ++k)
    if (worst[k].error > kAllowed[k]) return true;
  return false;
}

LoopErrors audited(const Loop& loop, int dead_times) {
  LoopErrors e;
  for (std::size_t method = 0; method < kMethods; ++method)
    measure_settings(static_cast<Method>(method), loop.family, Horizon::fixed(dead_times), {}, {&loop.setting, 1},
                     {&e.measured[method], 1});
  for (const int fineness : {1, 4}) {  // what a raster missed is no error of others
    e.truth = measured_independently(loop, dead_times, fineness);
    bool exceeded = false;
    for (std::size_t method = 0; method < kMethods; ++method) {
      e.worst[method] = compared(e.measured[method].measures, e.truth.measures);
      exceeded = exceeded || exceeds(e.worst[method]);
    }
    if (!exceeded) break;
  }
  return e;
}

}  // namespace portrait::audit
