#include "engine/rules/catalogue.h"

#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/rules/areas.h"
#include "engine/rules/magnitude_optimum.h"
#include "engine/rules/tuned_loop.h"

namespace portrait::rules {
namespace {

std::string error_of(const char* rule, const RulePlant& plant,
                     const std::map<std::string, std::string>& options = {}) {
  try {
    tune(rule_named(rule), plant, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Catalogue, NamesAreUniqueAndEveryRuleSaysWhereItComesFrom) {
  std::set<std::string_view> names;
  for (const Rule& rule : catalogue()) {
    EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_FALSE(rule.source.empty() || rule.line.empty() || rule.plants.empty()) << rule.name;
  }
  EXPECT_GE(names.size(), 30u);
}

/// Huba2021 (36): one half of the filter's lags goes to the plant's, the other to its dead time, which takes both where there is
/// no lag. Kc is T_j/(K (j T_c + T_d)), T_c = T_d; of a dead time alone Ki is 1/(2 K T_d).
TEST(ModelBasedRule, SharesTheFilterBetweenLagsAndDeadTime) {
  const auto found = [](int j) {
    const Tuned t = tune(rule_named("huba2021-jrm"), jotd(2, 1, 3, j), {{"Tf", "0.2"}, {"n", "3"}});
    std::map<std::string, double> by_name;
    for (const auto& [name, value] : t.findings) by_name[std::string(name)] = value;
    return by_name;
  };
  auto none = found(0), two = found(2);
  EXPECT_NEAR(none["Td_used"], 1.6, 1e-15);
  EXPECT_NEAR(none["Ki"], 1 / (2 * 2 * 1.6), 1e-15);
  EXPECT_NEAR(two["Td_used"], 1.3, 1e-15);
  EXPECT_NEAR(two["Tj"], 3.15, 1e-15);
  EXPECT_NEAR(two["Kc"], 3.15 / (2 * 3 * 1.3), 1e-15);
}

/// Chien1990: T_c = sqrt(10) tau unless it is given, K_c = (2 T_c + tau)/(k (T_c + tau)^2), T_i = 2 T_c + tau.
TEST(ImcPi, HasAnUsualTimeConstant) {
  const Tuned usual = tune(rule_named("imc-pi"), ipdt(2, 0.5), {});
  const double Tc = std::sqrt(10.0) * 0.5;
  ASSERT_TRUE(usual.pid);
  EXPECT_NEAR(usual.pid->Kc, (2 * Tc + 0.5) / (2 * (Tc + 0.5) * (Tc + 0.5)), 1e-15);
  EXPECT_NEAR(usual.pid->Ti, 2 * Tc + 0.5, 1e-15);
}

/// The rule gives the magnitude optimum of the plant's own areas, behind the filter.
TEST(HoPidRule, EveryOrderTakesTheAreasThatItNeeds) {
  for (int m = 0; m <= 4; ++m) {
    const std::string order = std::to_string(m), n = std::to_string(m + 1);
    const Tuned t = tune(rule_named("ho-pid"), jotd(2, 0.5, 1, 6), {{"m", order}, {"n", n}, {"Tf", "0.1"}});
    const auto gains = magnitude_optimum(filtered(areas_of(jotd(2, 0.5, 1, 6), 20), 0.1, m + 1), m);
    ASSERT_TRUE(gains);
    ASSERT_EQ(t.controller.numerator.size(), gains->size());
    for (std::size_t i = 0; i < gains->size(); ++i)
      EXPECT_NEAR(t.controller.numerator[i], (*gains)[i], 1e-9 * std::abs((*gains)[i]));
  }
}

/// Given any plant of the families every rule either tunes it or says what it lacks, and never returns half a controller.
TEST(Catalogue, EveryRuleOnEveryPlantTunesOrExplains) {
  const RulePlant plants[] = {dipdt(2, 0.5),      ipdt(-3, 2),      ipdt(1, 0),
                              jotd(2, 0.5, 3, 1), jotd(1, 0, 1, 4), jotd(1, 1, 1, 0)};
  int tuned = 0;
  for (const Rule& rule : catalogue())
    for (const RulePlant& plant : plants) {
      if (rule.name == "dalen2018-pareto") continue;  // seconds a plant; pareto_pi_test.cpp
      try {
        const Tuned t = tune(rule, plant, {});
        EXPECT_FALSE(t.controller.numerator.empty()) << rule.name;
        ++tuned;
      } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_TRUE(text.find(rule.name) != std::string::npos || text.starts_with("--")) << text;
      }
    }
  EXPECT_GE(tuned, 50);
}

TEST(Catalogue, PreconditionsAreNamed) {
  EXPECT_EQ(error_of("huba2022-qrdp", ipdt(1, 1)),
            "huba2022-qrdp: it needs a dipdt plant, K e^(-Td s)/s^2, and \"ipdt\" is none");
  EXPECT_EQ(error_of("ho-pid", ipdt(1, 1), {{"Tf", "0.1"}}),
            "ho-pid: it needs a self-regulating plant; kos2021-pi and kos2021-pid are for one integrator");
  EXPECT_EQ(error_of("ho-pid", jotd(1, 0, 1, 2), {{"m", "1"}, {"n", "0"}}),
            "ho-pid: the filter must be of order m or more (m = 1, n = 0)");
  EXPECT_EQ(
      error_of("huba2022-qrdp", dipdt(1, 1), {{"cancel", "2To"}}),
      "huba2022-qrdp: this prefilter needs a filtered controller: give --Tf, or --cancel with one pole or none");
  EXPECT_EQ(error_of("huba2022-mfrp1", dipdt(1, 1), {{"cancel", "2mTo"}, {"Tf", "0.1"}}),
            "huba2022-mfrp1: --cancel 2mTo: the loop has 3 poles -1/To and 1 poles -1/(m To)");
  EXPECT_EQ(error_of("huba2022-qrdp", dipdt(1, 1), {{"Tf", "0.1"}, {"N", "0.45"}}),
            "--N must be 0.5 .. 1 (it is 0.45)");
  EXPECT_EQ(error_of("huba2022-qrdp", dipdt(1, 1), {{"m", "2"}}),
            "--m has no place here: huba2022-qrdp takes --Tf, --n, --N, --cancel");
  EXPECT_EQ(error_of("dalen2018-pareto", jotd(1, 0, 1, 1)), "dalen2018-pareto: it needs a dead time above 0");
  EXPECT_EQ(
      error_of("simc-pid", jotd(1, 1, 1, 1)),
      "simc-pid: its derivative time is the second lag (behind an integrator: the first), and the plant has none: "
      "take isimc-pid");
  EXPECT_EQ(error_of("kos2021-pd", ipdt(1, 1)), "--Tf is missing: kos2021-pd needs it");
}

TEST(Catalogue, RealUnitsAreNormalisedUnitsScaled) {
  for (const char* name : {"huba2022-qrdp", "huba2022-mfrp2"}) {
    const RulePlant unit = dipdt(1, 1), real = dipdt(-2, 0.25);
    const auto a = tuned_loop(unit, tune(rule_named(name), unit, {{"Tf", "0.1"}}));
    const auto b = tuned_loop(real, tune(rule_named(name), real, {{"Tf", "0.025"}}));
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->loop.setting.kappa, b->loop.setting.kappa, 1e-14);
    EXPECT_NEAR(a->loop.setting.tau_i, b->loop.setting.tau_i, 1e-12);
    EXPECT_NEAR(a->loop.setting.delta, b->loop.setting.delta, 1e-14);
    EXPECT_NEAR(a->loop.setting.b, b->loop.setting.b, 1e-13);
  }
}

}  // namespace
}  // namespace portrait::rules
