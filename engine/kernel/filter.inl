/// Filter Q_n = 1/(tau_f s + 1)^n on a panel: n first-order lags in a row, with derivatives of the output.
///
///     tau v' + v = h      v^(i) = h^(i) - tau v^(i+1)      v^(i+1) = (h^(i) - v^(i))/tau
///
/// Each lag is solved once, for the derivative of v that follows the input's derivative of order `level`. Those below come by
/// the second formula, in which rounding is multiplied by tau; those above by the third, which loses digits by 1/tau each
/// time (tests/engine/kernel/responses_test.cpp, ResponsesAcrossIsas). So `level` is as high as an input's derivatives are known
/// in their own right: those of an integrator, as long as the filter is fast. A slow one has tau^2 and tau^3 in what is fed
/// back in the end, which grew by up to half from one dead time to the next where tau_f was above 1; there 1/tau loses
/// nothing, and `level` is 1 (tests/engine/kernel/responses_test.cpp, ASlowFilterOverALongTime). The slope of a lag (fotd) is a
/// numerical derivative: fed back through `level` = 1 it makes the highest coefficients grow from one dead time to the next.
#pragma once

#include "engine/kernel/legendre.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

/// A signal and its derivatives by time, as far as they are known: at[i] is the i-th.
struct Derivatives {
  const Series* at[4] = {};
};

/// One coefficient of a lag's signals from another.
struct LagFormula {
  Lanes tau, rate;
  /// v^(i) from h^(i) and v^(i+1).
  Lanes below(Lanes h, Lanes derivative) const { return mul_sub_from(tau, derivative, h); }
  /// v^(i+1) from h^(i) and v^(i).
  Lanes above(Lanes h, Lanes v) const { return rate * (h - v); }
};

class Filter {
 public:
  /// Derivatives of the output up to `highest` are asked for. level 0, or one below `highest`.
  void begin(int order, Lanes tau, int level, int highest) {
    order_ = order;
    level_ = level, highest_ = highest;
    formula_ = {tau, Lanes(1.0) / tau};
    for (int i = 0; i < order; ++i) state_[i] = Lanes(0.0);
  }

  /// Everything was at rest up to this panel's start, where h and its derivatives may jump.
  void enter(const Derivatives& h) {
    Lanes input[4], output[4];
    for (int i = 0; i < level_; ++i) input[i] = value_at_start(*h.at[i]);
    for (int lag = 0; lag < order_; ++lag) {
      output[0] = Lanes(0.0);
      for (int i = 0; i < level_; ++i) output[i + 1] = formula_.above(input[i], output[i]);
      state_[lag] = output[level_];
      for (int i = 0; i < level_; ++i) input[i] = output[i];
    }
  }

  /// Through all lags but the last.
  template <int degree>
  Derivatives all_but_last(const Lag& lag, double half_length, Derivatives h) {
    for (int i = 0; i + 1 < order_; ++i) h = stage<degree>(lag, half_length, h, i);
    return h;
  }

  /// The last lag in two steps, for the second can be part of a longer pass: forward elimination, then the solution
  /// coefficient by coefficient from the highest down.
  template <int degree>
  void eliminate(const Lag& lag, const Derivatives& h, Series& g) const {
    lag.eliminate<degree>(g, *h.at[level_], state_[order_ - 1]);
  }
  void advance_last(double half_length, Lanes mean_slope) { advance(order_ - 1, half_length, mean_slope); }

  int order() const { return order_; }
  const LagFormula& formula() const { return formula_; }

  template <int degree>
  void set_below(Series& v, const Series& h, const Series& derivative) const {
    for (int k = 0; k <= degree; ++k) v[k] = formula_.below(h[k], derivative[k]);
  }
  template <int degree>
  void set_above(Series& derivative, const Series& h, const Series& v) const {
    for (int k = 0; k <= degree; ++k) derivative[k] = formula_.above(h[k], v[k]);
  }

 private:
  template <int degree>
  Derivatives stage(const Lag& lag, double half_length, const Derivatives& h, int i) {
    Series* const v = rows_[i % 2];
    lag.set_slope<degree>(v[level_ + 1], *h.at[level_], state_[i]);
    for (int level = level_; level >= 0; --level) set_below<degree>(v[level], *h.at[level], v[level + 1]);
    for (int level = level_ + 1; level < highest_; ++level) set_above<degree>(v[level + 1], *h.at[level], v[level]);
    advance(i, half_length, v[level_ + 1][0]);
    return {{&v[0], &v[1], &v[2], &v[3]}};
  }

  void advance(int i, double half_length, Lanes mean_slope) {
    state_[i] = mul_add(Lanes(2 * half_length), mean_slope, state_[i]);
  }

  int order_ = 0, level_ = 0, highest_ = 1;
  LagFormula formula_;
  Lanes state_[kernel::kMaxFilters];  ///< of every lag the derivative of order `level_`, at the panel's start
  Series rows_[2][5];
};

}  // namespace portrait::PORTRAIT_ISA_NAME
