#include "engine/rules/tuned_loop.h"

#include "engine/rules/plants.h"

namespace portrait::rules {

std::optional<RealPlant> family_plant(const RulePlant& plant) {
  RealPlant real{.family = Plant::dipdt, .K = plant.K, .Td = plant.Td, .T1 = 0};
  if (is_ipdt(plant))
    real.family = Plant::ipdt;
  else if (is_fotd(plant))
    real.family = Plant::fotd, real.T1 = plant.poles[0][1];
  else if (plant.integrators != 2 || plant.zeros.size() > 1 || !plant.poles.empty())
    return std::nullopt;
  if (why_invalid(real)) return std::nullopt;
  return real;
}

std::optional<TunedLoop> tuned_loop(const RulePlant& plant, const Tuned& t) {
  const auto real = family_plant(plant);
  if (!real || !t.pid || t.other_prefilter) return std::nullopt;
  const LoopFamily family{.plant = real->family, .n = t.n, .prefilter = t.prefilter};
  const RealController controller{.standard = *t.pid, .Tf = t.Tf, .b = t.b, .c = t.c};
  TunedLoop made{{family, normalised(controller, *real, family)}, *real};
  if (why_invalid(made.loop)) return std::nullopt;
  return made;
}

}  // namespace portrait::rules
