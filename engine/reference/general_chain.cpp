#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/reference/open_chain.h"

namespace portrait::reference {
namespace {

using Signal = Eigen::RowVectorXd;

/// A factor d_0 + d_1 s + ... + d_q s^q driven by `input`: its output x and the slopes of x, each in units of a power of
/// `size` so that none of them towers over the others.
struct Stage {
  std::vector<Signal> states;
  double size;
};

class GeneralDiagram {
 public:
  explicit GeneralDiagram(const GeneralLoop& loop)
      : loop_(loop), states_(count_states(loop)), width_(states_ + kDelayed + kSteps) {
    derivatives_ = Eigen::MatrixXd::Zero(states_, width_);
    outputs_ = Eigen::MatrixXd::Zero(kOutputs, width_);
    const Signal r = prefiltered();
    const Signal u = controlled(r);
    outputs_.row(kU) = u;
    plant(u + step(kDisturbance));
  }

  OpenChain chain() const {
    return {.A = derivatives_.leftCols(states_),
            .B = derivatives_.middleCols(states_, kDelayed),
            .E = derivatives_.rightCols(kSteps),
            .C = outputs_.leftCols(states_),
            .D = outputs_.middleCols(states_, kDelayed),
            .F = outputs_.rightCols(kSteps),
            .fastest = fastest_};
  }

 private:
  static Eigen::Index count_states(const GeneralLoop& loop) {
    const GeneralController& c = loop.controller;
    return degree(c.prefilter.denominator) + degree(c.denominator) + degree(loop.plant.rational.denominator);
  }

  Signal known(Delayed delayed) const { return Signal::Unit(width_, states_ + delayed); }
  Signal step(Step of) const { return Signal::Unit(width_, states_ + kDelayed + of); }
  Signal y() const { return known(kY) + step(kOutputStep); }

  Stage stage(const Signal& input, const Polynomial& d) {
    const auto q = static_cast<Eigen::Index>(d.size()) - 1;
    Stage made{{}, d[0] == 0 ? 1 : std::pow(std::abs(d[0] / d.back()), 1.0 / static_cast<double>(q))};
    for (Eigen::Index j = 0; j < q; ++j) made.states.push_back(Signal::Unit(width_, made_ + j));
    Signal highest = input;  // d_q x^(q), in units of size^(q-1) once it is divided
    double power = 1;
    for (Eigen::Index j = 0; j < q; ++j, power *= made.size)
      highest -= d[static_cast<std::size_t>(j)] * power * made.states[static_cast<std::size_t>(j)];
    for (Eigen::Index j = 0; j + 1 < q; ++j)
      derivatives_.row(made_ + j) = made.size * made.states[static_cast<std::size_t>(j) + 1];
    derivatives_.row(made_ + q - 1) = highest / (d.back() * power / made.size);
    made_ += q;
    note_fastest(d);
    return made;
  }

  std::vector<Stage> stages(Signal input, const std::vector<Polynomial>& factors) {
    std::vector<Stage> all;
    for (const Polynomial& factor : factors) {
      all.push_back(stage(input, factor));
      input = all.back().states[0];
    }
    return all;
  }

  /// N(s)/(D_1 ... D_m) of the input: N = Q D_m + R gives R over all factors, which stands on the slopes of the last
  /// stage, and Q over the factors before. What is left in the end multiplies the input itself and its slope.
  Signal over(Polynomial N, const std::vector<Polynomial>& factors, const std::vector<Stage>& all,
              const Signal& input, const Signal& input_slope) const {
    Signal sum = Signal::Zero(width_);
    for (std::size_t i = factors.size(); i-- > 0;) {
      const Division by = divided(N, factors[i]);
      double power = 1;
      for (std::size_t j = 0; j < by.rest.size() && j < all[i].states.size(); ++j, power *= all[i].size)
        sum += by.rest[j] * power * all[i].states[j];
      N = by.quotient;
    }
    PORTRAIT_CHECK(N.size() <= 2);
    if (!N.empty()) sum += N[0] * input;
    if (N.size() == 2) sum += N[1] * input_slope;
    return sum;
  }

  Signal prefiltered() {
    const TransferFunction& F = loop_.controller.prefilter;
    const Signal w = step(kSetpoint);
    const std::vector<Stage> all = stages(w, F.denominator);
    return over(F.numerator, F.denominator, all, w, Signal::Zero(width_));
  }

  Signal controlled(const Signal& r) {
    const GeneralController& c = loop_.controller;
    const Signal slope = known(kYSlope);
    if (c.on_setpoint == c.on_output) {
      const Signal e = r - y();
      const std::vector<Stage> all = stages(e, c.denominator);
      return over(c.on_output, c.denominator, all, e, -slope);
    }
    return controlled_by_two(r, slope);
  }

  /// (N_r r - N_y y)/(D_1 ... D_m) by one set of states, for two would drift apart with their integrators. With R_i the
  /// rests of `over`, x_m = R_m/D_m, x_i = (x_(i+1) + R_i)/D_i and u = x_1 + Q: both inputs enter at every factor.
  Signal controlled_by_two(const Signal& r, const Signal& y_slope) {
    const GeneralController& c = loop_.controller;
    Polynomial of_r = c.on_setpoint, of_y = c.on_output;
    Signal x = Signal::Zero(width_);
    for (std::size_t i = c.denominator.size(); i-- > 0;) {
      const Division by_r = divided(of_r, c.denominator[i]), by_y = divided(of_y, c.denominator[i]);
      x = driven_stage(x, c.denominator[i], [&](std::size_t power) {
        Signal driving = Signal::Zero(width_);
        if (power < by_r.rest.size()) driving += by_r.rest[power] * r;
        if (power < by_y.rest.size()) driving -= by_y.rest[power] * y();
        return driving;
      });
      of_r = by_r.quotient, of_y = by_y.quotient;
    }
    PORTRAIT_CHECK(of_r.size() <= 1 && of_y.size() <= 2);
    if (!of_r.empty()) x += of_r[0] * r;
    if (!of_y.empty()) x -= of_y[0] * y();
    if (of_y.size() == 2) x -= of_y[1] * y_slope;
    return x;
  }

  /// d_0 x + d_1 x' + ... + d_q x^(q) = before + sum_j s^j driving(j), by integrators in a row:
  /// xi_1 = d_q x,  xi_j' = xi_(j+1) - d_(q-j) x + driving(q-j)
  template <typename Driving>
  Signal driven_stage(const Signal& before, const Polynomial& d, const Driving& driving) {
    const std::size_t q = d.size() - 1;
    const double size = d[0] == 0 ? 1 : std::pow(std::abs(d[0] / d.back()), 1.0 / static_cast<double>(q));
    const Signal x = Signal::Unit(width_, made_) / d.back();
    double power = 1;  // xi_j stands in units of size^(j-1)
    for (std::size_t j = 1; j <= q; ++j, power *= size) {
      Signal slope = driving(q - j) - d[q - j] * x;
      if (j == q) slope += before;
      slope /= power;
      if (j < q) slope += size * Signal::Unit(width_, made_ + 1);
      derivatives_.row(made_++) = slope;
    }
    note_fastest(d);
    return x;
  }

  void note_fastest(const Polynomial& d) {
    for (const std::complex<double>& root : complex_roots(d)) fastest_ = std::min(fastest_, 1 / std::abs(root));
  }

  void plant(const Signal& input) {
    const TransferFunction& P = loop_.plant.rational;
    const std::vector<Stage> all = stages(input, P.denominator);
    outputs_.row(kZ) = over(P.numerator, P.denominator, all, input, Signal::Zero(width_));
    if (relative_degree(P) < 1) return;  // nobody may ask for the slope
    Polynomial slope = P.numerator;
    slope.insert(slope.begin(), 0.0);
    outputs_.row(kSlope) = over(slope, P.denominator, all, input, Signal::Zero(width_));
  }

  const GeneralLoop& loop_;
  Eigen::Index states_, width_, made_ = 0;
  Eigen::MatrixXd derivatives_, outputs_;
  double fastest_ = kInf;
};

}  // namespace

OpenChain open_chain(const GeneralLoop& loop) {
  PORTRAIT_CHECK(!why_invalid(loop));
  return GeneralDiagram(loop).chain();
}

}  // namespace portrait::reference
