#include "engine/loop/loop.h"

#include <gtest/gtest.h>

namespace portrait {
namespace {

/// A PID loop with everything in place, to be spoilt in one spot.
Loop good(Plant plant = Plant::dipdt, int n = 1, Prefilter prefilter = Prefilter::full) {
  return {{plant, n, prefilter}, {.kappa = 0.24, .tau_i = 8, .delta = 0.7, .tau_1 = 2, .tau_f = 0.1}};
}

std::string reason(const Loop& loop) { return why_invalid(loop).value_or("valid"); }

template <typename Spoil>
std::string reason_after(Loop loop, Spoil spoil) {
  spoil(loop.setting);
  return reason(loop);
}

TEST(Names, LeadToPlantsAndBack) {
  for (const Plant plant : {Plant::dipdt, Plant::ipdt, Plant::fotd})
    EXPECT_EQ(plant_named(to_string(plant)), plant);
  EXPECT_EQ(plant_named("dipdt"), Plant::dipdt);
  EXPECT_EQ(plant_named("ipdt"), Plant::ipdt);
  EXPECT_EQ(plant_named("fotd"), Plant::fotd);
  EXPECT_EQ(plant_named("DIPDT"), std::nullopt);
}

TEST(Names, LeadToPrefiltersAndBack) {
  EXPECT_EQ(prefilter_named("full"), Prefilter::full);
  EXPECT_EQ(prefilter_named("pi"), Prefilter::pi);
  EXPECT_EQ(prefilter_named("none"), Prefilter::none);
  EXPECT_EQ(prefilter_named(""), std::nullopt);
  EXPECT_EQ(to_string(Prefilter::full), "full");
}

TEST(Plants, HaveTheirIntegrators) {
  EXPECT_EQ(integrators(Plant::dipdt), 2);
  EXPECT_EQ(integrators(Plant::ipdt), 1);
  EXPECT_EQ(integrators(Plant::fotd), 0);
}

TEST(Prefilters, TheUsualOneCancelsTheZerosThatTheSetpointSees) {
  EXPECT_EQ(usual_prefilter(0), Prefilter::pi);
  EXPECT_EQ(usual_prefilter(1), Prefilter::full);
  EXPECT_EQ(usual_prefilter(4), Prefilter::full);
}

TEST(WhyInvalid, SaysNothingOfAGoodLoop) {
  for (const Plant plant : {Plant::dipdt, Plant::ipdt, Plant::fotd})
    for (const int n : {0, 1, kMaxFilterOrder})
      for (const Prefilter prefilter : {Prefilter::full, Prefilter::pi, Prefilter::none})
        EXPECT_EQ(reason(good(plant, n, prefilter)), "valid");
}

TEST(WhyInvalid, FilterOrder) {
  EXPECT_EQ(reason(good(Plant::dipdt, -1)), "n must be 0 .. 16 (it is -1)");
  EXPECT_EQ(reason(good(Plant::dipdt, 17)), "n must be 0 .. 16 (it is 17)");
}

TEST(WhyInvalid, Kappa) {
  const auto with = [](double x) { return reason_after(good(), [x](Setting& s) { s.kappa = x; }); };
  EXPECT_EQ(with(0), "kappa must be finite and above 0 (it is 0)");
  EXPECT_EQ(with(-0.5), "kappa must be finite and above 0 (it is -0.5)");
  EXPECT_EQ(with(kInf), "kappa must be finite and above 0 (it is inf)");
  EXPECT_EQ(with(kNaN), "kappa must be finite and above 0 (it is nan)");
}

/// Their squares, to the order of the loop, are what stability is found from.
TEST(WhyInvalid, NumbersThatNoDoubleCanMultiply) {
  const std::string far = "its gains and times lie too far from 1, or in too high an order, to compute with";
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.kappa = 1e160; }), far);
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.kappa = 1e-160; }), far);
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.delta = 1e160; }), far);
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.tau_i = 1e160; }), far);
  EXPECT_EQ(reason_after(good(Plant::fotd), [](Setting& s) { s.tau_1 = 1e160; }), far);
  EXPECT_EQ(reason_after(good(Plant::dipdt, 16), [](Setting& s) { s.tau_f = 1e-10; }), far);
  EXPECT_EQ(reason_after(good(Plant::dipdt, 8), [](Setting& s) { s.tau_f = 1e-10; }), "valid");
}

TEST(WhyInvalid, IntegralTime) {
  const auto with = [](double x) { return reason_after(good(), [x](Setting& s) { s.tau_i = x; }); };
  EXPECT_EQ(with(0), "tau_i must be above 0, or inf for no integral action (it is 0)");
  EXPECT_EQ(with(-8), "tau_i must be above 0, or inf for no integral action (it is -8)");
  EXPECT_EQ(with(-kInf), "tau_i must be above 0, or inf for no integral action (it is -inf)");
  EXPECT_EQ(with(kNaN), "tau_i must be above 0, or inf for no integral action (it is nan)");
  EXPECT_EQ(with(kInf), "valid");
}

TEST(WhyInvalid, DerivativeGain) {
  const auto with = [](double x) { return reason_after(good(), [x](Setting& s) { s.delta = x; }); };
  EXPECT_EQ(with(-0.7), "delta must be finite and not below 0 (it is -0.7)");
  EXPECT_EQ(with(kInf), "delta must be finite and not below 0 (it is inf)");
  EXPECT_EQ(with(kNaN), "delta must be finite and not below 0 (it is nan)");
  EXPECT_EQ(with(0), "valid");
}

TEST(WhyInvalid, PlantTimeConstantOfFotdOnly) {
  const auto with = [](Plant plant, double x) {
    return reason_after(good(plant), [x](Setting& s) { s.tau_1 = x; });
  };
  EXPECT_EQ(with(Plant::fotd, 0), "tau_1 must be finite and above 0 (it is 0)");
  EXPECT_EQ(with(Plant::fotd, kInf), "tau_1 must be finite and above 0 (it is inf)");
  EXPECT_EQ(with(Plant::fotd, kNaN), "tau_1 must be finite and above 0 (it is nan)");
  EXPECT_EQ(with(Plant::ipdt, 0), "valid");
}

TEST(WhyInvalid, FilterTimeConstantWithAFilterOnly) {
  const auto with = [](int n, double x) {
    return reason_after(good(Plant::dipdt, n), [x](Setting& s) { s.tau_f = x; });
  };
  EXPECT_EQ(with(1, 0), "tau_f must be finite and above 0 (it is 0)");
  EXPECT_EQ(with(2, -0.1), "tau_f must be finite and above 0 (it is -0.1)");
  EXPECT_EQ(with(2, kInf), "tau_f must be finite and above 0 (it is inf)");
  EXPECT_EQ(with(0, 0), "valid");
}

TEST(WhyInvalid, PrefilterNumeratorMustBeFinite) {
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.b = kInf; }), "b must be finite (it is inf)");
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.c = kNaN; }), "c must be finite (it is nan)");
  EXPECT_EQ(reason_after(good(), [](Setting& s) { s.b = -1, s.c = -2; }), "valid");
}

TEST(WhyInvalid, WithoutPrefilterBAndCMustBeZero) {
  const std::string expected = "b and c belong to a prefilter: with prefilter = \"none\" both must be 0";
  const Loop none = good(Plant::dipdt, 1, Prefilter::none);
  EXPECT_EQ(reason_after(none, [](Setting& s) { s.b = 1; }), expected);
  EXPECT_EQ(reason_after(none, [](Setting& s) { s.c = 1; }), expected);
}

TEST(WhyInvalid, ThePiPrefilterHasNoC) {
  const Loop pi = good(Plant::dipdt, 1, Prefilter::pi);
  EXPECT_EQ(reason_after(pi, [](Setting& s) { s.b = 1; }), "valid");
  EXPECT_EQ(reason_after(pi, [](Setting& s) { s.c = 0.5; }),
            "c must be 0 with prefilter = \"pi\", whose numerator is 1 + b tau_i s (it is 0.5)");
}

/// (1 + b s + c s^2)/(1 + tau_i s + tau_i tau_d s^2), or (1 + b s)/(1 + tau_d s) without integral action.
TEST(WhyInvalid, TheFullPrefilterMustBeProper) {
  const auto with = [](double tau_i, double delta, double b, double c) {
    return reason_after(good(), [=](Setting& s) { s.tau_i = tau_i, s.delta = delta, s.b = b, s.c = c; });
  };
  const std::string no_c =
      "c must be 0 without both integral and derivative action, or the prefilter is improper (it is 2)";
  EXPECT_EQ(with(8, 0.7, 1, 2), "valid");
  EXPECT_EQ(with(8, 0, 1, 2), no_c);
  EXPECT_EQ(with(kInf, 0.7, 1, 2), no_c);
  EXPECT_EQ(with(kInf, 0, 0, 2), no_c);
  EXPECT_EQ(with(8, 0, 1, 0), "valid");
  EXPECT_EQ(with(kInf, 0.7, 1, 0), "valid");
  EXPECT_EQ(with(kInf, 0, 1, 0),
            "b must be 0 without integral and derivative action, or the prefilter is improper (it is 1)");
  EXPECT_EQ(with(kInf, 0, 0, 0), "valid");
}

}  // namespace
}  // namespace portrait
