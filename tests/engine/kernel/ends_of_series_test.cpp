// Where series end at a lower degree, what they leave out is seen in their last coefficients there and then. By the next time
// that anyone looks it has faded, and a setting whose degree fell too early would pass for resolved.
#include <string>

#include <gtest/gtest.h>

#include "engine/isa/dispatch.h"
#include "engine/kernel/pack.h"

namespace portrait::kernel {
namespace {

void fill(PackColumn& column, double x) {
  for (double& lane : column) lane = x;
}

/// ipdt under a PID behind a filter, the same in every lane: kappa = 0.5, tau_i = 8, delta = 0.3, tau_f = 0.1, b = c = 0. What
/// a lower degree leaves out loses half of its size and more each dead time.
Pack pack_with(int smooth_from) {
  Pack pack{};
  pack.plant = PlantKind::ipdt;
  pack.n = 1;
  pack.setpoint_run = SetpointRun::from_disturbance;
  pack.horizon = 51;
  pack.mesh = {2, 0};
  pack.layered_intervals = 5;
  pack.smooth_from = smooth_from;
  fill(pack.kappa, 0.5), fill(pack.integral_gain, 0.5 / 8), fill(pack.delta, 0.3);
  fill(pack.tau_f, 0.1), fill(pack.tau_1, 1);
  fill(pack.g0, 0.5 / 8), fill(pack.a1, 1), fill(pack.a2, 1);
  fill(pack.y_rest_w, 1), fill(pack.u_rest_d, -1);
  return pack;
}

class EndsOfSeries : public ::testing::TestWithParam<const Implementation*> {
 protected:
  static double smooth_tail(int smooth_from) {
    PackResult result;
    GetParam()->run(pack_with(smooth_from), result);
    return result.smooth_tail[0];
  }
};

/// Between 8 and 15 no other rule has anyone look: seen at 15 alone, all of these would be the same.
TEST_P(EndsOfSeries, AreSeenWhereTheDegreeFalls) {
  double last = smooth_tail(8);
  EXPECT_GT(last, 1e-8);  // far from resolved
  for (int smooth_from = 9; smooth_from <= 15; ++smooth_from) {
    const double tail = smooth_tail(smooth_from);
    EXPECT_LT(tail, 0.7 * last) << "from " << smooth_from;
    last = tail;
  }
  EXPECT_LT(last, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(AllIsas, EndsOfSeries, ::testing::ValuesIn(available_implementations()),
                         [](const auto& one) { return std::string(one.param->name); });

}  // namespace
}  // namespace portrait::kernel
