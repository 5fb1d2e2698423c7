/// The loop that a rule's controller makes with its plant, as far as the normalised families of loop.h have it.
#pragma once

#include <optional>

#include "engine/loop/real_plant.h"
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

}  // namespace portrait::rules
