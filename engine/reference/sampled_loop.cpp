#include "engine/reference/sampled_loop.h"

#include <cmath>

#include <Eigen/Dense>

#include "engine/base/check.h"
#include "engine/base/matrices.h"

namespace portrait::reference {
namespace {

/// x' = A x + B v, out = C x + D v
struct System {
  Eigen::MatrixXd A, B;
  Eigen::RowVectorXd C, D;
};

/// Over a time with v held: x -> of_x x + of_v v.
struct HeldMap {
  Eigen::MatrixXd of_x, of_v;
};

HeldMap held_over(const System& system, double time) {
  const Eigen::Index n = system.A.rows(), m = system.B.cols();
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(n + m, n + m);
  generator.topLeftCorner(n, n) = system.A;
  generator.topRightCorner(n, m) = system.B;
  const Eigen::MatrixXd at = exponential(generator * time);
  return {at.topLeftCorner(n, n), at.topRightCorner(n, m)};
}

/// The states of prefilter and controller come first in an open chain, those of the plant last.
struct Parts {
  System controller;  ///< v = (y measured, w)
  System plant;       ///< v = u + d
};

Parts parts_of(const GeneralLoop& loop) {
  const OpenChain chain = open_chain(loop);
  const Eigen::Index plant = degree(loop.plant.rational.denominator), rest = chain.states() - plant;
  Parts parts;
  parts.controller.A = chain.A.topLeftCorner(rest, rest);
  parts.controller.B.resize(rest, 2);
  parts.controller.B << chain.B.col(kY).head(rest), chain.E.col(kSetpoint).head(rest);
  parts.controller.C = chain.C.row(kU).head(rest);
  parts.controller.D.resize(2);
  parts.controller.D << chain.D(kU, kY), chain.F(kU, kSetpoint);
  parts.plant.A = chain.A.bottomRightCorner(plant, plant);
  parts.plant.B = chain.E.col(kDisturbance).tail(plant);
  parts.plant.C = chain.C.row(kZ).tail(plant);
  parts.plant.D = chain.F.row(kZ).segment(kDisturbance, 1);
  return parts;
}

/// The plant's output a dead time ago, from its states and inputs at the instants before.
class DelayedOutput {
 public:
  DelayedOutput(const System& plant, double dead_time, double sampling) : plant_(plant) {
    const double samples = dead_time / sampling;
    // A sampling time that divides the dead time but for rounding divides it.
    back_ = std::abs(samples - std::round(samples)) < 1e-9 * (1 + samples) ? std::round(samples) : samples;
    const double part = std::ceil(back_) - back_;
    between_ = held_over(plant, part * sampling);
  }

  double at(std::size_t k, const std::vector<Eigen::VectorXd>& x, const std::vector<double>& v) const {
    const double instant = static_cast<double>(k) - std::ceil(back_);
    if (instant < 0) return 0;
    const auto i = static_cast<std::size_t>(instant);
    const Eigen::VectorXd there =
        between_.of_x * x[i] + between_.of_v * Eigen::VectorXd::Constant(1, i < v.size() ? v[i] : 0);
    return plant_.C.dot(there) + (i < v.size() ? plant_.D(0) * v[i] : 0);
  }

 private:
  const System& plant_;
  double back_;
  HeldMap between_;
};

}  // namespace

Sampled simulate_sampled(const GeneralLoop& loop, Step step, double sampling, double horizon,
                         const std::optional<Noise>& noise) {
  PORTRAIT_CHECK(degree(loop.controller.on_output) <= degree(loop.controller.denominator));
  PORTRAIT_CHECK(sampling > 0 && horizon / sampling < static_cast<double>(kMostSamples));
  const Parts parts = parts_of(loop);
  const HeldMap controller = held_over(parts.controller, sampling), plant = held_over(parts.plant, sampling);
  const DelayedOutput delayed(parts.plant, loop.plant.dead_time, sampling);
  const double w = step == kSetpoint, d = step == kDisturbance, o = step == kOutputStep;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(parts.controller.A.rows());
  std::vector<Eigen::VectorXd> x{Eigen::VectorXd::Zero(parts.plant.A.rows())};
  std::vector<double> v;
  Sampled found;
  const auto samples = static_cast<std::size_t>(std::floor(horizon / sampling * (1 + 1e-12))) + 1;
  for (std::size_t k = 0; k < samples; ++k) {
    const double y = delayed.at(k, x, v) + o;
    const Eigen::Vector2d seen(y + (noise ? noise_value(*noise, k) : 0), w);
    const double u = parts.controller.C.dot(state) + parts.controller.D.dot(seen);
    found.y.push_back(y), found.u.push_back(u);
    state = controller.of_x * state + controller.of_v * seen;
    v.push_back(u + d);
    x.push_back(plant.of_x * x.back() + plant.of_v * Eigen::VectorXd::Constant(1, v.back()));
  }
  return found;
}

}  // namespace portrait::reference
