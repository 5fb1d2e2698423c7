#include "engine/loop/parameters.h"

#include <set>

#include <gtest/gtest.h>

namespace portrait {
namespace {

constexpr std::array kAll = {
    Parameter::kappa, Parameter::tau_i, Parameter::delta, Parameter::tau_d, Parameter::tau_1, Parameter::tau_f,
    Parameter::b,     Parameter::c,     Parameter::tau_j, Parameter::K_m1,  Parameter::K_0,   Parameter::K_1,
    Parameter::K_2,   Parameter::K_3,   Parameter::K_4,   Parameter::K_5,   Parameter::K_6};
static_assert(kAll.size() == kParameterCount);

std::vector<std::string_view> names_of(const LoopFamily& family) {
  std::vector<std::string_view> names;
  for (const Parameter p : parameters_of(family)) names.push_back(to_string(p));
  return names;
}

using Names = std::vector<std::string_view>;

TEST(Parameters, NamesAreUniqueAndLeadBack) {
  std::set<std::string_view> seen;
  for (const Parameter p : kAll) {
    EXPECT_TRUE(seen.insert(to_string(p)).second);
    EXPECT_EQ(parameter_named(to_string(p)), p);
    EXPECT_FALSE(info(p).long_name.empty());
  }
  EXPECT_EQ(parameter_named("kapa"), std::nullopt);
  EXPECT_EQ(parameter_named("n"), std::nullopt);
}

TEST(Parameters, AFamilyHasThoseItUses) {
  EXPECT_EQ(names_of({Plant::dipdt, 0, Prefilter::none}), (Names{"kappa", "tau_i", "delta", "tau_d"}));
  EXPECT_EQ(names_of({Plant::dipdt, 1, Prefilter::full}),
            (Names{"kappa", "tau_i", "delta", "tau_d", "tau_f", "b", "c"}));
  EXPECT_EQ(names_of({Plant::ipdt, 0, Prefilter::pi}), (Names{"kappa", "tau_i", "delta", "tau_d", "b"}));
  EXPECT_EQ(names_of({Plant::fotd, 2, Prefilter::none}),
            (Names{"kappa", "tau_i", "delta", "tau_d", "tau_1", "tau_f"}));
  EXPECT_EQ(names_of({.plant = Plant::jotd, .n = 1, .prefilter = Prefilter::none, .j = 3}),
            (Names{"kappa", "tau_i", "delta", "tau_d", "tau_f", "tau_j"}));
  EXPECT_EQ(names_of({.plant = Plant::jotd, .n = 2, .prefilter = Prefilter::none, .j = 3, .m = 2}),
            (Names{"tau_f", "tau_j", "K_-1", "K_0", "K_1", "K_2"}));
}

TEST(Parameters, AreNormalisedByTheDeadTimeAndTheGain) {
  EXPECT_EQ(normalisation(Parameter::kappa, Plant::dipdt), "Kc K Td^2");
  EXPECT_EQ(normalisation(Parameter::kappa, Plant::ipdt), "Kc K Td");
  EXPECT_EQ(normalisation(Parameter::kappa, Plant::fotd), "Kc K");
  EXPECT_EQ(normalisation(Parameter::delta, Plant::dipdt), "Kd K Td");
  EXPECT_EQ(normalisation(Parameter::delta, Plant::ipdt), "Kd K");
  EXPECT_EQ(normalisation(Parameter::delta, Plant::fotd), "Kd K/Td");
  EXPECT_EQ(normalisation(Parameter::tau_i, Plant::fotd), "Ti/Td");
  EXPECT_EQ(normalisation(Parameter::K_m1, Plant::jotd), "K_-1 K Td");
  EXPECT_EQ(normalisation(Parameter::K_0, Plant::jotd), "K_0 K");
  EXPECT_EQ(normalisation(Parameter::K_3, Plant::jotd), "K_3 K/Td^3");
  EXPECT_EQ(normalisation(Parameter::K_m1, Plant::dipdt), "K_-1 K Td^3");
  for (const Parameter p : kAll) EXPECT_FALSE(normalisation(p, Plant::dipdt).empty());
}

TEST(Parameters, WhatIsSetIsRead) {
  for (const Parameter p : kAll) {
    Setting setting{.kappa = 0.5};
    set(setting, p, 0.25);
    EXPECT_EQ(get(setting, p), 0.25) << to_string(p);
  }
}

TEST(Parameters, EachHasAPlaceOfItsOwn) {
  Setting setting;
  std::vector<Parameter> stored(kAll.begin(), kAll.end());
  std::erase(stored, Parameter::tau_d);
  double value = 1;
  for (const Parameter p : stored) set(setting, p, value++);
  value = 1;
  for (const Parameter p : stored) EXPECT_EQ(get(setting, p), value++) << to_string(p);
}

TEST(Parameters, TheDerivativeTimeIsDeltaSeenThroughKappa) {
  Setting setting{.kappa = 0.25};
  set(setting, Parameter::tau_d, 3);
  EXPECT_EQ(setting.delta, 0.75);
  set(setting, Parameter::delta, 1);
  EXPECT_EQ(get(setting, Parameter::tau_d), 4);
}

TEST(SettingText, PrintsTheFamilysParametersInOrder) {
  const Setting setting{.kappa = 0.24, .tau_i = 8, .delta = 0.7, .tau_1 = 3, .tau_f = 0.1, .b = 2, .c = 1};
  EXPECT_EQ(setting_text({{Plant::dipdt, 0, Prefilter::none}, setting}), "kappa=0.24 tau_i=8 delta=0.7");
  EXPECT_EQ(setting_text({{Plant::fotd, 1, Prefilter::full}, setting}),
            "kappa=0.24 tau_i=8 delta=0.7 tau_1=3 tau_f=0.1 b=2 c=1");
}

TEST(SimulateCommand, RunsThisOneLoop) {
  const Setting setting{.kappa = 0.1, .tau_i = kInf, .delta = 1.0 / 3, .tau_1 = 3, .tau_f = 1e-3, .b = 0.5};
  EXPECT_EQ(simulate_command({{Plant::fotd, 2, Prefilter::pi}, setting}),
            "portrait simulate --plant fotd --n 2 --prefilter pi --kappa 0.1 --tau-i inf "
            "--delta 0.3333333333333333 --tau-1 3 --tau-f 0.001 --b 0.5");
  EXPECT_EQ(simulate_command({{Plant::dipdt, 0, Prefilter::none}, setting}),
            "portrait simulate --plant dipdt --n 0 --prefilter none --kappa 0.1 --tau-i inf "
            "--delta 0.3333333333333333");
}

}  // namespace
}  // namespace portrait
