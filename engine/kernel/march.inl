/// The march along L(jw), up and down from the gain crossover: it brackets whatever may be a peak or a margin.
///
/// Steps move ln L by a fixed small amount, so a narrow peak or a dip of the numerator gets as many points as a broad
/// one; a step over which the slope of ln L turns out to have changed too much is taken again at half its length. A least
/// |1 + L| or |1 + 1/L| shows by the signs of its slope, a passage of arg L through -pi by that of Im L. A lane ends
/// where bounds of |L| over all that is left prove that no better value can follow.
#pragma once

#include "engine/kernel/gain.inl"
#include "engine/kernel/refine.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// Frequencies below which what is named holds, as x = omega^2.
class Limits {
 public:
  Lanes leads;   ///< arg L stays above -pi
  Lanes damped;  ///< |L/(1 + L)| stays below 1

  explicit Limits(const OpenLoopLanes& loop) : leads(leading(loop)), damped(0.0), loop_(loop) {
    if (loop.integrators == 1) damped = damping(loop);
  }

  /// Lanes in which no |L/(1 + L)| below x matters, 1/sqrt(T_square) being seen: it stays below 1, or, with |M| as free to
  /// choose as it likes in what `damping` compares, below 1/sqrt(1 - w^2 (lags - a/(1 + a^2 w^2))^2).
  Mask damp(Lanes x, Lanes T_square, double tolerance) const {
    const Mask known = x < damped;
    if (loop_.integrators != 1) return known;
    const Lanes a = loop_.n1 / loop_.n0, z = mul_add(a * a, x, Lanes(1.0));
    const Lanes lag = max(Lanes(0.0), mul_add(loop_.lags, z, -a));
    return known | !(x * lag * lag > (Lanes(1 + tolerance) - T_square) * z * z);
  }

 private:
  /// With a = n1/n0, arg L + k pi/2 >= atan(a w) - lags w, and atan t > 3 t/(1 + 2 sqrt(1 + t^2)).
  static Lanes leading(const OpenLoopLanes& loop) {
    const Lanes straight = Lanes(kPi) / loop.lags;
    if (loop.integrators == 0) return straight * straight;
    if (loop.integrators == 1) return Lanes(0.25) * straight * straight;
    if (loop.integrators == 3) return 0.0;
    const Lanes a = loop.n1 / loop.n0, root = Lanes(1.5) * a / loop.lags - Lanes(0.5);
    return select(root > Lanes(1.0), (root * root - Lanes(1.0)) / (a * a), Lanes(0.0));
  }

  /// With M = 1/L, |1 + M|^2 = 1 + |M| (|M| + 2 cos arg M), and for one integrator, a = n1/n0, n2 w^2 < 2 n0
  ///
  ///     |M| >= w/(n0 sqrt(1 + a^2 w^2)),     cos arg M >= -w (lags - a/(1 + a^2 w^2))
  ///
  /// which compared give a quadratic inequality for 1/sqrt(1 + a^2 w^2).
  static Lanes damping(const OpenLoopLanes& loop) {
    const Lanes a = loop.n1 / loop.n0, root = sqrt(mul_add(Lanes(16.0) * loop.lags * loop.n1, loop.n0, Lanes(1.0)));
    const Lanes least = Lanes(4.0) * loop.lags * loop.n0 / (Lanes(1.0) + root), square = least * least;
    const Lanes x = min((Lanes(1.0) - square) / (square * a * a), loop.n0 / loop.n2);
    return select(square < Lanes(1.0), x, Lanes(0.0));
  }

  const OpenLoopLanes& loop_;
};

/// The largest of a function's values so far, as the least square of a distance from -1, and its place.
struct Peak {
  Lanes square, omega;

  void offer(Lanes candidate, Lanes where, Mask mask) {
    const Mask better = mask & (candidate < square);
    square = select(better, candidate, square);
    omega = select(better, where, omega);
  }
};

/// Of loops with one gain crossover or none. OpenLoop, Gain and Limits as those of margins.inl.
template <class OpenLoop, class Gain, class Limits>
class March {
 public:
  Peak S, T;
  Lanes gain_above,
      gain_below;  ///< |L| where arg L = -pi: the largest below 1, the smallest above; 0 and inf: none
  Mask given_up = Mask::from(0);

  March(const OpenLoop& loop, const Gain& gain, const Limits& limits) : loop_(loop), gain_(gain), limits_(limits) {
    const Lanes end = gain.end(), room = Lanes(1.0) - end;
    S = {room * room, Lanes(kInfinity)};
    T = {Lanes(1.0), Lanes(0.0)};
    if (loop.integrators == 0) T.square = squared((Lanes(1.0) + loop.n0) / loop.n0);
    T.offer(squared(room / end), Lanes(kInfinity), end > Lanes(0.0));
    S_seen_ = S.square, T_seen_ = T.square;
    gain_above = end, gain_below = kInfinity, above_seen_ = end * end;
    lowest_ = loop.integrators == 0 ? loop.rest() : Lanes(0.0);
  }

  /// From omega, up in some lanes, down in others.
  void run(Lanes omega, Mask up, Mask down) {
    const Point from = point(omega);
    see(from, up | down);
    Side upper{from, Lanes(1.0), Lanes(1.0), up}, lower{from, Lanes(1.0), Lanes(1.0), down};
    plan_up(upper, up), plan_down(lower, down);
    for (int i = 0; i < kMostSteps && any(upper.open | lower.open); ++i) {
      if (any(upper.open)) step_up(upper);
      if (any(lower.open)) step_down(lower);
    }
    given_up = given_up | upper.open | lower.open | (up & (upper.here.omega > Lanes(kLargestAngle)));
    narrow_down(all_lanes());
  }

 private:
  static constexpr double kStep = 0.3;        ///< of ln L, where peaks may lie
  static constexpr double kCoarseStep = 1.0;  ///< where only arg L matters
  static constexpr double kLevel = 0.15;      ///< a slope, as a part of that of a straight passage
  static constexpr int kCloseSteps = 8;
  static constexpr double kMostChange = 0.7;  ///< of its slope times a step, however far from -1
  static constexpr double kTolerance =
      2e-10;  ///< relative, of the square of a peak that is not looked for any more
  static constexpr int kMostSteps = 4000;
  static constexpr int kMostNarrowings = 80;

  /// |1 + X|^2, X = L or 1/L, and half its derivative.
  struct Distance {
    Lanes square, slope;
  };

  struct Point {
    Lanes omega, square, inverse_square;  ///< of |L|
    Complex L, s;
    Distance near, far;  ///< of X = L, and of X = 1/L
  };

  struct Side {
    Point here;
    Lanes step, pace;
    Mask open;
  };

  static Lanes squared(Lanes a) { return a * a; }

  /// |a|, up to 8 % too large.
  static Lanes size(Complex a) {
    const Lanes re = abs(a.re), im = abs(a.im);
    return mul_add(Lanes(0.414), min(re, im), max(re, im));
  }

  Point point(Lanes omega) const {
    const auto at = loop_.at(omega);
    const Complex near = {Lanes(1.0) + at.L.re, at.L.im}, slope = conjugate(near) * at.s;
    const Lanes square = norm(near);
    return {omega,
            norm(at.L),
            at.inverse_square,
            at.L,
            at.s,
            {square, mul_sub_from(slope.im, at.L.im, slope.re * at.L.re)},
            {square * at.inverse_square, -(slope.re * at.inverse_square)}};
  }

  static Distance chosen(Mask mask, const Distance& a, const Distance& b) {
    return {select(mask, a.square, b.square), select(mask, a.slope, b.slope)};
  }

  static Point chosen(Mask mask, const Point& a, const Point& b) {
    return {select(mask, a.omega, b.omega),
            select(mask, a.square, b.square),
            select(mask, a.inverse_square, b.inverse_square),
            select(mask, a.L, b.L),
            select(mask, a.s, b.s),
            chosen(mask, a.near, b.near),
            chosen(mask, a.far, b.far)};
  }

  void see(const Point& p, Mask mask) {
    S_seen_ = select(mask, min(S_seen_, p.near.square), S_seen_);
    T_seen_ = select(mask, min(T_seen_, p.far.square), T_seen_);
  }

  void step_up(Side& side) {
    const Point next = point(side.here.omega + side.step);
    const Mask taken = taken_by(side, next);
    look_between(side.here, next, taken);
    look_for_crossing(side.here, next, taken, true);
    side.here = chosen(taken, next, side.here);
    see(next, taken);
    plan_up(side, taken);
  }

  void step_down(Side& side) {
    const Point next = point(side.here.omega - side.step);
    const Mask taken = taken_by(side, next);
    look_between(next, side.here, taken);
    look_for_crossing(next, side.here, taken, false);
    side.here = chosen(taken, next, side.here);
    see(next, taken);
    plan_down(side, taken);
  }

  /// Lanes that take the step. In the others it is shortened: where the slope of ln L has changed so much that a peak might
  /// hide, and where arg L turns so near to -pi that it may pass it and come back.
  Mask taken_by(Side& side, const Point& next) const {
    const Point& here = side.here;
    const Mask rough = size(next.s + -here.s) * side.step > min(side.pace, Lanes(kMostChange));
    side.step = select(side.open & rough, Lanes(0.5) * side.step, side.step);
    const Mask fine = but_not(side.open, rough);
    const Mask turns = fine & (here.s.im * next.s.im < Lanes(0.0)) & (here.L.re < Lanes(0.0));
    return any(turns) ? but_not(fine, stopped_where_it_turns(side, next, turns)) : fine;
  }

  __attribute__((noinline)) Mask stopped_where_it_turns(Side& side, const Point& next, Mask turns) const {
    const Point& here = side.here;
    const Lanes turn = min(abs(here.s.im), abs(next.s.im)) * side.step;
    const Mask near_to_here = abs(here.L.im) < turn * sqrt(here.square);
    const Mask near = near_to_here | (abs(next.L.im) < turn * sqrt(next.square));
    const Mask stopped = turns & near & (turn > Lanes(1e-10));
    side.step = select(stopped, side.step * here.s.im / (here.s.im - next.s.im), side.step);
    return stopped;
  }

  /// Towards omega = inf, |L| < 1: |1 + L| >= 1 - |L|, |1 + 1/L| >= 1/|L| - 1.
  void plan_up(Side& side, Mask taken) {
    const Point& p = side.here;
    const Lanes square = gain_.square_beyond(p.omega * p.omega, p.square), gain = sqrt(square);
    const Lanes room = Lanes(1.0) - gain, enough = room * room * Lanes(1 + kTolerance);
    const Mask peaks_done = (gain < Lanes(1.0)) & !(enough < S_seen_) & !(enough < T_seen_ * square);
    const Mask gain_done = !(square > above_seen_ * Lanes(1 + 1e-12));
    side.open = but_not(side.open, peaks_done & gain_done);
    const Lanes pace = select(peaks_done, Lanes(kCoarseStep), Lanes(kStep));
    set_step(side, pace, Lanes(1.0), taken);
  }

  /// Towards omega = 0, |L| > 1: |1 + L| >= |L| - 1, |1 + 1/L| >= 1 - 1/|L|.
  void plan_down(Side& side, Mask taken) {
    const Point& p = side.here;
    const Lanes x = p.omega * p.omega, gain = sqrt(p.square), room = gain - Lanes(1.0);
    const Lanes enough = room * room * Lanes(1 + kTolerance);
    const Mask above = gain > Lanes(1.0), falls = gain_.falls_up_to(x);
    const Mask S_done = above & !(enough < S_seen_);
    const Mask T_done = (above & !(enough < T_seen_ * p.square)) | limits_.damp(x, T_seen_, kTolerance);
    const Mask gain_done =
        below_.here | (gain_below < Lanes(kInfinity)) | !(x > limits_.leads) | (gain > Lanes(1e12));
    const Mask peaks_done = falls & S_done & T_done;
    side.open = but_not(side.open, (peaks_done & gain_done) | !(p.omega > lowest_));
    // Far above 1 the curve 1/L is near 0 and changes slowly.
    const Lanes ease = max(Lanes(1.0), Lanes(0.3) * gain);
    const Lanes pace = select(peaks_done, Lanes(kCoarseStep), Lanes(kStep) * ease);
    set_step(side, pace, Lanes(0.5), taken);
  }

  void set_step(Side& side, Lanes pace, Lanes most, Mask mask) const {
    const Lanes step = min(pace / size(side.here.s), most * side.here.omega);
    side.step = select(mask, step, side.step);
    side.pace = select(mask, pace, side.pace);
  }

  void look_between(const Point& a, const Point& b, Mask mask) {
    const Lanes straight = Lanes(kLevel) * norm(a.s) * (b.omega - a.omega);
    const Mask S_level = mask & is_level(a.near, b.near, straight * min(a.square, b.square));
    const Mask T_level = mask & is_level(a.far, b.far, straight * min(a.inverse_square, b.inverse_square));
    keep_dip(a.omega, b.omega, a.near, b.near, but_not(mask, S_level), false);
    keep_dip(a.omega, b.omega, a.far, b.far, but_not(mask, T_level), true);
    if (any(S_level)) look_closely(a, b, S_level, false);
    if (any(T_level)) look_closely(a, b, T_level, true);
  }

  /// At both ends the distance changes far less than it would where L goes straight past -1: L may go round it in a circle, and
  /// have two dips.
  static Mask is_level(const Distance& a, const Distance& b, Lanes straight) {
    return max(abs(a.slope), abs(b.slope)) < straight;
  }

  /// What is level is searched by smaller steps if it is as low as anything seen.
  __attribute__((noinline)) void look_closely(const Point& a, const Point& b, Mask mask, bool inverted) {
    const auto distance = [inverted](const Point& p) { return inverted ? p.far : p.near; };
    const Distance at_a = distance(a), at_b = distance(b);
    const Lanes whole = b.omega - a.omega, change = Lanes(2.0) * whole * max(abs(at_a.slope), abs(at_b.slope));
    const Mask low = mask & (min(at_a.square, at_b.square) - change < (inverted ? T_seen_ : S_seen_));
    if (!any(low)) return;
    Point last = a;
    for (int i = 1; i <= kCloseSteps; ++i) {
      const Point next = i < kCloseSteps ? point(mul_add(Lanes(i * (1.0 / kCloseSteps)), whole, a.omega)) : b;
      see(next, low);
      keep_dip(last.omega, next.omega, distance(last), distance(next), low, inverted);
      last = next;
    }
  }

  void keep_dip(Lanes a, Lanes b, const Distance& at_a, const Distance& at_b, Mask mask, bool inverted) {
    const Mask dips = mask & (at_a.slope < Lanes(0.0)) & (at_b.slope > Lanes(0.0));
    if (any(dips)) keep(a, b, at_a, at_b, dips, inverted);
  }

  /// A dip waits, unless twice the depth that a parabola would have below a and b leaves it above what has been seen.
  __attribute__((noinline)) void keep(Lanes a, Lanes b, const Distance& at_a, const Distance& at_b, Mask mask,
                                      bool inverted) {
    const Lanes guess = a + (b - a) * at_a.slope / (at_a.slope - at_b.slope);
    const Lanes least = min(mul_add(Lanes(2.0) * at_a.slope, guess - a, at_a.square),
                            mul_sub_from(Lanes(2.0) * at_b.slope, b - guess, at_b.square));
    const Mask hopeful = but_not(mask, least > (inverted ? T_seen_ : S_seen_));
    Bracket& waiting = inverted ? T_dip_ : S_dip_;
    const Mask twice = hopeful & waiting.here;
    if (any(twice)) narrow_down(twice);
    waiting.set(hopeful, a, b, guess);
  }

  /// arg L passes -pi between a and b, where the chord of L crosses the negative axis.
  void look_for_crossing(const Point& a, const Point& b, Mask mask, bool above) {
    const Lanes crossing = a.L.re * b.L.im - b.L.re * a.L.im, turn = b.L.im - a.L.im;
    const Mask passes = mask & !(a.L.im * b.L.im > Lanes(0.0)) & (crossing * turn < Lanes(0.0));
    if (any(passes)) keep_crossing(a, b, passes, above);
  }

  __attribute__((noinline)) void keep_crossing(const Point& a, const Point& b, Mask mask, bool above) {
    // Im L/|L| is nearly straight.
    const Lanes at_a = a.L.im * sqrt(b.square), at_b = b.L.im * sqrt(a.square);
    Bracket& waiting = above ? above_ : below_;
    const Mask twice = mask & waiting.here;
    if (any(twice)) narrow_down(twice);
    waiting.set(mask, a.omega, b.omega, a.omega + (b.omega - a.omega) * at_a / (at_a - at_b));
    waiting.rises = select(mask, a.L.im < Lanes(0.0), waiting.rises);
    if (above) above_seen_ = select(mask, max(above_seen_, min(a.square, b.square)), above_seen_);
  }

  /// All brackets of these lanes side by side, to hide what each waits for. Other lanes go on waiting: what is known of a
  /// lane decides its steps, and would make its last bits depend on its neighbours.
  __attribute__((noinline)) void narrow_down(Mask lanes) {
    Nearest S_dip(S_dip_.within(lanes), false), T_dip(T_dip_.within(lanes), true);
    Crossing over(above_.within(lanes)), under(below_.within(lanes));
    for (int i = 0; i < kMostNarrowings && any(S_dip.open | T_dip.open | over.open | under.open); ++i) {
      if (any(S_dip.open)) S_dip.step(loop_);
      if (any(T_dip.open)) T_dip.step(loop_);
      if (any(over.open)) over.step(loop_);
      if (any(under.open)) under.step(loop_);
    }
    given_up = given_up | S_dip.open | T_dip.open | over.open | under.open;
    S.offer(S_dip.square, S_dip.place, S_dip_.here & lanes);
    T.offer(T_dip.square, T_dip.place, T_dip_.here & lanes);
    gain_above = select(above_.here & lanes, max(gain_above, over.gain), gain_above);
    gain_below = select(below_.here & lanes, min(gain_below, under.gain), gain_below);
    S_seen_ = min(S_seen_, S.square), T_seen_ = min(T_seen_, T.square);
    S_dip_.forget(lanes), T_dip_.forget(lanes), above_.forget(lanes), below_.forget(lanes);
  }

  const OpenLoop& loop_;
  const Gain& gain_;
  const Limits& limits_;
  Lanes lowest_, S_seen_, T_seen_, above_seen_;
  Bracket S_dip_, T_dip_, above_, below_;
};

inline Lanes flags(Mask mask) { return select(mask, Lanes(1.0), Lanes(0.0)); }

template <class March>
void store_margins(const March& march, kernel::MarginResult& result) {
  (Lanes(1.0) / sqrt(march.S.square)).to(result.Ms), march.S.omega.to(result.Ms_omega);
  (Lanes(1.0) / sqrt(march.T.square)).to(result.Mt), march.T.omega.to(result.Mt_omega);
  (Lanes(1.0) / march.gain_above).to(result.GM);
  (Lanes(1.0) / march.gain_below).to(result.GM_low);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
