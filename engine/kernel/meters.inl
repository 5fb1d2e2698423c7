/// What is kept of a response while it runs: accumulators that are fed panel by panel, in order of time.
///
/// Extremes and sign changes are located, never sampled: a series that its first terms keep away from zero needs nothing
/// but that test; only where it fails the panel is cut in halves until the test, or the same test on the derivative,
/// decides. In the common case a panel costs a sum of magnitudes and one comparison.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// A part of a panel: x = center + half * local, local in [-1, 1].
struct Part {
  Lanes center, half;
  Part left() const { return {center - Lanes(0.5) * half, Lanes(0.5) * half}; }
  Part right() const { return {center + Lanes(0.5) * half, Lanes(0.5) * half}; }
  Lanes at(Lanes local) const { return mul_add(half, local, center); }
};

inline constexpr int kHalvings = 8;
inline constexpr double kNegligible = 1e-14;

/// x f(x): x P_k = ((k+1) P_{k+1} + k P_{k-1})/(2k + 1), the highest term dropped.
inline Series times_x(const Series& f) {
  Series g;
  g.c[0] = f.c[1] * Lanes(1.0 / 3);
  for (int k = 1; k < kDegree; ++k)
    g.c[k] = mul_add(f.c[k - 1], Lanes(static_cast<double>(k) / (2 * k - 1)),
                     f.c[k + 1] * Lanes((k + 1.0) / (2 * k + 3)));
  g.c[kDegree] = f.c[kDegree - 1] * Lanes(static_cast<double>(kDegree) / (2 * kDegree - 1));
  return g;
}

/// The zero of a monotonic f that changes sign on [-1, 1]: Newton, kept inside the bracket.
inline Lanes bracketed_zero(const Series& f, const Series& slope, Lanes at_left, Lanes at_right) {
  Lanes left = -1.0, right = 1.0;
  Lanes x = (at_left + at_right) / (at_left - at_right);  // regula falsi
  for (int i = 0; i < 7; ++i) {
    const Lanes here = value(f, x);
    const Mask same_as_left = here * at_left > Lanes(0.0);
    left = select(same_as_left, x, left);
    right = select(same_as_left, right, x);
    const Lanes newton = x - here / value(slope, x);
    const Mask outside = (newton < left) | (newton > right);
    x = select(outside, Lanes(0.5) * (left + right), newton);
  }
  return x;
}

/// Total variation, distance from shapes with at most one and two pulses, and largest magnitude of a signal that starts from
/// x(0-) = 0. See engine/measures/variation.h for the definitions.
struct ShapeMeter {
  Lanes rest;                ///< x(inf)
  Lanes last;                ///< value at the last turning point
  Lanes rising;              ///< direction since then: 1, -1, or 0 for none yet
  Lanes variation, largest;  ///< TV and max |x| up to the last turning point
  Lanes shape1, shape2;      ///< variation of the best shape with at most one, at most two pulses
  Lanes above, below;        ///< best first pulse seen from the next one: its variation plus, minus its value
  Lanes passed;              ///< value at the end of the last panel passed
  Lanes furthest, late;      ///< largest |x - x(inf)| of all, and over the last dead time
  Lanes tail;                ///< largest last coefficients: how far from resolved

  bool is_late = false;  ///< the last dead time has begun

  void begin(Lanes at_rest) {
    rest = at_rest;
    last = rising = variation = largest = passed = late = tail = Lanes(0.0);
    furthest = abs(rest);
    shape1 = shape2 = abs(rest);
    above = below = Lanes(-1e300);
  }

  /// A turning point, in the lanes of `mask`.
  void turn(Lanes x, Mask mask) {
    variation = select(mask, variation + abs(x - last), variation);
    largest = select(mask, max(largest, abs(x)), largest);
    last = select(mask, x, last);
    const Mask is_above = mask & (x > rest), is_below = mask & (x < rest);
    const Lanes to_rest = abs(x - rest), first = abs(x);
    furthest = select(mask, max(furthest, to_rest), furthest);
    if (is_late) late = select(mask, max(late, to_rest), late);
    const Lanes second = select(is_above, below + x, above - x);
    const Lanes one = first + to_rest, two = max(one, second + to_rest);
    const Mask pulse = is_above | is_below;
    shape1 = select(pulse, max(shape1, one), shape1);
    shape2 = select(pulse, max(shape2, two), shape2);
    above = select(is_above, max(above, first + x), above);
    below = select(is_below, max(below, first - x), below);
  }

  /// The response begins here, or may jump here.
  void enter(Lanes x, Mask active) {
    const Mask jumps = active & (abs(x - passed) > Lanes(1e-13) * max(largest, abs(x)));
    if (!any(jumps)) return;
    turn(passed, jumps);
    turn(x, jumps);
    rising = select(jumps, Lanes(0.0), rising);
  }

  /// One panel: f, f' per dead time, half the panel's length.
  void watch(const Series& f, const Series& slope, Lanes half, Mask active) {
    tail = select(active, max(tail, abs(f.c[kDegree]) + abs(f.c[kDegree - 1])), tail);
    const Lanes first = abs(slope.c[0]), rest_of_slope = rest_bound(slope, 1);
    // What moves less than rounding has no direction.
    const Lanes noise = Lanes(kNegligible) * (largest + abs(f.c[0]));
    const Mask moves = active & (half * (first + rest_of_slope) > noise);
    const Mask unsure = but_not(moves, first > rest_of_slope);
    if (any(unsure)) return watch_closely(f, slope, moves);
    go_on(slope.c[0], f, Lanes(-1.0), moves);
  }

  /// The value at an edge of a panel.
  void pass(Lanes x, Mask active) {
    passed = select(active, x, passed);
    if (is_late) late = select(active, max(late, abs(x - rest)), late);
  }

  /// The horizon: the last value passed is the last point.
  void finish(Mask mask) { turn(passed, mask); }

  Lanes deviation(Lanes shape) const { return max(Lanes(0.0), variation + abs(rest - last) - shape); }

 private:
  /// From x = `from` on f goes on monotonically in the direction of `slope`.
  void go_on(Lanes slope, const Series& f, Lanes from, Mask mask) {
    const Lanes direction = select(slope > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
    const Mask turned = mask & (direction * rising < Lanes(0.0));
    if (any(turned)) turn(value(f, from), turned);
    rising = select(mask, direction, rising);
  }

  __attribute__((noinline)) void watch_closely(const Series& f, const Series& slope, Mask moves) {
    search(f, slope, {Lanes(0.0), Lanes(1.0)}, moves, kHalvings);
  }

  void search(const Series& f, const Series& slope, const Part& part, Mask mask, int halvings_left) {
    const Mask sure = mask & has_no_zero(slope);
    if (any(sure)) go_on(slope.c[0], f, part.at(-1.0), sure);
    const Mask open = but_not(mask, sure);
    if (!any(open)) return;
    const Series curvature = derivative(slope);
    const Mask monotonic = halvings_left == 0 ? open : open & has_no_zero(curvature);
    if (any(monotonic)) pass_zero(f, slope, curvature, part, monotonic);
    const Mask undecided = but_not(open, monotonic);
    if (!any(undecided)) return;
    search(f, left_half(slope), part.left(), undecided, halvings_left - 1);
    search(f, right_half(slope), part.right(), undecided, halvings_left - 1);
  }

  /// `slope` is monotonic in the lanes of `mask`: it has one zero or none.
  void pass_zero(const Series& f, const Series& slope, const Series& curvature, const Part& part, Mask mask) {
    const Lanes left = value_at_start(slope), right = value_at_end(slope);
    go_on(left, f, part.at(-1.0), mask & (abs(left) > Lanes(0.0)));
    const Mask crosses = mask & (left * right < Lanes(0.0));
    if (any(crosses)) turn(value(f, part.at(bracketed_zero(slope, curvature, left, right))), crosses);
    const Lanes direction = select(right > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
    rising = select(mask & (abs(right) > Lanes(0.0)), direction, rising);
  }
};

/// Integrals of the error e: |e|, e^2, t |e|, t e^2.
struct ErrorMeter {
  Lanes iae, ise, itae, itse;

  void begin() { iae = ise = itae = itse = Lanes(0.0); }

  /// One panel of half length `half` around the time `middle`.
  void watch(const Series& e, Lanes middle, Lanes half, Mask active) {
    add_squares(e, middle, half, active);
    const Mask sure = clearly_has_no_zero(e);
    if (!any(but_not(active, sure))) return add_magnitude(e, middle, half, active);
    const Mask nonzero = active & (rest_bound(e, 0) > Lanes(0.0));
    if (any(nonzero)) search(e, {middle, half}, nonzero, kHalvings);
  }

 private:
  void add_squares(const Series& e, Lanes middle, Lanes half, Mask active) {
    Lanes squares = e.c[0] * e.c[0], moments = Lanes(0.0);
    for (int k = 1; k < kTerms; ++k) {
      const Lanes scaled = e.c[k] * Lanes(1.0 / (2 * k + 1));
      squares = mul_add(e.c[k], scaled, squares);
      moments = mul_add(scaled * Lanes(2.0 * k / (2 * k - 1)), e.c[k - 1], moments);
    }
    const Lanes length = Lanes(2.0) * half;
    ise = select(active, mul_add(length, squares, ise), ise);
    itse = select(active, mul_add(length, mul_add(middle, squares, half * moments), itse), itse);
  }

  /// e keeps its sign.
  void add_magnitude(const Series& e, Lanes middle, Lanes half, Mask mask) {
    const Lanes length = Lanes(2.0) * half;
    iae = select(mask, mul_add(length, abs(e.c[0]), iae), iae);
    const Lanes moment = mul_add(middle, e.c[0], half * e.c[1] * Lanes(1.0 / 3));
    itae = select(mask, mul_add(length, abs(moment), itae), itae);
  }

  __attribute__((noinline)) void search(const Series& e, const Part& part, Mask mask, int halvings_left) {
    const Mask sure = mask & has_no_zero(e);
    if (any(sure)) add_magnitude(e, part.center, part.half, sure);
    const Mask open = but_not(mask, sure);
    if (!any(open)) return;
    const Series slope = derivative(e);
    const Mask monotonic = halvings_left == 0 ? open : open & has_no_zero(slope);
    if (any(monotonic)) pass_zero(e, slope, part, monotonic);
    const Mask undecided = but_not(open, monotonic);
    if (!any(undecided)) return;
    search(left_half(e), part.left(), undecided, halvings_left - 1);
    search(right_half(e), part.right(), undecided, halvings_left - 1);
  }

  void pass_zero(const Series& e, const Series& slope, const Part& part, Mask mask) {
    const Lanes left = value_at_start(e), right = value_at_end(e);
    const Mask crosses = mask & (left * right < Lanes(0.0));
    add_magnitude(e, part.center, part.half, but_not(mask, crosses));
    if (!any(crosses)) return;
    const Lanes x = bracketed_zero(e, slope, left, right);
    const Series sum = integral(e, 1.0, 0.0), moment_sum = integral(times_x(e), 1.0, 0.0);
    const Lanes all = value_at_end(sum), until = value(sum, x);
    const Lanes all_moment = value_at_end(moment_sum), until_moment = value(moment_sum, x);
    iae = select(crosses, mul_add(part.half, abs(until) + abs(all - until), iae), iae);
    const Lanes before = mul_add(part.center, until, part.half * until_moment);
    const Lanes after = mul_add(part.center, all - until, part.half * (all_moment - until_moment));
    itae = select(crosses, mul_add(part.half, abs(before) + abs(after), itae), itae);
  }
};

}  // namespace portrait::PORTRAIT_ISA_NAME
