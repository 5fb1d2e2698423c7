#include "engine/rules/tuned_loop.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/reference/measure.h"
#include "engine/rules/plants.h"
#include "engine/sweep/method.h"

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

namespace {

TransferFunction prefilter(const Tuned& t) {
  if (t.other_prefilter) return transfer_function(t.other_prefilter->numerator, t.other_prefilter->denominator);
  if (t.prefilter == Prefilter::none || !t.pid) return {};
  const double Ti = t.pid->Ti, TD = t.pid->TD;
  if (t.prefilter == Prefilter::pi)
    return std::isinf(Ti) ? TransferFunction{} : transfer_function({1, t.b * Ti}, {1, Ti});
  return std::isinf(Ti) ? transfer_function({1, t.b}, {1, TD}) : transfer_function({1, t.b, t.c}, {1, Ti, Ti * TD});
}

GeneralController general_controller(const Tuned& t) {
  GeneralController made;
  if (t.pid && t.n == 0 && t.controller.numerator.size() == 3) {
    made = pid_controller(parallel(*t.pid));
  } else {
    TransferFunction C = transfer_function(t.controller.numerator, t.controller.denominator);
    for (int i = 0; i < t.n; ++i) C.denominator.push_back({1, t.Tf});
    made = controller(C);
  }
  made.prefilter = prefilter(t);
  return made;
}

}  // namespace

GeneralLoop general_loop(const RulePlant& plant, const Tuned& tuned) {
  TransferFunction P;
  P.numerator = plant.zeros;
  for (double& a : P.numerator) a *= plant.K;
  P.denominator = plant.poles;
  for (int i = 0; i < plant.integrators; ++i) P.denominator.push_back({0, 1});
  return {{P, plant.Td}, general_controller(tuned)};
}

TunedMeasures measured(const RulePlant& plant, const Tuned& tuned) {
  if (const auto family = tuned_loop(plant, tuned)) {
    SettingMeasured found;
    measure_settings(Method::kernel, family->loop.family, Horizon::until_settled(), {}, {&family->loop.setting, 1},
                     {&found, 1});
    for (const Measure m : all_measures()) found.measures[m] *= scale(m, family->plant);
    return {found.status, found.measures};
  }
  const GeneralLoop loop = general_loop(plant, tuned);
  if (const auto reason = why_invalid(loop)) throw InputError(*reason);
  const reference::Measured found = reference::measure_in_units(loop, Horizon::until_settled()).measured;
  return {found.status, found.measures};
}

}  // namespace portrait::rules
