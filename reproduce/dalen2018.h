/// Plants, and the sampled loop, of the examples of Dalen2018; its tables, one file a kind.
#pragma once

#include <vector>

#include "engine/rules/delta_tuning.h"
#include "engine/rules/field.h"
#include "reproduce/loops.h"

namespace portrait::reproduce {

constexpr double kPrescribedMs = 1.59;                  ///< the prescribed peak
constexpr rules::IntegratingPlant kUnit = {1, 1};       ///< Example 2
constexpr rules::LagDelayPlant kHeater = {5.7, 60, 4};  ///< Example 3

/// (47) and (48), Examples 4 and 5, and what their reaction curves give, as printed.
const rules::RulePlant& column();
const rules::RulePlant& submersible();
constexpr rules::IntegratingPlant kColumn = {0.597, 0.923}, kSubmersible = {-0.145, 1.729};

/// A plant of one integrator or lag from sample to sample, dt apart: y becomes keep y + gain u, u `delay` samples old.
/// REQUIRES: tau/dt is whole.
struct SampledPlant {
  double keep, gain, dt;
  int delay;
};
SampledPlant sampled_plant(const rules::IntegratingPlant& p, double dt);
SampledPlant sampled_plant(const rules::LagDelayPlant& p, double dt);

/// Error and plant input under PI: u held, the integral by Euler, unit steps at the plant's output and input from the
/// samples `out` and `in` on, `steps` samples in all.
struct SampledRun {
  std::vector<double> error, input;
};
SampledRun sampled_run(const SampledPlant& p, const StandardForm& f, int out, int in, int steps);

/// Best method products: Tables 1, 3, 4, 5; distances from the front: Tables 2, 7, 9, 11, 13.
std::vector<Maker> dalen2018_product_makers();
std::vector<Maker> dalen2018_distance_makers();

}  // namespace portrait::reproduce
