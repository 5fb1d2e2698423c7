/// Controllers PID^m_n with derivatives up to any order, by the magnitude optimum.                           [HO-PID]

#include <fmt/format.h>

#include "engine/rules/families.h"
#include "engine/rules/magnitude_optimum.h"

namespace portrait::rules {
namespace {

constexpr std::string_view kName = "ho-pid";
constexpr int kHighestOrder = 8;

NoiseGainDesign design(const RulePlant& plant, const Choices& choices, int m, int n) {
  const Areas areas = areas_of(plant, areas_for_order(m));
  constexpr const char* kSingular =
      "the controller could cancel the whole plant, and no finite gains are optimal: give a filter, or a lower --m";
  if (choices.has("KHF")) {
    if (n < 1) fail_precondition(kName, "a noise gain needs a filter: --n 1 or more");
    const auto found =
        magnitude_optimum_for_noise_gain(areas, m, n, choices.positive("KHF"), choices.positive("Ts"));
    if (!found)
      fail_precondition(kName, "no filter constant gives this noise gain with gains that are optimal for it");
    return *found;
  }
  const double Tf = n >= 1 ? choices.positive("Tf") : 0;
  const auto gains = magnitude_optimum(filtered(areas, Tf, n), m);
  if (!gains) fail_precondition(kName, kSingular);
  return {Tf, *gains};
}

Tuned ho_pid(const RulePlant& plant, const Choices& choices) {
  if (plant.integrators != 0)
    fail_precondition(kName, "it needs a self-regulating plant; kos2021-pi and kos2021-pid are for one integrator");
  const int m = choices.whole("m", 0, kHighestOrder);
  const int n = choices.has("n") ? choices.whole("n", 0, kMaxFilterOrder) : m;
  if (n < m) fail_precondition(kName, fmt::format("the filter must be of order m or more (m = {}, n = {})", m, n));
  const NoiseGainDesign found = design(plant, choices, m, n);
  Tuned t = tuned(found.gains, n, found.Tf);
  if (choices.has("TFR")) t.other_prefilter = Quotient{{1}, lag_power(choices.positive("TFR"), 2)};
  for (std::size_t i = 0; i < found.gains.size(); ++i)
    t.findings.push_back({i == 0 ? "K_-1" : fmt::format("K_{}", i - 1), found.gains[i]});
  t.findings.push_back({"Tf", found.Tf});
  return t;
}

}  // namespace

std::vector<Rule> ho_pid_rules() {
  return {{kName,
           "PID with m derivatives",
           "any without integrator, or a recorded response",
           "|closed loop| = 1 from low frequencies on, filter constant given or by noise gain",
           "HO-PID (7)-(32)",
           {{"m", "order of the highest derivative, 0 .. 8", "1"},
            {"n", "order of the filter, m or more (without it: m)", ""},
            {"Tf", "time constant of the filter 1/(Tf s + 1)^n", ""},
            {"KHF", "noise gain, in place of --Tf", ""},
            {"Ts", "sampling time, for --KHF", ""},
            {"TFR", "time constant of the reference filter 1/(TFR s + 1)^2", ""}},
           ho_pid}};
}

}  // namespace portrait::rules
