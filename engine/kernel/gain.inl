/// |L| over frequency: where it rises, what bounds it, and where it crosses 1. All in x = omega^2.
///
/// |L|^2 is |N|^2/x^k times the lags, which fall everywhere. |N|^2/x^k, c = n1^2 - 2 n0 n2, rises in one window at most:
///
///     k = 0   everywhere, where n1 > n0 tau_1 (the plant's lag included)       k = 1   beyond n0/n2
///     k = 2   beyond 2 n0^2/-c, c < 0                              k = 3   between (-c -+ sqrt(c^2 - 3 n0^2 n2^2))/n2^2, c < 0
///
/// So |L| crosses 1 once where the window lies on one side of 1; and also where the coefficients of |N|^2 - |D|^2 change
/// sign once, by Descartes' rule.
#pragma once

#include "engine/kernel/open_loop.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr double kInfinity = __builtin_inf();

class Gain {
 public:
  explicit Gain(const OpenLoopLanes& loop) : loop_(loop), end_(end_gain()) {
    find_window();
    falls_ = !(rises_from_ < Lanes(kInfinity));
    once_ = falls_ | changes_sign_once();
    never_ = Mask::from(0);
    if (loop.integrators == 0)
      count_without_integrator();
    else if (any(!once_))
      once_ = once_ | window_on_one_side();
  }

  /// |L| at infinity, above 0 only where N and D are of one degree.
  Lanes end() const { return end_; }
  /// Lanes in which |L| is known to cross 1 just once, downwards; or to stay below.
  Mask crosses_once() const { return once_; }
  Mask never_crosses() const { return never_; }

  /// Lanes in which |L| falls all the way up to x.
  Mask falls_up_to(Lanes x) const { return !(x > rises_from_); }

  /// At least |L|^2 everywhere beyond x, where it is `here`.
  Lanes square_beyond(Lanes x, Lanes here) const {
    if (!any(!falls_)) return here;
    if (loop_.filters == 0 && loop_.integrators < 3) return max(here, end_ * end_);
    return select(falls_ | (x > rises_to_), here, max(here, top_beyond(x)));
  }

  /// omega where |L| = 1, of the lanes that cross once: Newton's method on ln|L| over ln omega, inside a bracket.
  /// `lost`: lanes whose numbers are too large or small for it.
  Lanes crossover(Mask& lost) const {
    Lanes omega = crossover_guess(), low = 0.0, high = kInfinity;
    Mask open = once_ & (end_ < Lanes(1.0));
    for (int i = 0; i < 200 && any(open); ++i) {
      const Step step = newton_step(omega);
      low = select(open & step.below, omega, low);
      high = select(but_not(open, step.below), omega, high);
      const Mask inside = (step.to > low) & (step.to < high);
      const Lanes middle = select(high < Lanes(kInfinity), sqrt(low * high), Lanes(4.0) * omega);
      const Lanes cut = select(low > Lanes(0.0), middle, Lanes(0.25) * omega);
      const Mask arrived = abs(step.to - omega) < Lanes(1e-9) * omega;
      omega = select(open, select(arrived | inside, step.to, cut), omega);
      open = but_not(open, arrived);
    }
    lost = open;
    return omega;
  }

 private:
  void find_window() {
    const Lanes n02 = loop_.n0 * loop_.n0, n22 = loop_.n2 * loop_.n2, c = loop_.middle;
    rises_from_ = rises_to_ = kInfinity;
    if (loop_.integrators == 0) rises_from_ = select(loop_.n1 > loop_.n0 * loop_.tau_1, Lanes(0.0), rises_from_);
    if (loop_.integrators == 1) rises_from_ = loop_.n0 / loop_.n2;
    if (loop_.integrators == 2) rises_from_ = select(c < Lanes(0.0), Lanes(-2.0) * n02 / c, rises_from_);
    if (loop_.integrators < 3) return;
    const Lanes square = mul_sub_from(Lanes(3.0) * n02, n22, c * c);
    const Mask rises = (c < Lanes(0.0)) & (square > Lanes(0.0));
    if (!any(rises)) return;
    const Lanes half = sqrt(max(square, Lanes(0.0)));
    rises_from_ = select(rises, -(c + half) / n22, rises_from_);
    rises_to_ = select(rises, (half - c) / n22, rises_to_);
  }

  /// The coefficients of x^0, x^1, x^2 ...: those of x^0 is above 0, those from x^3 on are not.
  Mask changes_sign_once() const {
    const int k = loop_.integrators;
    const Lanes filter_lags = Lanes(static_cast<double>(loop_.filters)) * loop_.tau_f * loop_.tau_f;
    const Lanes of_x = loop_.middle - Lanes(k == 1 ? 1.0 : 0.0);
    const Lanes taken = k == 2 ? Lanes(1.0) : k == 1 ? mul_add(loop_.tau_1, loop_.tau_1, filter_lags) : Lanes(0.0);
    const Lanes of_x2 = mul_sub_from(Lanes(1.0), taken, loop_.n2 * loop_.n2);
    return !((of_x < Lanes(0.0)) & (of_x2 > Lanes(0.0)));
  }

  /// |L| begins at n0. From above 1 it crosses once, by Descartes' rule; from below it may stay there.
  void count_without_integrator() {
    once_ = loop_.n0 > Lanes(1.0);
    never_ = (loop_.n0 < Lanes(1.0)) & (falls_ | (top_beyond(Lanes(0.0)) < Lanes(1.0)));
  }

  Mask window_on_one_side() const {
    const Mask below = top_beyond(rises_from_) < Lanes(1.0);
    if (loop_.integrators < 3) return below;
    return below | (ratio(rises_from_) > power(loop_.filter_square(rises_to_), loop_.filters));
  }

  /// |N|^2/x^3
  Lanes ratio(Lanes x) const { return loop_.numerator_square(x) / (x * x * x); }

  /// At least |L|^2 beyond x, in the window and after it: its end or limit, the filter at its most.
  Lanes top_beyond(Lanes x) const {
    const Lanes filters = power(loop_.filter_square(x), loop_.filters);
    if (loop_.integrators == 3) return ratio(rises_to_) / filters;
    if (loop_.integrators == 2) return loop_.n2 * loop_.n2 / filters;
    const Lanes lag = loop_.tau_1 * loop_.tau_1;
    if (loop_.integrators == 0) return loop_.n1 * loop_.n1 / (lag * filters);
    // n0^2/x <= n0 n2, and what then is left of |N|^2/x over the lag is monotonic.
    const Lanes n22 = loop_.n2 * loop_.n2, from = max(x, rises_from_);
    const Lanes at_x = mul_add(n22, from, mul_add(loop_.n0, loop_.n2, loop_.middle)) / loop_.lag_square(from);
    return max(at_x, n22 / lag) / filters;
  }

  Lanes end_gain() const {
    const int degree = loop_.integrators + (loop_.has_lag ? 1 : 0) + loop_.filters;
    if (degree > 2) return Lanes(0.0);
    const Lanes highest = degree == 2 ? loop_.n2 : degree == 1 ? loop_.n1 : loop_.n0;
    return loop_.has_lag ? highest / loop_.tau_1 : highest;
  }

  /// |D|^2 = |N|^2 as a x^2 + b x = d, the filter, and where k = 3 also n0, left aside.
  Lanes crossover_guess() const {
    const Lanes n22 = loop_.n2 * loop_.n2, lag = loop_.tau_1 * loop_.tau_1, c = loop_.middle;
    Lanes a = 1.0, b = -n22, d = max(c, Lanes(0.0));
    if (loop_.integrators < 3) d = loop_.n0 * loop_.n0;
    if (loop_.integrators == 2) a = Lanes(1.0) - n22, b = -c;
    if (loop_.integrators == 1) a = lag - n22, b = Lanes(1.0) - c;
    if (loop_.integrators == 0) a = 0.0, b = mul_sub_from(loop_.n1, loop_.n1, lag), d = d - Lanes(1.0);
    a = max(a, Lanes(1e-3));
    const Lanes root = sqrt(mul_add(b, b, Lanes(4.0) * a * d));
    const Mask flat = b > Lanes(0.0);
    const Lanes x = select(flat, Lanes(2.0) * d, root - b) / select(flat, b + root, Lanes(2.0) * a);
    return sqrt(max(Lanes(1e-12), min(x, Lanes(1e12))));
  }

  struct Step {
    Lanes to;
    Mask below;  ///< the crossover lies above
  };

  /// ln|L|^2 is about 2 (P - D)/(P + D), e^x about (2 + x)/(2 - x): all of it in one division.
  Step newton_step(Lanes omega) const {
    const Lanes x = omega * omega, P = loop_.numerator_square(x);
    const Lanes lag = loop_.lag_square(x), filter = loop_.filter_square(x), both = lag * filter;
    const Lanes D = power(x, loop_.integrators) * lag * power(filter, loop_.filters), excess = P - D;
    const Lanes n = static_cast<double>(loop_.filters), k = static_cast<double>(loop_.integrators);
    const Lanes rise = x * mul_add(Lanes(2.0) * loop_.n2 * loop_.n2, x, loop_.middle);
    const Lanes lags_fall = mul_add(loop_.tau_1 * loop_.tau_1 * filter, x, n * loop_.tau_f * loop_.tau_f * x * lag);
    const Lanes slope = mul_sub_from(P, mul_add(k, both, lags_fall), rise * both);
    const Lanes bottom = (P + D) * slope, most = abs(bottom);
    const Lanes top = max(-most, min(excess * P * both, most));
    return {omega * (bottom + bottom - top) / (bottom + bottom + top), excess > Lanes(0.0)};
  }

  const OpenLoopLanes& loop_;
  Lanes end_, rises_from_, rises_to_;
  Mask falls_, once_, never_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
