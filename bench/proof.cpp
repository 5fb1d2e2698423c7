#include "bench/proof.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/codes.h"
#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"

namespace portrait::bench {
namespace {

constexpr std::size_t kProved = 7;
constexpr Tolerance kEngine = {1e-8, 1e-7}, kScalar = {1e-6, 1e-6};

bool is_place(Measure m) { return m == Measure::Ms_omega || m == Measure::Mt_omega; }

/// Integrals of the error and properties of the loop, but for the places of peaks, which are flat there.
bool is_integral(Measure m) { return to_string(m).front() == 'I' || (info(m).step == '-' && !is_place(m)); }

/// What an error in `m` is a part of.
double scale_of(Measure m, const MeasureRow& truth) {
  if (is_integral(m) || is_place(m)) return std::abs(truth[m]);
  const std::string name(to_string(m));
  // "TV2_uw", "u_max_w": the signal and the step.
  const std::string signal =
      name.starts_with("TV") ? name.substr(name.find('_') + 1) : name.substr(0, 1) + name.back();
  const auto variation = measure_named("TV_" + signal);
  PORTRAIT_CHECK(variation.has_value());
  return truth[*variation];
}

MeasureRow row_of(const MeasureColumns& columns, std::size_t setting) {
  MeasureRow row;
  for (std::size_t k = 0; k < columns.kept.size(); ++k) row[columns.kept[k]] = columns.values[k][setting];
  return row;
}

MeasureRow row_of(const BothSteps& steps) {
  MeasureRow row;
  row[Measure::IAE_w] = steps.w.iae, row[Measure::TV_yw] = steps.w.tv_y, row[Measure::TV_uw] = steps.w.tv_u;
  row[Measure::IAE_d] = steps.d.iae, row[Measure::TV_yd] = steps.d.tv_y, row[Measure::TV_ud] = steps.d.tv_u;
  return row;
}

const std::vector<Measure> kStepMeasures = {Measure::IAE_w, Measure::IAE_d, Measure::TV_yw,
                                            Measure::TV_uw, Measure::TV_yd, Measure::TV_ud};

std::vector<Setting> settings_to_prove(const Case& of) {
  std::vector<Setting> chosen;
  for (std::size_t i = 0; i < kProved; ++i)
    chosen.push_back(of.settings[i * (of.settings.size() - 1) / (kProved - 1)]);
  return chosen;
}

double prove_step_code(StepCode code, const char* name, const Case& of, const std::vector<Setting>& settings,
                       const std::vector<reference::Measured>& truth, const Tolerance& tolerance) {
  std::vector<BothSteps> found(settings.size());
  run_step_loop(code, of, for_step_loop(settings), found);
  double worst = 0;
  for (std::size_t i = 0; i < settings.size(); ++i)
    worst = std::max(worst, prove(of.name + "/" + name, {of.grid.family, settings[i]}, kStepMeasures,
                                  row_of(found[i]), truth[i].measures, tolerance));
  return worst;
}

double prove_engine(const Case& of, const std::vector<Setting>& settings,
                    const std::vector<reference::Measured>& truth) {
  MeasureColumns columns(timed_measures(), settings.size());
  run_engine(of, settings, columns);
  double worst = 0;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Loop loop{of.grid.family, settings[i]};
    if (columns.status[i] != truth[i].status)
      throw WrongAnswer(fmt::format("{}/engine: status is {}, the reference says {}\nreproduce: {}", of.name,
                                    to_string(columns.status[i]), to_string(truth[i].status),
                                    simulate_command(loop)));
    worst = std::max(
        worst, prove(of.name + "/engine", loop, columns.kept, row_of(columns, i), truth[i].measures, kEngine));
  }
  return worst;
}

}  // namespace

double prove(const std::string& code, const Loop& loop, const std::vector<Measure>& measures,
             const MeasureRow& found, const MeasureRow& truth, const Tolerance& tolerance) {
  double worst = 0;
  for (const Measure m : measures) {
    const double error = found[m] == truth[m] ? 0 : std::abs(found[m] - truth[m]) / scale_of(m, truth);
    const double allowed = is_integral(m) ? tolerance.integral : tolerance.variation;
    // Not "error > allowed": a NaN is wrong as well.
    if (!(error <= allowed))
      throw WrongAnswer(
          fmt::format("{}: {} is {}, the reference says {}: off by {:.1e}, allowed {:.0e}\nreproduce: {}", code,
                      to_string(m), found[m], truth[m], error, allowed, simulate_command(loop)));
    worst = std::max(worst, error);
  }
  return worst;
}

Proof prove_answers(const Case& of) {
  const std::vector<Setting> settings = settings_to_prove(of);
  std::vector<reference::Measured> truth;
  for (const Setting& s : settings) truth.push_back(reference::measure({of.grid.family, s}, of.grid.horizon));
  return {.engine = prove_engine(of, settings, truth),
          .scalar = prove_step_code(StepCode::scalar, "scalar", of, settings, truth, kScalar),
          .batched = prove_step_code(StepCode::batched, "batched", of, settings, truth,
                                     {of.batched_tolerance, of.batched_tolerance})};
}

}  // namespace portrait::bench
