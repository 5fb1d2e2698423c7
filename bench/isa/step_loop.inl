/// The step loop itself, for one instruction set: see bench/isa/step_loop.h.
///
///     e = r - y       v' = (e - v)/tau_f      u = kappa v + (kappa/tau_i) int v + delta v'
///     z'' = u + d,    z' = u + d,   or   tau_1 z' + z = u + d                     y(t) = z(t - 1)
///     tau_i tau_d r'' + tau_i r' + r = w
///
/// Runge-Kutta needs y between two steps. The cubic through four neighbours was no slower than the mean of two, and TV
/// is far more accurate with it. Kinks of y lie on multiples of the dead time: there a parabola through three
/// neighbours of one side takes its place. Differences are written as a x - b y, which lets the four stages follow
/// each other at the latency of one fused operation.
#pragma once

#include "bench/isa/number.inl"
#include "bench/isa/step_loop.h"

namespace portrait::bench::PORTRAIT_ISA_NAME {

enum class Step { w, d };

template <typename Number>
struct Coefficients {
  Number kappa, integral_gain, delta, filter_rate, plant_rate;
  Number prefilter_stiffness,
      prefilter_damping;  ///< r'' = stiffness (w - r) - damping r', or r' = stiffness (w - r)
  Number h, half_h, third_h, sixth_h;
};

/// Some are of no use to some loops, and cost these nothing.
template <typename Number>
struct State {
  Number v = 0.0, sum = 0.0;  ///< filtered error and its integral
  Number z = 0.0, z1 = 0.0;   ///< the plant's output before the dead time, and its slope
  Number r = 0.0, r1 = 0.0;   ///< the prefilter's output, and its slope
};

template <typename Number>
inline State<Number> moved(const State<Number>& x, Number h, const State<Number>& slope) {
  return {x.v + h * slope.v,   x.sum + h * slope.sum, x.z + h * slope.z,
          x.z1 + h * slope.z1, x.r + h * slope.r,     x.r1 + h * slope.r1};
}

/// One response.
template <StepPlant plant, bool derivative, Step step, typename Number>
class Response {
 public:
  /// The history lasts as long as the response, `steps` entries.
  Response(const Coefficients<Number>& c, Number* history, int steps) : c_(c), history_(history) {
    for (int i = 0; i < steps; ++i) history[i] = 0.0;
  }

  /// Sample i of a dead time to the next. The ring holds y from the sample after it on.
  __attribute__((always_inline)) void advance(int i) {
    const Number y1 = history_[i + 1];
    go_on(i, Number(9.0 / 16) * (y_ + y1) - Number(1.0 / 16) * (y_before_ + history_[i + 2]), y1);
  }
  /// The first sample of a dead time: only what comes after it is as smooth.
  __attribute__((always_inline)) void advance_first() {
    const Number y1 = history_[1];
    go_on(0, Number(3.0 / 8) * y_ + Number(3.0 / 4) * y1 - Number(1.0 / 8) * history_[2], y1);
  }
  /// The last one: only what comes before it is. The next dead time's first sample has just been written.
  __attribute__((always_inline)) void advance_last(int i) {
    const Number y1 = history_[0];
    go_on(i, Number(3.0 / 8) * y1 + Number(3.0 / 4) * y_ - Number(1.0 / 8) * y_before_, y1);
  }
  __attribute__((always_inline)) void advance_last_but_one(int i) {
    const Number y1 = history_[i + 1];
    go_on(i, Number(9.0 / 16) * (y_ + y1) - Number(1.0 / 16) * (y_before_ + history_[0]), y1);
  }

  /// The measures of lane i in out[i].
  void finish(StepMeasures* out) {
    State<Number> unused;
    tv_u_ = tv_u_ + magnitude(slope(x_, y_, unused) - u_);
    const Number ends = magnitude(error(y_)) - Number(step == Step::w ? 1.0 : 0.0);
    double iae[Number::kCount], tv_y[Number::kCount], tv_u[Number::kCount];
    scattered(c_.h * (iae_ + Number(0.5) * ends), iae);
    scattered(tv_y_, tv_y);
    scattered(tv_u_, tv_u);
    for (int i = 0; i < Number::kCount; ++i) out[i] = {iae[i], tv_y[i], tv_u[i]};
  }

 private:
  __attribute__((always_inline)) void go_on(int i, Number y_half, Number y1) {
    history_[i] = x_.z;
    const Number u = runge_kutta(y_half, y1);
    iae_ = iae_ + magnitude(error(y_));
    tv_y_ = tv_y_ + magnitude(y1 - y_);
    tv_u_ = tv_u_ + magnitude(u - u_);
    y_before_ = y_, y_ = y1, u_ = u;
  }

  Number error(Number y) const { return step == Step::w ? Number(1.0) - y : y; }

  /// Gives u at the step's beginning.
  __attribute__((always_inline)) Number runge_kutta(Number y_half, Number y1) {
    State<Number> k;
    const Number u = slope(x_, y_, k);
    State<Number> next = moved(x_, c_.sixth_h, k);
    slope(moved(x_, c_.half_h, k), y_half, k);
    next = moved(next, c_.third_h, k);
    slope(moved(x_, c_.half_h, k), y_half, k);
    next = moved(next, c_.third_h, k);
    slope(moved(x_, c_.h, k), y1, k);
    x_ = moved(next, c_.sixth_h, k);
    return u;
  }

  /// The state's slope; gives u.
  __attribute__((always_inline)) Number slope(const State<Number>& x, Number y, State<Number>& k) const {
    const Number e = step == Step::w ? x.r - y : Number(0.0) - y;
    k.v = c_.filter_rate * e - c_.filter_rate * x.v;
    k.sum = x.v;
    Number u = c_.kappa * x.v + c_.integral_gain * x.sum;
    if (derivative) u = u + c_.delta * k.v;
    plant_slope(x, step == Step::w ? u : u + Number(1.0), k);
    if (step == Step::w) prefilter_slope(x, k);
    return u;
  }

  void plant_slope(const State<Number>& x, Number input, State<Number>& k) const {
    if (plant == StepPlant::dipdt) k.z1 = input, k.z = x.z1;
    if (plant == StepPlant::ipdt) k.z = input;
    if (plant == StepPlant::fotd) k.z = c_.plant_rate * input - c_.plant_rate * x.z;
  }

  void prefilter_slope(const State<Number>& x, State<Number>& k) const {
    const Number pull = c_.prefilter_stiffness - c_.prefilter_stiffness * x.r;
    k.r = derivative ? x.r1 : pull;
    if (derivative) k.r1 = pull - c_.prefilter_damping * x.r1;
  }

  const Coefficients<Number> c_;
  Number* const history_;
  State<Number> x_;
  Number y_ = 0.0, y_before_ = 0.0, u_ = 0.0;
  Number iae_ = 0.0, tv_y_ = 0.0, tv_u_ = 0.0;
};

/// lane[i] is the setting of lane i.
template <bool derivative, typename Number>
inline Coefficients<Number> coefficients(const StepTask& task, const StepSetting* const* lane) {
  double kappa[Number::kCount], gain[Number::kCount], delta[Number::kCount], filter[Number::kCount];
  double plant[Number::kCount], stiffness[Number::kCount], damping[Number::kCount];
  for (int i = 0; i < Number::kCount; ++i) {
    const StepSetting& s = *lane[i];
    const double tau_d = s.delta / s.kappa;
    kappa[i] = s.kappa, gain[i] = s.kappa / s.tau_i, delta[i] = s.delta;
    filter[i] = 1 / s.tau_f;
    plant[i] = task.plant == StepPlant::fotd ? 1 / s.tau_1 : 0;
    stiffness[i] = derivative ? 1 / (s.tau_i * tau_d) : 1 / s.tau_i;
    damping[i] = derivative ? 1 / tau_d : 0;
  }
  const double h = 1.0 / task.steps;
  return {gathered<Number>(kappa),
          gathered<Number>(gain),
          gathered<Number>(delta),
          gathered<Number>(filter),
          gathered<Number>(plant),
          gathered<Number>(stiffness),
          gathered<Number>(damping),
          h,
          h / 2,
          h / 3,
          h / 6};
}

/// Both responses of one pack side by side: each hides the other's latency.
template <StepPlant plant, bool derivative, typename Number>
__attribute__((noinline)) void run_pack(const StepTask& task, const StepSetting* const* lane, StepMeasures* w_out,
                                        StepMeasures* d_out) {
  const Coefficients<Number> c = coefficients<derivative, Number>(task, lane);
  Number w_history[kMaxSteps], d_history[kMaxSteps];
  Response<plant, derivative, Step::w, Number> w(c, w_history, task.steps);
  Response<plant, derivative, Step::d, Number> d(c, d_history, task.steps);
  const int last = task.steps - 1;
  for (int k = 0; k < task.dead_times; ++k) {
    w.advance_first(), d.advance_first();
    for (int i = 1; i < last - 1; ++i) w.advance(i), d.advance(i);
    w.advance_last_but_one(last - 1), d.advance_last_but_one(last - 1);
    w.advance_last(last), d.advance_last(last);
  }
  w.finish(w_out);
  d.finish(d_out);
}

/// Lanes beyond the last setting repeat it.
template <StepPlant plant, bool derivative, typename Number>
inline void run_all(const StepTask& task, const StepSetting* settings, int count, BothSteps* out) {
  for (int first = 0; first < count; first += Number::kCount) {
    const StepSetting* lane[Number::kCount];
    StepMeasures w[Number::kCount], d[Number::kCount];
    for (int i = 0; i < Number::kCount; ++i) lane[i] = settings + (first + i < count ? first + i : count - 1);
    run_pack<plant, derivative, Number>(task, lane, w, d);
    for (int i = 0; i < Number::kCount && first + i < count; ++i) out[first + i] = {w[i], d[i]};
  }
}

template <StepPlant plant, typename Number>
inline void run_plant(const StepTask& task, const StepSetting* settings, int count, BothSteps* out) {
  task.derivative ? run_all<plant, true, Number>(task, settings, count, out)
                  : run_all<plant, false, Number>(task, settings, count, out);
}

template <typename Number>
void run_step_loop(const StepTask& task, const StepSetting* settings, int count, BothSteps* out) {
  switch (task.plant) {
    case StepPlant::dipdt:
      return run_plant<StepPlant::dipdt, Number>(task, settings, count, out);
    case StepPlant::ipdt:
      return run_plant<StepPlant::ipdt, Number>(task, settings, count, out);
    case StepPlant::fotd:
      return run_plant<StepPlant::fotd, Number>(task, settings, count, out);
  }
}

}  // namespace portrait::bench::PORTRAIT_ISA_NAME
