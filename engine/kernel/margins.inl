/// Stability, peaks of the sensitivity functions and margins of a pack of open loops with one gain crossover each.
///
///     stable  <=>  arg L(jw_c) > -pi, |L(jw_c)| = 1                                  engine/loop/stability.h
///     Ms = sup 1/|1 + L|,  Mt = sup 1/|1 + 1/L|
///
/// From w_c each lane marches down, then up, in steps of its own that move ln L by a fixed small amount; so a narrow peak or
/// a dip of the numerator gets as many points as a broad one. Every least value of |1 + L| and |1 + 1/L| that shows
/// between three points is refined by Newton's method, every passage of arg L through -pi too. A lane ends where bounds of
/// |L| over all that is left prove that no better value can follow.
#pragma once

#include "engine/kernel/open_loop.inl"

namespace portrait::PORTRAIT_ISA_NAME {

class Margins {
 public:
  explicit Margins(const kernel::MarginPack& pack)
      : loop_(pack), highest_at_ends_(pack.highest_at_ends), end_gain_(Lanes::from(pack.end_gain)) {
    find_crossover(Lanes::from(pack.crossover_guess));
    phase_ = loop_.phase(crossover_);
    S_.begin(Lanes(1.0) / (Lanes(1.0) - end_gain_), Lanes(kFar));
    T_.begin(Lanes(1.0), Lanes(0.0));
    T_.offer(end_gain_ / (Lanes(1.0) - end_gain_), Lanes(kFar), all());
    gain_above_ = end_gain_;
    gain_below_ = Lanes(kFar);
  }

  void find() {
    const Mask stable = phase_ > Lanes(-kPi);
    done_ = Mask::from(0);
    const Point here = point(crossover_), next = point(crossover_ + first_step());
    last_below_ = here;
    march_down(next, here, stable);
    march_up(last_below_, here, stable);
  }

  void store(kernel::MarginResult& result) const {
    phase_.to(result.phase), crossover_.to(result.crossover);
    S_.value.to(result.Ms), S_.omega.to(result.Ms_omega);
    T_.value.to(result.Mt), T_.omega.to(result.Mt_omega);
    gain_above_.to(result.gain_above), gain_below_.to(result.gain_below);
    select(done_, Lanes(1.0), Lanes(0.0)).to(result.done);
  }

 private:
  static constexpr double kFar = 1e300;        ///< stands for infinity
  static constexpr double kStep = 0.15;        ///< of ln L, where peaks may lie
  static constexpr double kCoarseStep = 0.6;   ///< where only arg L matters
  static constexpr double kTolerance = 1e-10;  ///< relative, of a peak that is not looked for any more
  static constexpr int kMostSteps = 4000;

  static Mask all() { return Mask::from((1u << kLanes) - 1); }

  struct Best {
    Lanes value, omega;
    void begin(Lanes v, Lanes w) { value = v, omega = w; }
    void offer(Lanes v, Lanes w, Mask mask) {
      const Mask better = mask & (v > value);
      value = select(better, v, value);
      omega = select(better, w, omega);
    }
  };

  /// A point of the march: 1 + L as a distance from 0, and that of 1 + 1/L.
  struct Point {
    Lanes omega, s, t, gain;  ///< s = |1 + L|^2, t = |1 + 1/L|^2, gain = |L|
    Complex L;
    Lanes speed;  ///< |d ln L/d omega|
  };

  Point point(Lanes omega) const {
    const auto at = loop_.at(omega);
    const Lanes square = norm(at.L), s = norm({Lanes(1.0) + at.L.re, at.L.im});
    return {omega, s, s / square, sqrt(square), at.L, sqrt(norm(at.s))};
  }

  Lanes first_step() const {
    const auto at = loop_.at(crossover_);
    return min(Lanes(kStep) / sqrt(norm(at.s)), Lanes(0.25) * crossover_);
  }

  /// |L| = 1: Newton's method on ln|L| over ln omega, inside a bracket, since |L| crosses 1 once and downwards.
  void find_crossover(Lanes omega) {
    Lanes low = 0.0, high = kFar;
    Mask open = all();
    for (int i = 0; i < 200 && any(open); ++i) {
      const Lanes square = loop_.square(omega);
      const Mask below = square > Lanes(1.0);
      low = select(open & below, omega, low);
      high = select(but_not(open, below), omega, high);
      // ln r is about 2 (r - 1)/(r + 1); e^x about (2 + x)/(2 - x).
      const Lanes log_gain = (square - Lanes(1.0)) / (square + Lanes(1.0));
      const Lanes step = max(Lanes(-1.0), min(Lanes(1.0), -log_gain / loop_.log_log_slope(omega)));
      const Lanes newton = omega * (Lanes(2.0) + step) / (Lanes(2.0) - step);
      const Lanes middle = select(high < Lanes(kFar), sqrt(low * high), Lanes(4.0) * omega);
      const Lanes cut = select(low > Lanes(0.0), middle, Lanes(0.25) * omega);
      const Mask inside = (newton > low) & (newton < high);
      const Mask arrived = abs(log_gain) < Lanes(4e-16);
      const Lanes next = select(inside, newton, cut);
      open = but_not(open, arrived | (abs(next - omega) < Lanes(2e-16) * omega));
      omega = select(open, next, omega);
    }
    crossover_ = omega;
  }

  /// Towards omega = 0: |L| > 1.
  void march_down(Point before, Point here, Mask open) {
    for (int i = 0; i < kMostSteps && any(open); ++i) {
      const Lanes inverse_gain = Lanes(1.0) / here.gain;
      const Mask falls = loop_.falls_up_to(here.omega);
      const Mask s_done = falls & ends(inverse_gain, inverse_gain, S_.value);
      const Mask t_done = falls & (ends(Lanes(1.0), inverse_gain, T_.value) | damped(here));
      const Mask found = gain_below_ < Lanes(kFar), none_left = loop_.leads_up_to(here.omega);
      const Mask gain_done = falls & (found | none_left | (here.gain > Lanes(1e12)));
      open = but_not(open, s_done & t_done & gain_done);
      // Far above 1 the curve 1/L is near 0 and changes slowly.
      const Lanes ease = max(Lanes(1.0), Lanes(0.3) * here.gain);
      const Lanes pace = select(s_done & t_done, Lanes(kCoarseStep), Lanes(kStep) * ease);
      const Lanes step = min(pace / here.speed, Lanes(0.5) * here.omega);
      const Point next = point(here.omega - step);
      look_between(next, here, before, open);
      look_for_crossing(next, here, open, true);
      if (i == 0) last_below_ = next;
      before = chosen(open, here, before);
      here = chosen(open, next, here);
    }
    given_up_ = open;
  }

  /// Towards omega = inf: |L| < 1.
  void march_up(Point before, Point here, Mask stable) {
    Mask open = but_not(stable, given_up_);
    for (int i = 0; i < kMostSteps && any(open); ++i) {
      const Lanes beyond = gain_beyond(here);
      const Mask peaks_done = ends(Lanes(1.0), beyond, S_.value) & ends(beyond, beyond, T_.value);
      const Mask gain_done = !(beyond > gain_above_ * Lanes(1 + 1e-12));
      open = but_not(open, peaks_done & gain_done);
      const Lanes pace = select(peaks_done, Lanes(kCoarseStep), Lanes(kStep));
      const Lanes step = min(pace / here.speed, Lanes(0.5) * here.omega);
      const Point next = point(here.omega + step);
      look_between(before, here, next, open);
      look_for_crossing(here, next, open, false);
      before = chosen(open, here, before);
      here = chosen(open, next, here);
    }
    done_ = !(open | given_up_);
  }

  /// At least |L| everywhere beyond a point.
  Lanes gain_beyond(const Point& here) const {
    if (highest_at_ends_) return max(here.gain, end_gain_);
    return select(loop_.falls(), here.gain, sqrt(loop_.square_beyond(here.omega)));
  }

  /// Lanes in which |L/(1 + L)| does not matter below this point any more.
  Mask damped(const Point& here) const { return loop_.damped_up_to(here.omega) | (here.gain > Lanes(1e11)); }

  /// Lanes in which top/(1 - rest), a bound of what is left, does not exceed the best value.
  static Mask ends(Lanes top, Lanes rest, Lanes best) {
    return (rest < Lanes(1.0)) & !(top > best * Lanes(1 + kTolerance) * (Lanes(1.0) - rest));
  }

  static Point chosen(Mask mask, const Point& a, const Point& b) {
    return {select(mask, a.omega, b.omega),
            select(mask, a.s, b.s),
            select(mask, a.t, b.t),
            select(mask, a.gain, b.gain),
            {select(mask, a.L.re, b.L.re), select(mask, a.L.im, b.L.im)},
            select(mask, a.speed, b.speed)};
  }

  /// A least value between a and c shows at b, and may be a better one: it lies no further below b than a or c above.
  static Mask dips(Lanes a, Lanes b, Lanes c, const Best& best) {
    const Lanes higher = max(a, c);
    const Mask better = best.value * best.value * (b + b - higher) < Lanes(1 - 1e-12);
    return but_not(better, (b > a) | (b > c));
  }

  void look_between(const Point& a, const Point& b, const Point& c, Mask open) {
    const Mask s = open & dips(a.s, b.s, c.s, S_), t = open & dips(a.t, b.t, c.t, T_);
    if (any(s)) refine(S_, a.omega, b.omega, c.omega, s, false);
    if (any(t)) refine(T_, a.omega, b.omega, c.omega, t, true);
  }

  /// The least |1 + X|^2, X = L or 1/L, between `low` and `high`: Newton's method on its slope, inside the bracket.
  __attribute__((noinline)) void refine(Best& best, Lanes low, Lanes omega, Lanes high, Mask mask, bool inverted) {
    Lanes least = 1.0, place = omega;
    Mask open = mask;
    for (int i = 0; i < 60 && any(open); ++i) {
      const auto at = loop_.at(omega);
      const Complex X = inverted ? inverse(at.L) : at.L, s = inverted ? -at.s : at.s;
      const Complex ds = inverted ? -at.ds : at.ds;
      const Complex near = {Lanes(1.0) + X.re, X.im}, X1 = X * s, X2 = X * (s * s + ds);
      const Lanes slope = inner(near, X1), curve = norm(X1) + inner(near, X2);
      const Lanes newton = omega - slope / curve;
      low = select(slope < Lanes(0.0), omega, low);
      high = select(slope < Lanes(0.0), high, omega);
      const Mask inside = (curve > Lanes(0.0)) & (newton > low) & (newton < high);
      const Lanes next = select(inside, newton, Lanes(0.5) * (low + high));
      const Lanes left_over = next - omega;
      const Mask arrived = norm(X1) * left_over * left_over < Lanes(1e-10) * norm(near);
      // What Newton's last step still gains: slope^2/curve of |1 + X|^2.
      const Lanes gained = select(inside, slope * slope / curve, Lanes(0.0));
      least = select(open, norm(near) - gained, least);
      place = select(open, next, place);
      open = but_not(open, arrived);
      omega = select(open, next, omega);
    }
    best.offer(Lanes(1.0) / sqrt(least), place, mask);
  }

  /// arg L passes -pi between a and b.
  void look_for_crossing(const Point& a, const Point& b, Mask open, bool below) {
    const Lanes crossing = a.L.re * b.L.im - b.L.re * a.L.im, turn = b.L.im - a.L.im;
    const Mask changes = open & !(a.L.im * b.L.im > Lanes(0.0)) & (crossing * turn < Lanes(0.0));
    if (any(changes)) refine_crossing(a.omega, b.omega, changes, below);
  }

  __attribute__((noinline)) void refine_crossing(Lanes low, Lanes high, Mask mask, bool below) {
    Lanes omega = Lanes(0.5) * (low + high), gain = 1.0;
    const Mask rising = loop_.at(low).L.im < Lanes(0.0);
    Mask open = mask;
    for (int i = 0; i < 80 && any(open); ++i) {
      const auto at = loop_.at(omega);
      const Mask is_low = (rising & (at.L.im < Lanes(0.0))) | but_not(at.L.im > Lanes(0.0), rising);
      low = select(is_low, omega, low);
      high = select(is_low, high, omega);
      const Lanes newton = omega - at.L.im / (at.L.re * at.s.im + at.L.im * at.s.re);
      const Mask inside = (newton > low) & (newton < high);
      const Lanes next = select(inside, newton, Lanes(0.5) * (low + high));
      gain = select(open, sqrt(norm(at.L)), gain);
      open = but_not(open, abs(newton - omega) < Lanes(1e-13) * omega);
      omega = select(open, next, omega);
    }
    if (below)
      gain_below_ = select(mask, min(gain_below_, gain), gain_below_);
    else
      gain_above_ = select(mask, max(gain_above_, gain), gain_above_);
  }

  OpenLoopLanes loop_;
  bool highest_at_ends_;
  Lanes end_gain_, crossover_, phase_, gain_above_, gain_below_;
  Best S_, T_;
  Point last_below_;
  Mask done_, given_up_;
};

inline void find_margins(const kernel::MarginPack& pack, kernel::MarginResult& result) {
  Margins margins(pack);
  margins.find();
  margins.store(result);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
