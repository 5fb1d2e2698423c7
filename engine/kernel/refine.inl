/// Places on L(jw) between two frequencies: the point next to -1, of L or of 1/L, and where L crosses the negative axis.
///
/// Halley's method inside a bracket. What its last step leaves over is added by Taylor's series, so that the value is right
/// to the fourth power of that step.
#pragma once

#include "engine/kernel/open_loop.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// Lanes in which something waits between two frequencies.
struct Bracket {
  Lanes low = 0.0, high = 1.0, guess = 1.0;
  Mask here = Mask::from(0), rises = Mask::from(0);  ///< rises: Im L is below 0 at `low`

  void set(Mask mask, Lanes from, Lanes to, Lanes at) {
    low = select(mask, from, low), high = select(mask, to, high), guess = select(mask, at, guess);
    here = here | mask;
  }
  void forget(Mask lanes) { here = but_not(here, lanes); }
  /// The same for these lanes alone.
  Bracket within(Mask lanes) const {
    Bracket part = *this;
    part.here = here & lanes;
    return part;
  }
};

/// X = L or 1/L, and its first three derivatives.
struct Expansion {
  Complex X, X1, X2, X3;

  Expansion(const LoopCloseAt& close, bool inverted) {
    const Lanes sign = inverted ? -1.0 : 1.0;
    const Complex s = sign * close.at.s, s1 = sign * close.s1, s2 = sign * close.s2, square = s * s;
    X = inverted ? close.at.inverse_square * conjugate(close.at.L) : close.at.L;
    X1 = X * s, X2 = X * (square + s1), X3 = X * (s * (square + Lanes(3.0) * s1) + s2);
  }
};

/// Halley's method in a bracket, whose middle it goes to where a step would lead out of it.
class Narrowing {
 public:
  Lanes place;
  Mask open;

 protected:
  explicit Narrowing(const Bracket& b) : place(b.guess), open(b.here), low_(b.low), high_(b.high) {}

  /// The next step, of which `moved` is the square that a unit of it makes, and `last` that of a step so small that it is
  /// the last one. `trusted`: f, f' and f'' lead to what is looked for.
  Lanes step(Lanes f, Lanes f1, Lanes f2, Mask is_low, Mask trusted, Lanes moved, Lanes last) {
    low_ = select(is_low, place, low_);
    high_ = select(is_low, high_, place);
    const Lanes halley = -(f * f1) / mul_sub_from(Lanes(0.5) * f, f2, f1 * f1), to = place + halley;
    arrived_ = trusted & (moved * halley * halley < last);
    const Mask inside = trusted & (to > low_) & (to < high_);
    return select(arrived_ | inside, halley, Lanes(0.5) * (low_ + high_) - place);
  }

  void take(Lanes step) {
    place = select(open, place + step, place);
    open = but_not(open, arrived_);
  }

 private:
  Lanes low_, high_;
  Mask arrived_;
};

/// What a function with these derivatives gains over h.
inline Lanes gained(Lanes h, Lanes f1, Lanes f2, Lanes f3) {
  return h * mul_add(h, mul_add(h, f3 * Lanes(1.0 / 6), f2 * Lanes(0.5)), f1);
}

/// The least |1 + X|^2 in a bracket.
class Nearest : public Narrowing {
 public:
  Lanes square = 1.0;

  Nearest(const Bracket& b, bool inverted) : Narrowing(b), inverted_(inverted) {}

  template <class OpenLoop>
  void step(const OpenLoop& loop) {
    const Expansion x(loop.close_at(place), inverted_);
    const Complex near = {Lanes(1.0) + x.X.re, x.X.im};
    const Lanes moved = norm(x.X1), value = norm(near);
    // Of half the square.
    const Lanes f1 = inner(near, x.X1), f2 = moved + inner(near, x.X2);
    const Lanes f3 = mul_add(Lanes(3.0), inner(x.X1, x.X2), inner(near, x.X3));
    const Lanes last = Lanes(kLast) * min(value, norm(x.X));
    const Lanes h = Narrowing::step(f1, f2, f3, f1<Lanes(0.0), f2> Lanes(0.0), moved, last);
    square = select(open, mul_add(Lanes(2.0), gained(h, f1, f2, f3), value), square);
    take(h);
  }

 private:
  static constexpr double kLast = 1e-7;  ///< square of a step as a part of the distance from -1, and of |X|

  bool inverted_;
};

/// |L| where Im L = 0 < -Re L, in a bracket at whose ends Im L differs in sign.
class Crossing : public Narrowing {
 public:
  Lanes gain = 1.0;

  explicit Crossing(const Bracket& b) : Narrowing(b), rises_(b.rises) {}

  template <class OpenLoop>
  void step(const OpenLoop& loop) {
    const Expansion x(loop.close_at(place), false);
    const Mask is_low = (rises_ & (x.X.im < Lanes(0.0))) | but_not(x.X.im > Lanes(0.0), rises_);
    const Lanes last = Lanes(kLast) * norm(x.X);
    const Lanes h = Narrowing::step(x.X.im, x.X1.im, x.X2.im, is_low, all_lanes(), norm(x.X1), last);
    gain = select(open, -(x.X.re + gained(h, x.X1.re, x.X2.re, x.X3.re)), gain);
    take(h);
  }

 private:
  static constexpr double kLast = 1e-8;  ///< square of a step of ln L

  Mask rises_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
