/// Filter Q_n = 1/(tau_f s + 1)^n on a panel: n first-order lags in a row, with derivatives of the output.
///
///     tau v' + v = h      v = h - tau v'      v^(i+1) = (h^(i) - v^(i))/tau
#pragma once

#include "engine/kernel/legendre.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

/// A signal and its derivatives by time, as far as they are known: at[i] is the i-th.
struct Derivatives {
  const Series* at[4] = {};
};

class Filter {
 public:
  void begin(int order, Lanes tau) {
    order_ = order;
    tau_ = tau;
    rate_ = Lanes(1.0) / tau;
    for (Lanes& x : state_) x = Lanes(0.0);
  }

  /// Through all lags but the last; h' too, and with `extra` = 1 or 2 also h'', and the third derivative.
  Derivatives all_but_last(const Lag& lag, double half_length, Derivatives h, int extra) {
    for (int i = 0; i + 1 < order_; ++i) h = stage(lag, half_length, h, extra, i);
    return h;
  }

  /// The last lag in two steps, for the second can be part of a longer pass: forward elimination, then coefficient k of v'
  /// from the one above.
  void eliminate(const Lag& lag, const Series& h, Series& g) const { lag.eliminate(g, h, state_[order_ - 1]); }
  static Lanes substitute(const Lag& lag, const Series& g, int k, Lanes above) {
    return lag.substitute(g, k, above);
  }
  void advance_last(double half_length, Lanes mean_slope) { advance(order_ - 1, half_length, mean_slope); }

  Lanes next(Lanes h, Lanes v) const { return rate_ * (h - v); }
  void set_next(Series& next_one, const Series& h, const Series& v) const {
    for (int k = 0; k < kTerms; ++k) next_one[k] = next(h[k], v[k]);
  }

 private:
  Derivatives stage(const Lag& lag, double half_length, const Derivatives& h, int extra, int i) {
    Series* const v = rows_[i % 2];
    lag.set_slope(v[1], *h.at[0], state_[i]);
    for (int k = 0; k < kTerms; ++k) v[0][k] = mul_sub_from(tau_, v[1][k], (*h.at[0])[k]);
    for (int more = 0; more < extra; ++more) set_next(v[2 + more], *h.at[1 + more], v[1 + more]);
    advance(i, half_length, v[1][0]);
    return {{&v[0], &v[1], &v[2], &v[3]}};
  }

  void advance(int i, double half_length, Lanes mean_slope) {
    state_[i] = mul_add(Lanes(2 * half_length), mean_slope, state_[i]);
  }

  int order_ = 0;
  Lanes tau_, rate_;
  Lanes state_[kernel::kMaxFilters];
  Series rows_[2][4];
};

}  // namespace portrait::PORTRAIT_ISA_NAME
