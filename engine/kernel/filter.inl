/// Filter Q_n = 1/(tau_f s + 1)^n on a panel: n first-order lags in a row, with derivatives of the output.
#pragma once

#include "engine/kernel/legendre.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

/// A signal and its derivatives by time, as far as they are known: at[i] is the i-th.
struct Derivatives {
  const Series* at[5] = {};
};

class Filter {
 public:
  void begin(int order, Lanes tau) {
    order_ = order;
    tau_ = tau;
    rate_ = Lanes(1.0) / tau;
    for (Lanes& x : state_) x = Lanes(0.0);
  }

  /// v = Q_n h and v', v'' from h, h'; with `extra` = 1 or 2 also v''' from h'', and v'''' from h'''.
  Derivatives apply(const Lag& lag, double half_length, Derivatives h, int extra) {
    for (int i = 0; i < order_; ++i) h = stage(lag, half_length, h, extra, i);
    return h;
  }

 private:
  /// v' by the solver; v = h - tau v'; each further derivative is (h^(i) - v^(i))/tau.
  Derivatives stage(const Lag& lag, double half_length, const Derivatives& h, int extra, int i) {
    Series* const out = rows_[i % 2];
    Lanes& state = state_[i];
    Series& v = out[0];
    Series& v1 = out[1];
    Series& v2 = out[2];
    const Series& h0 = *h.at[0];
    const Series& h1 = *h.at[1];
    lag.set_slope(v1, h0, state);
    for (int k = 0; k < kTerms; ++k) {
      v[k] = mul_sub_from(tau_, v1[k], h0[k]);
      v2[k] = rate_ * (h1[k] - v1[k]);
    }
    for (int more = 0; more < extra; ++more) set_next(out[3 + more], *h.at[2 + more], out[2 + more]);
    state = mul_add(Lanes(2 * half_length), v1[0], state);
    return {{&v, &v1, &v2, &out[3], &out[4]}};
  }

  void set_next(Series& next, const Series& input, const Series& here) const {
    for (int k = 0; k < kTerms; ++k) next[k] = rate_ * (input[k] - here[k]);
  }

  int order_ = 0;
  Lanes tau_, rate_;
  Lanes state_[kernel::kMaxFilters];
  Series rows_[2][5];
};

}  // namespace portrait::PORTRAIT_ISA_NAME
