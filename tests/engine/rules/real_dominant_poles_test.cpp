/// The quasi-polynomial must vanish where the poles were asked for, as often as asked, and the loop must be stable.

#include "engine/rules/real_dominant_poles.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/open_loop.h"
#include "engine/loop/stability.h"

namespace portrait::rules {
namespace {

constexpr PoleSet kSets[] = {PoleSet::one_modified, PoleSet::two_modified, PoleSet::three_modified};

void expect_pole(const RealPolesTuning& t, double p, int multiplicity, double m) {
  const auto P = quasi_polynomial(t, p);
  for (int order = 0; order < multiplicity; ++order)
    EXPECT_NEAR(P[static_cast<std::size_t>(order)], 0, 1e-13) << "m " << m << " p " << p << " derivative " << order;
}

TEST(RealDominantPoles, VanishAsOftenAsAskedForAnyRatio) {
  for (const PoleSet set : kSets)
    for (const double m : {0.05, 0.2, 0.5, 0.9, 0.9999, 1.0, 1.0 + 1e-9, 1.1, 1.7, 2.0, 2.5, 3.0, 4.0, 7.0, 20.0}) {
      const auto t = four_real_poles(set, m);
      ASSERT_TRUE(t.has_value()) << m;
      EXPECT_LT(t->p_o, 0);
      expect_pole(*t, t->p_o, m == 1 ? 4 : static_cast<int>(set), m);
      expect_pole(*t, t->p_o / m, m == 1 ? 4 : 4 - static_cast<int>(set), m);
    }
}

TEST(RealDominantPoles, GiveStableLoops) {
  for (const PoleSet set : kSets)
    for (const double m : {0.2, 0.5, 1.0, 2.0, 4.0, 10.0}) {
      const auto t = four_real_poles(set, m);
      ASSERT_TRUE(t.has_value());
      const Loop loop{{Plant::dipdt, 0, Prefilter::pi}, {.kappa = t->kappa, .tau_i = t->tau_i, .delta = t->delta}};
      EXPECT_TRUE(is_stable(open_loop(loop))) << m;
    }
}

/// p_o and p_o/m change places when m becomes 1/m and the sets change too.
TEST(RealDominantPoles, SetsMirrorEachOther) {
  for (const double m : {0.3, 0.5, 2.0, 3.0}) {
    const auto one = four_real_poles(PoleSet::one_modified, m),
               three = four_real_poles(PoleSet::three_modified, 1 / m);
    EXPECT_NEAR(one->kappa, three->kappa, 1e-13);
    EXPECT_NEAR(one->tau_i, three->tau_i, 1e-10);
    EXPECT_NEAR(one->p_o / m, three->p_o, 1e-12);
  }
}

TEST(RealDominantPoles, QuadrupleIsTheFirstZeroOfThePolynomial) {
  const auto t = four_real_poles(PoleSet::two_modified, 1);
  const double p = t->p_o;
  EXPECT_NEAR(p * p * p + 9 * p * p + 18 * p + 6, 0, 1e-13);
  EXPECT_NEAR(p, -0.4157745567834791, 1e-14);
}

TEST(RealDominantPoles, TripleSolvesTheQuasiPolynomialOfThePd) {
  const RealPolesTuning t = triple_real_pole();
  const double p = t.p_o, e = std::exp(p);
  EXPECT_NEAR(p * p * e + t.kappa + t.delta * p, 0, 1e-15);
  EXPECT_NEAR((p * p + 2 * p) * e + t.delta, 0, 1e-15);
  EXPECT_NEAR((p * p + 4 * p + 2) * e, 0, 1e-15);
  EXPECT_NEAR(t.delta, -std::sqrt(2.0) * p * e, 1e-15);  // (14) prints it without the root
}

}  // namespace
}  // namespace portrait::rules
