#include "engine/reference/open_chain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/check.h"

namespace portrait::reference {
namespace {

/// A signal of the chain: its coefficients on the states, on (y, y') and on (w, d), as one row.
using Signal = Eigen::RowVectorXd;

/// Number of states of each block, which also fixes their order in x.
struct Sizes {
  Eigen::Index prefilter, filter, integral, plant;
  Eigen::Index total() const { return prefilter + filter + integral + plant; }
};

Eigen::Index prefilter_order(const Loop& loop) {
  const bool integral = has_integral_action(loop.setting), derivative = loop.setting.delta > 0;
  switch (loop.family.prefilter) {
    case Prefilter::full:
      return (integral ? 1 : 0) + (derivative ? 1 : 0);
    case Prefilter::pi:
      return integral ? 1 : 0;
    case Prefilter::none:
      return 0;
  }
  return 0;
}

Sizes sizes_of(const Loop& loop) {
  return {.prefilter = prefilter_order(loop),
          .filter = loop.family.n,
          .integral = has_integral_action(loop.setting) ? 1 : 0,
          .plant = std::max(1, integrators(loop.family.plant))};
}

/// Writes the loop's block diagram down, block by block, as signals and as derivatives of states.
class Diagram {
 public:
  explicit Diagram(const Loop& loop)
      : family_(loop.family), s_(loop.setting), sizes_(sizes_of(loop)), width_(sizes_.total() + kDelayed + kSteps) {
    derivatives_ = Eigen::MatrixXd::Zero(sizes_.total(), width_);
    const Signal r = prefilter();
    const Signal u = controller(r - y());
    plant(u + d());
    outputs_.row(kU) = u;
  }

  OpenChain chain() const {
    const Eigen::Index n = sizes_.total();
    return {.A = derivatives_.leftCols(n),
            .B = derivatives_.middleCols(n, kDelayed),
            .E = derivatives_.rightCols(kSteps),
            .C = outputs_.leftCols(n),
            .D = outputs_.middleCols(n, kDelayed),
            .F = outputs_.rightCols(kSteps),
            .fastest = fastest()};
  }

 private:
  Signal unit(Eigen::Index i) const { return Signal::Unit(width_, i); }
  Signal y() const { return unit(sizes_.total() + kY) + unit(sizes_.total() + kDelayed + kOutputStep); }
  Signal y_slope() const { return unit(sizes_.total() + kYSlope); }
  Signal w() const { return unit(sizes_.total() + kDelayed + kSetpoint); }
  Signal d() const { return unit(sizes_.total() + kDelayed + kDisturbance); }

  /// The next state, and what its derivative is: states are numbered as they are made.
  Signal new_state() { return unit(made_++); }
  void set_derivative(const Signal& state, const Signal& derivative) {
    Eigen::Index row = 0;
    state.maxCoeff(&row);
    derivatives_.row(row) = derivative;
  }

  /// a2 x'' + a1 x' + x = w and r = x + b x' + c x''
  Signal prefilter() {
    if (sizes_.prefilter == 0) return w();
    if (sizes_.prefilter == 1) return first_order_prefilter();
    const double a1 = s_.tau_i, a2 = s_.tau_i * tau_d(s_);
    const Signal x = new_state(), slope = new_state();
    const Signal curvature = (w() - x - a1 * slope) / a2;
    set_derivative(x, slope);
    set_derivative(slope, curvature);
    return x + s_.b * slope + s_.c * curvature;
  }

  /// a1 x' + x = w and r = x + b x'; the prefilter `pi` measures b in tau_i.
  Signal first_order_prefilter() {
    const double a1 = has_integral_action(s_) ? s_.tau_i : tau_d(s_);
    const double b = family_.prefilter == Prefilter::pi ? s_.b * s_.tau_i : s_.b;
    const Signal x = new_state();
    const Signal slope = (w() - x) / a1;
    set_derivative(x, slope);
    return x + b * slope;
  }

  /// u = kappa e + (kappa/tau_i) int e + delta e', with e filtered for n >= 1 and e' = -y' for n = 0
  Signal controller(Signal e) {
    Signal e_slope = -y_slope();
    for (int i = 0; i < family_.n; ++i) {
      const Signal x = new_state();
      e_slope = (e - x) / s_.tau_f;
      set_derivative(x, e_slope);
      e = x;
    }
    Signal u = s_.kappa * e + s_.delta * e_slope;
    if (!has_integral_action(s_)) return u;
    const Signal integral = new_state();
    set_derivative(integral, e);
    return u + s_.kappa / s_.tau_i * integral;
  }

  /// dipdt z'' = input, ipdt z' = input, fotd tau_1 z' + z = input
  void plant(const Signal& input) {
    outputs_ = Eigen::MatrixXd::Zero(kOutputs, width_);
    const Signal z = new_state();
    Signal slope = family_.plant == Plant::fotd ? Signal((input - z) / s_.tau_1) : input;
    if (family_.plant == Plant::dipdt) {
      slope = new_state();
      set_derivative(slope, input);
    }
    set_derivative(z, slope);
    outputs_.row(kZ) = z;
    outputs_.row(kSlope) = slope;
  }

  double fastest() const {
    double shortest = kInf;
    if (family_.n >= 1) shortest = std::min(shortest, s_.tau_f);
    if (family_.plant == Plant::fotd) shortest = std::min(shortest, s_.tau_1);
    if (sizes_.prefilter == 1) shortest = std::min(shortest, has_integral_action(s_) ? s_.tau_i : tau_d(s_));
    if (sizes_.prefilter == 2) shortest = std::min(shortest, prefilter_pole_time());
    return shortest;
  }

  /// 1/|p| of the faster prefilter pole: real poles at a1/a2 (1 + sqrt(1 - 4 a2/a1^2))/2, else |p| =
  /// 1/sqrt(a2).
  double prefilter_pole_time() const {
    const double ratio = 4 * tau_d(s_) / s_.tau_i;
    if (ratio >= 1) return std::sqrt(s_.tau_i * tau_d(s_));
    return 2 * tau_d(s_) / (1 + std::sqrt(1 - ratio));
  }

  const LoopFamily& family_;
  const Setting& s_;
  Sizes sizes_;
  Eigen::Index width_;
  Eigen::Index made_ = 0;
  Eigen::MatrixXd derivatives_, outputs_;
};

}  // namespace

OpenChain open_chain(const Loop& loop) {
  if (!is_basic(loop.family)) return open_chain(general(loop));
  PORTRAIT_CHECK(!why_invalid(loop));
  return Diagram(loop).chain();
}

}  // namespace portrait::reference
