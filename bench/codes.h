/// The codes that are timed against each other, on the same settings and the same instruction set.
#pragma once

#include <span>
#include <vector>

#include "bench/cases.h"
#include "bench/isa/step_loop.h"
#include "engine/kernel/margins.h"
#include "engine/kernel/responses.h"
#include "engine/measures/columns.h"

namespace portrait::bench {

/// What the program does with a slice of a sweep: stability, every timed measure, status.
void run_engine(const Case& of, std::span<const Setting> settings, MeasureColumns& columns);

/// The part of it that simulates: both responses and what is measured of them.
void run_responses(const Case& of, std::span<const Setting> settings, std::span<kernel::Measured> measured);

/// The other part: stability, peaks and margins.
void run_margins(const Case& of, std::span<const Setting> settings, std::span<kernel::LoopMargins> found);

enum class StepCode {
  scalar,   ///< one setting after the other, 1,000 steps a dead time
  batched,  ///< a register of settings at a time, 50 steps a dead time
};

constexpr int steps(StepCode code) { return code == StepCode::scalar ? 1000 : 50; }

/// REQUIRES: results.size() >= settings.size().
void run_step_loop(StepCode code, const Case& of, std::span<const StepSetting> settings,
                   std::span<BothSteps> results);

std::vector<StepSetting> for_step_loop(std::span<const Setting> settings);

/// The baselines on the instruction set that the engine uses (PORTRAIT_ISA), and on all that this machine has.
const Baseline& chosen_baseline();
std::vector<const Baseline*> available_baselines();

}  // namespace portrait::bench
