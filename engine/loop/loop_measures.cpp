#include "engine/loop/loop_measures.h"

#include "engine/loop/margins.h"
#include "engine/loop/noise_gain.h"
#include "engine/loop/sensitivity.h"

namespace portrait {

void measure_loop(const Loop& loop, std::optional<double> sampling, MeasureRow& row) {
  measure_loop(open_loop(loop), row);
  if (sampling) row[Measure::noise_gain] = noise_gain(loop, *sampling);
}

void measure_loop(const OpenLoop& open, MeasureRow& row) {
  const Peak s = sensitivity_peak(open), t = complementary_sensitivity_peak(open);
  row[Measure::Ms] = s.value;
  row[Measure::Mt] = t.value;
  row[Measure::Ms_omega] = s.omega;
  row[Measure::Mt_omega] = t.omega;
  const Margins m = margins(open);
  row[Measure::GM] = m.gain;
  row[Measure::GM_low] = m.gain_low;
  row[Measure::PM] = m.phase_deg;
  row[Measure::DM] = m.delay;
}

}  // namespace portrait
