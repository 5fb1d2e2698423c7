/// The loop as one would write it in an afternoon: real units, fixed steps, RK4, a ring buffer for the dead time.
///
///     plant       K e^{-Td s}/s^2,  K e^{-Td s}/s,  K e^{-Td s}/(T1 s + 1)
///     controller  Kc + Kc/(Ti s) + Kd s, filtered by 1/(Tf s + 1)^n; n = 0: the derivative of the output alone
///     prefilter   (1 + b s + c s^2)/(1 + a1 s + a2 s^2)
///
/// The setpoint steps by w and the disturbance by d, both at t = 0. The delayed output between two steps is
/// interpolated linearly, sums are of samples: about 1e-6 with 2000 steps a dead time.
///
/// REQUIRES: Tf and T1 longer than a step; for n = 0 and Kd > 0 a double integrator (else y' jumps inside the loop for
/// ever, which samples cannot tell).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/loop/loop.h"

namespace portrait::oracle {

struct StepLoop {
  Plant plant = Plant::dipdt;
  double K = 1, Td = 1, T1 = 0;
  double Kc = 0, Ti = kInf, Kd = 0;
  double Tf = 0;
  int n = 0;
  double b = 0, c = 0, a1 = 0, a2 = 0;
};

/// Samples at 0, h, 2 h, ...
struct Samples {
  double h = 0;
  std::vector<double> y, u;
};

class StepSimulation {
 public:
  StepSimulation(const StepLoop& loop, double w, double d, int steps_per_dead_time)
      : loop_(loop), w_(w), d_(d), h_(loop.Td / steps_per_dead_time), buffer_(steps_per_dead_time + 1, {0, 0}) {
    for (double& x : state_) x = 0;
  }

  Samples run(double dead_times) {
    const auto delay = buffer_.size() - 1;
    const auto steps = static_cast<std::size_t>(std::lround(dead_times * static_cast<double>(delay)));
    Samples samples{h_, {}, {}};
    for (std::size_t i = 0; i <= steps; ++i) {
      buffer_[i % buffer_.size()] = {state_[kOutput], state_[kOutputSlope]};
      const Delayed now = i < delay ? Delayed{0, 0} : buffer_[(i - delay) % buffer_.size()];
      const Delayed next = i + 1 < delay ? Delayed{0, 0} : buffer_[(i + 1 - delay) % buffer_.size()];
      samples.y.push_back(now.y);
      samples.u.push_back(signals(state_, now).u);
      step(now, next);
    }
    return samples;
  }

 private:
  static constexpr std::size_t kOutput = 0, kOutputSlope = 1, kIntegral = 2, kLag = 3, kLagSlope = 4, kFilter = 5;
  static constexpr std::size_t kStates = kFilter + 4;
  using State = std::array<double, kStates>;

  struct Delayed {
    double y, slope;
  };
  struct Signals {
    double u;
    State derivative;
  };

  void step(const Delayed& now, const Delayed& next) {
    const Delayed middle{(now.y + next.y) / 2, (now.slope + next.slope) / 2};
    const State k1 = signals(state_, now).derivative;
    const State k2 = signals(ahead(k1, h_ / 2), middle).derivative;
    const State k3 = signals(ahead(k2, h_ / 2), middle).derivative;
    const State k4 = signals(ahead(k3, h_), next).derivative;
    for (std::size_t i = 0; i < kStates; ++i) state_[i] += h_ / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }

  State ahead(const State& slope, double h) const {
    State x = state_;
    for (std::size_t i = 0; i < kStates; ++i) x[i] += h * slope[i];
    return x;
  }

  Signals signals(const State& x, const Delayed& delayed) const {
    Signals s{0, {}};
    double e = prefiltered(x, s.derivative) - delayed.y, e_slope = -delayed.slope;
    for (std::size_t i = 0; i < static_cast<std::size_t>(loop_.n); ++i) {
      e_slope = (e - x[kFilter + i]) / loop_.Tf;
      s.derivative[kFilter + i] = e_slope;
      e = x[kFilter + i];
    }
    s.derivative[kIntegral] = e;
    s.u = loop_.Kc * e + loop_.Kd * e_slope;
    if (std::isfinite(loop_.Ti)) s.u += loop_.Kc / loop_.Ti * x[kIntegral];
    drive_plant(x, s.u + d_, s.derivative);
    return s;
  }

  double prefiltered(const State& x, State& derivative) const {
    if (loop_.a1 == 0) return w_;
    if (loop_.a2 == 0) {
      derivative[kLag] = (w_ - x[kLag]) / loop_.a1;
      return x[kLag] + loop_.b * derivative[kLag];
    }
    derivative[kLag] = x[kLagSlope];
    derivative[kLagSlope] = (w_ - x[kLag] - loop_.a1 * x[kLagSlope]) / loop_.a2;
    return x[kLag] + loop_.b * x[kLagSlope] + loop_.c * derivative[kLagSlope];
  }

  void drive_plant(const State& x, double input, State& derivative) const {
    const double K = loop_.K;
    if (loop_.plant == Plant::ipdt) derivative[kOutput] = K * input;
    if (loop_.plant == Plant::fotd) derivative[kOutput] = (K * input - x[kOutput]) / loop_.T1;
    if (loop_.plant != Plant::dipdt) return;
    derivative[kOutput] = x[kOutputSlope];
    derivative[kOutputSlope] = K * input;
  }

  StepLoop loop_;
  double w_, d_, h_;
  std::vector<Delayed> buffer_;
  State state_{};
};

inline Samples run_step_loop(const StepLoop& loop, double w, double d, double dead_times, int steps_per_dead_time) {
  return StepSimulation(loop, w, d, steps_per_dead_time).run(dead_times);
}

/// Integral of |target - y| by the trapezoidal rule.
inline double sampled_error(const Samples& s, double target) {
  double sum = 0;
  for (std::size_t i = 1; i < s.y.size(); ++i)
    sum += s.h / 2 * (std::abs(target - s.y[i - 1]) + std::abs(target - s.y[i]));
  return sum;
}

/// Sum of |increments| from x(0-) = 0.
inline double sampled_variation(const std::vector<double>& x) {
  double sum = std::abs(x.front());
  for (std::size_t i = 1; i < x.size(); ++i) sum += std::abs(x[i] - x[i - 1]);
  return sum;
}

}  // namespace portrait::oracle
