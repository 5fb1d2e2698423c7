/// What is kept of a response while it runs: accumulators that are fed panel by panel, in order of time.
///
/// Extremes and sign changes are located, never sampled: a series that its first term keeps away from zero needs nothing
/// but that test, a sum of magnitudes and a comparison; only where it fails zeros.inl is asked.
#pragma once

#include "engine/kernel/zeros.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr double kNegligible = 1e-14;

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
  void watch(const Series& f, const Series& slope, double half, Mask active) {
    tail = select(active, max(tail, abs(f[kDegree]) + abs(f[kDegree - 1])), tail);
    const Lanes first = abs(slope[0]), rest_of_slope = rest_bound(slope, 1);
    // What moves less than rounding has no direction.
    const Lanes noise = Lanes(kNegligible) * (largest + abs(f[0]));
    const Mask moves = active & (Lanes(half) * (first + rest_of_slope) > noise);
    if (any(but_not(moves, first > rest_of_slope))) return watch_closely(f, slope, half, moves);
    go_on(slope[0], f, -1.0, moves);
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
  /// What zeros.inl finds of f' on one panel.
  struct SlopeVisitor {
    ShapeMeter& meter;
    const Series& f;
    double half;

    void keeps_sign(const Series& slope, const Part& part, Mask mask) {
      meter.go_on(slope[0], f, part.start(), mask);
    }

    void may_cross(const Series& slope, const Series& curvature, const Part& part, const Ends& ends, Mask mask) {
      // Where f' is 0 at the left end its direction is that of the right.
      const Lanes first = select(abs(ends.left) > Lanes(0.0), ends.left, ends.right);
      meter.go_on(first, f, part.start(), mask & (abs(first) > Lanes(0.0)));
      const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
      if (any(crosses)) meter.turn(extreme(slope, curvature, part, ends, crosses), crosses);
      const Lanes direction = select(ends.right > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
      meter.rising = select(mask & (abs(ends.right) > Lanes(0.0)), direction, meter.rising);
    }

    /// f where its slope vanishes: from x on Newton's last step adds (step/2) f'(x), f' by the panel's x.
    Lanes extreme(const Series& slope, const Series& curvature, const Part& part, const Ends& ends, Mask mask) {
      const Zero zero = zero_of(slope, curvature, ends, mask);
      const Lanes left_over = Lanes(0.5 * half * part.half) * zero.step * value(slope, zero.x);
      return value(f, part.at(zero.x)) + left_over;
    }
  };

  /// From x = `from` on f goes on monotonically in the direction of `slope`.
  void go_on(Lanes slope, const Series& f, double from, Mask mask) {
    const Lanes direction = select(slope > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
    const Mask turned = mask & (direction * rising < Lanes(0.0));
    if (any(turned)) turn(value(f, from), turned);
    rising = select(mask, direction, rising);
  }

  __attribute__((noinline)) void watch_closely(const Series& f, const Series& slope, double half, Mask moves) {
    SlopeVisitor visitor{*this, f, half};
    search_zeros(slope, {0, 1}, moves, kHalvings, visitor);
  }
};

/// Integrals of the error e: |e|, e^2, t |e|, t e^2.
struct ErrorMeter {
  Lanes iae, ise, itae, itse;

  void begin() { iae = ise = itae = itse = Lanes(0.0); }

  /// One panel of half length `half` around the time `middle`.
  void watch(const Series& e, double middle, double half, Mask active) {
    add_squares(e, middle, half, active);
    const Lanes first = abs(e[0]), rest = rest_bound(e, 1);
    const Mask open = but_not(active, first > rest);
    if (!any(open)) return add_magnitude(e, {middle, half}, active);
    search(e, {middle, half}, active & (first + rest > Lanes(0.0)));
  }

 private:
  struct ErrorVisitor {
    ErrorMeter& meter;
    void keeps_sign(const Series& e, const Part& part, Mask mask) { meter.add_magnitude(e, part, mask); }
    void may_cross(const Series& e, const Series& slope, const Part& part, const Ends& ends, Mask mask) {
      const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
      meter.add_magnitude(e, part, but_not(mask, crosses));
      if (any(crosses)) meter.add_both_signs(e, slope, part, ends, crosses);
    }
  };

  __attribute__((noinline)) void search(const Series& e, const Part& part, Mask mask) {
    ErrorVisitor visitor{*this};
    search_zeros(e, part, mask, kHalvings, visitor);
  }

  /// int P_j^2 = 2/(2j+1), int x P_j P_{j-1} = 2j/((2j-1)(2j+1)).
  void add_squares(const Series& e, double middle, double half, Mask active) {
    Lanes squares = e[0] * e[0], moments = Lanes(0.0);
    for (int k = 1; k < kTerms; ++k) {
      const Lanes scaled = e[k] * Lanes(1.0 / (2 * k + 1));
      squares = mul_add(e[k], scaled, squares);
      moments = mul_add(scaled * Lanes(2.0 * k / (2 * k - 1)), e[k - 1], moments);
    }
    ise = select(active, mul_add(Lanes(2 * half), squares, ise), ise);
    const Lanes moment = mul_add(Lanes(middle), squares, Lanes(half) * moments);
    itse = select(active, mul_add(Lanes(2 * half), moment, itse), itse);
  }

  /// e keeps its sign. Part: the time here.
  void add_magnitude(const Series& e, const Part& part, Mask mask) {
    const Lanes length = 2 * part.half;
    iae = select(mask, mul_add(length, abs(e[0]), iae), iae);
    const Lanes moment = mul_add(Lanes(part.center), e[0], Lanes(part.half / 3) * e[1]);
    itae = select(mask, mul_add(length, abs(moment), itae), itae);
  }

  /// e changes its sign once: both integrals from the left end to there, and the rest. int_{-1}^x P_k and
  /// int_{-1}^x s P_k(s) ds are sums of two and four polynomials; Newton's last step adds half of itself times e(x).
  void add_both_signs(const Series& e, const Series& slope, const Part& part, const Ends& ends, Mask mask) {
    const Zero zero = zero_of(e, slope, ends, mask);
    Series by_x;
    set_times_x(by_x, e);
    Lanes P[kTerms + 1];
    for_each_polynomial<kTerms>(zero.x, [&](int k, Lanes here) { P[k] = here; });
    Lanes until = e[0] * (zero.x + Lanes(1.0)), moment_until = by_x[0] * (zero.x + Lanes(1.0)), here = e[0];
    for (int k = 1; k < kTerms; ++k) {
      const Lanes integral = (P[k + 1] - P[k - 1]) * Lanes(1.0 / (2 * k + 1));
      until = mul_add(e[k], integral, until);
      moment_until = mul_add(by_x[k], integral, moment_until);
      here = mul_add(e[k], P[k], here);
    }
    const Lanes left_over = Lanes(0.5) * zero.step * here;
    until += left_over;
    moment_until = mul_add(zero.x, left_over, moment_until);
    const Lanes rest = Lanes(2.0) * e[0] - until, moment_rest = Lanes(2.0) * by_x[0] - moment_until;
    iae = select(mask, mul_add(Lanes(part.half), abs(until) + abs(rest), iae), iae);
    const Lanes before = mul_add(Lanes(part.center), until, Lanes(part.half) * moment_until);
    const Lanes after = mul_add(Lanes(part.center), rest, Lanes(part.half) * moment_rest);
    itae = select(mask, mul_add(Lanes(part.half), abs(before) + abs(after), itae), itae);
  }
};

}  // namespace portrait::PORTRAIT_ISA_NAME
