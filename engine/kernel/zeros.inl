/// Zeros of a series, located: what the meters need where the cheap test leaves a lane open.
///
/// A panel is cut in halves until in every lane either the series has no zero or its slope has none; then the series is
/// monotonic and has one zero or none, found by Newton's method from the zero of a parabola. What is wanted at a zero is
/// always an extreme of something (of y where y' vanishes, of the integral of e where e does), so an error of the place
/// counts only squared.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// A part of a panel: x = center + half * local, local in [-1, 1].
struct Part {
  double center, half;
  Part left() const { return {center - 0.5 * half, 0.5 * half}; }
  Part right() const { return {center + 0.5 * half, 0.5 * half}; }
  double start() const { return center - half; }
  Lanes at(Lanes local) const { return mul_add(Lanes(half), local, Lanes(center)); }
};

inline constexpr int kHalvings = 8;

struct Ends {
  Lanes left, right, middle;
};

inline Ends ends_of(const Series& f) {
  constexpr double kAtZero[7] = {1, -1.0 / 2, 3.0 / 8, -5.0 / 16, 35.0 / 128, -63.0 / 256, 231.0 / 1024};
  Lanes even = f[0], odd = f[1], middle = f[0];
  for (int k = 2; k < kTerms; k += 2) {
    even += f[k];
    middle = mul_add(Lanes(kAtZero[k / 2]), f[k], middle);
  }
  for (int k = 3; k < kTerms; k += 2) odd += f[k];
  return {even - odd, even + odd, middle};
}

/// Zero of the parabola through both ends and the middle, kept on the panel.
inline Lanes zero_of_parabola(const Ends& e) {
  const Lanes slope = Lanes(0.5) * (e.right - e.left), curve = Lanes(0.5) * (e.right + e.left) - e.middle;
  const Lanes root = sqrt(max(Lanes(0.0), mul_sub_from(Lanes(4.0) * curve, e.middle, slope * slope)));
  const Lanes x = Lanes(-2.0) * e.middle / select(slope < Lanes(0.0), slope - root, slope + root);
  return min(Lanes(1.0), max(Lanes(-1.0), x));
}

/// A place close to a zero of f, and Newton's step -f/f' from there that is left over.
struct Zero {
  Lanes x, step;
};

/// The zero of a monotonic f that changes sign between its ends, to `kNear` of a half panel, in the lanes of `mask`. The
/// bracket keeps Newton's method from running away. A lane that has arrived stays: its bits are its own.
inline Zero zero_of(const Series& f, const Series& slope, const Ends& ends, Mask mask) {
  constexpr double kNear = 3e-4;
  Lanes left = -1.0, right = 1.0, x = zero_of_parabola(ends), step = 0.0;
  Mask open = mask;
  for (int i = 0; i < 40; ++i) {
    Lanes here = 0.0, steep = 0.0;
    for_each_polynomial<kDegree>(x, [&](int k, Lanes P) {
      here = mul_add(f[k], P, here);
      steep = mul_add(slope[k], P, steep);
    });
    step = select(open, -here / steep, step);
    const Mask same_as_left = here * ends.left > Lanes(0.0);
    left = select(same_as_left, x, left);
    right = select(same_as_left, right, x);
    const Lanes next = x + step;
    const Mask inside = (next > left) & (next < right);
    open = but_not(open, abs(step) < Lanes(kNear));
    if (!any(open)) break;
    x = select(open, select(inside, next, Lanes(0.5) * (left + right)), x);
  }
  return {x, step};
}

/// Cuts f on `part` until, in the lanes of `mask`, it is known where f vanishes, and tells the visitor, part after part:
///
///     keeps_sign(f, part, lanes)              no zero
///     may_cross(f, slope, part, ends, lanes)  monotonic: one zero where the ends differ in sign, else none
///
/// `slope` is f' by the local x of the part.
template <typename Visitor>
void search_zeros(const Series& f, const Part& part, Mask mask, int halvings_left, Visitor& visitor) {
  const Mask sure = mask & has_no_zero(f);
  if (any(sure)) visitor.keeps_sign(f, part, sure);
  const Mask open = but_not(mask, sure);
  if (!any(open)) return;
  Series slope;
  set_derivative(slope, f);
  const Mask monotonic = halvings_left == 0 ? open : open & has_no_zero(slope);
  if (any(monotonic)) visitor.may_cross(f, slope, part, ends_of(f), monotonic);
  const Mask undecided = but_not(open, monotonic);
  if (!any(undecided)) return;
  Series& half = slope;
  set_left_half(half, f);
  search_zeros(half, part.left(), undecided, halvings_left - 1, visitor);
  set_right_half(half, f);
  search_zeros(half, part.right(), undecided, halvings_left - 1, visitor);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
