#include "engine/records/plant_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace portrait::records {
namespace {

/// A record of a plant, sampled 0.05, step of 2 at 4 (and back to 0.5 at 9 for `twice`), level 7, with noise of this amplitude.
Record record_of(const RealPlant& p, double end, bool twice, double noise) {
  const auto step = [&](double t) {
    const double x = t - p.Td;
    if (x <= 0) return 0.0;
    return p.K * (p.family == Plant::dipdt ? x * x / 2 : p.family == Plant::ipdt ? x : 1 - std::exp(-x / p.T1));
  };
  Record r;
  for (int i = 0; 0.05 * i <= end; ++i) {
    const double t = 0.05 * i, jitter = (i * 7919 % 101 - 50) / 50.0;
    r.t.push_back(t), r.u.push_back(t < 4 - 1e-9 ? 0 : twice && t >= 9 - 1e-9 ? 0.5 : 2);
    r.y.push_back(7 + 2 * step(t - 4) + (twice ? -1.5 * step(t - 9) : 0) + noise * jitter);
  }
  return r;
}

TEST(PlantFit, GivesThePlantBackWithoutNoise) {
  for (const bool twice : {false, true})
    for (const RealPlant& p : {RealPlant{Plant::ipdt, 0.4, 1.3, 0}, RealPlant{Plant::dipdt, -0.2, 0.7, 0},
                               RealPlant{Plant::fotd, 3, 1.1, 2.5}}) {
      const PlantFit fit = fitted_plant(record_of(p, 30, twice, 0), p.family, false);
      EXPECT_NEAR(fit.plant.K / p.K, 1, 1e-6);
      EXPECT_NEAR(fit.plant.Td / p.Td, 1, 1e-6);
      if (p.family == Plant::fotd) {
        EXPECT_NEAR(fit.plant.T1 / p.T1, 1, 1e-6);
      }
      EXPECT_NEAR(fit.level, 7, 1e-5);
      EXPECT_LT(fit.share, 1e-12);
    }
}

TEST(PlantFit, NoiseIsTheResidual) {
  const PlantFit fit = fitted_plant(record_of({Plant::fotd, 3, 1.1, 2.5}, 30, false, 0.1), Plant::fotd, false);
  EXPECT_NEAR(fit.residual, 0.1 / std::sqrt(3.0), 0.005);
  EXPECT_NEAR(fit.plant.Td, 1.1, 0.03);
  EXPECT_NEAR(fit.plant.T1, 2.5, 0.05);
  EXPECT_TRUE(fit.remarks.empty());
}

TEST(PlantFit, DriftIsToldApart) {
  Record r = record_of({Plant::ipdt, 0.4, 1.3, 0}, 30, true, 0);
  for (std::size_t i = 0; i < r.size(); ++i) r.y[i] -= 0.05 * r.t[i];
  const PlantFit fit = fitted_plant(r, Plant::ipdt, true);
  EXPECT_NEAR(fit.plant.K, 0.4, 1e-6);
  EXPECT_NEAR(fit.drift, -0.05, 1e-6);
}

TEST(PlantFit, AWrongFamilyIsToldByWhatItLeaves) {
  const Record r = record_of({Plant::fotd, 3, 1.1, 2.5}, 30, false, 0);
  const PlantFit poor = fitted_plant(r, Plant::ipdt, false);
  ASSERT_FALSE(poor.remarks.empty());
  EXPECT_TRUE(poor.remarks[0].starts_with("the model leaves more than noise"));
  Record nothing = r;
  for (std::size_t i = 0; i < nothing.size(); ++i) nothing.y[i] = static_cast<double>(i * 7919 % 101) / 50.0 - 1;
  EXPECT_THROW(fitted_plant(nothing, Plant::fotd, false), InputError);
}

TEST(MeasuredReactionCurve, OfTwoEqualLags) {
  Record r;
  for (int i = 0; i <= 3000; ++i) {
    const double t = 0.01 * i, x = std::max(t - 5.5, 0.0);
    r.t.push_back(t), r.u.push_back(t >= 5 - 1e-9 ? 2 : 0), r.y.push_back(1 + 2 * (1 - (1 + x) * std::exp(-x)));
  }
  const MeasuredReactionCurve curve = measured_reaction_curve(r);
  EXPECT_NEAR(curve.slope, std::exp(-1.0), 0.01);
  EXPECT_NEAR(curve.lag, 0.5 + 0.2817, 0.02);
  Record pulse = r;
  pulse.u.back() = 0;
  EXPECT_THROW(measured_reaction_curve(pulse), InputError);
}

}  // namespace
}  // namespace portrait::records
