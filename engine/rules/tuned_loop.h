/// The loop that a rule's controller makes with its plant: normalised where the families of loop.h have it, general otherwise.
#pragma once

#include <optional>

#include "engine/base/status.h"
#include "engine/loop/general_loop.h"
#include "engine/loop/real_plant.h"
#include "engine/measures/catalogue.h"
#include "engine/rules/rule.h"

namespace portrait::rules {

/// A loop and the plant whose units it was normalised by.
struct TunedLoop {
  Loop loop;
  RealPlant plant;
};

/// dipdt, ipdt and fotd; nothing for other plants, without dead time, or with one of no family.
std::optional<RealPlant> family_plant(const RulePlant& plant);

/// Nothing when the plant or the controller belongs to no family, or the loop cannot be simulated.
std::optional<TunedLoop> tuned_loop(const RulePlant& plant, const Tuned& tuned);

/// The loop with any plant and controller of the rules, in the plant's units. REQUIRES: the plant's K is finite and not 0.
GeneralLoop general_loop(const RulePlant& plant, const Tuned& tuned);

/// Every measure in the plant's units, both steps of size one: by the kernel where the loop is one of the families, by the
/// reference simulation otherwise. Throws InputError for a loop that cannot be simulated.
struct TunedMeasures {
  Status status = Status::not_computed;
  MeasureRow measures;  ///< all NaN when unstable
};
TunedMeasures measured(const RulePlant& plant, const Tuned& tuned);

}  // namespace portrait::rules
