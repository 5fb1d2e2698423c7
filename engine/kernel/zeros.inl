/// Zeros of a series, located: what the meters need where the cheap test leaves a lane open.
///
/// A panel is cut in halves until in every lane either the series has no zero or its slope has none; then the series is
/// monotonic and has one zero or none, found by Newton's method from the zero of a parabola. What is wanted at a zero is
/// always an extreme of something (of y where y' vanishes, of the integral of e where e does), so an error of the place
/// counts only squared, and that of Newton's last step to the fourth power.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// A part of a panel: center + half * local, local in [-1, 1].
struct Part {
  Lanes center, half;
  Part left() const { return {mul_sub_from(Lanes(0.5), half, center), Lanes(0.5) * half}; }
  Part right() const { return {mul_add(Lanes(0.5), half, center), Lanes(0.5) * half}; }
  Lanes start() const { return center - half; }
  Lanes at(Lanes local) const { return mul_add(half, local, center); }
};

inline constexpr int kHalvings = 8;

template <int degree>
inline Lanes value_in_middle(const Series& f) {
  constexpr double kAtZero[7] = {1, -1.0 / 2, 3.0 / 8, -5.0 / 16, 35.0 / 128, -63.0 / 256, 231.0 / 1024};
  Lanes sum = f[0];
  for (int k = 2; k <= degree; k += 2) sum = mul_add(Lanes(kAtZero[k / 2]), f[k], sum);
  return sum;
}

/// Zero of the parabola through both ends and the middle, kept on the panel.
inline Lanes zero_of_parabola(const Ends& e, Lanes middle) {
  const Lanes slope = Lanes(0.5) * (e.right - e.left), curve = Lanes(0.5) * (e.right + e.left) - middle;
  const Lanes root = sqrt(max(Lanes(0.0), mul_sub_from(Lanes(4.0) * curve, middle, slope * slope)));
  const Lanes x = Lanes(-2.0) * middle / select(slope < Lanes(0.0), slope - root, slope + root);
  return min(Lanes(1.0), max(Lanes(-1.0), x));
}

/// P_k(x) = sum_j of[k][j] x^j
struct PowerTable {
  double of[kTerms][kTerms];
};

constexpr PowerTable make_power_table() {
  PowerTable t{};
  t.of[0][0] = 1;
  t.of[1][1] = 1;
  for (int k = 1; k + 1 < kTerms; ++k)
    for (int j = 0; j <= k + 1; ++j)
      t.of[k + 1][j] = ((2 * k + 1) * (j > 0 ? t.of[k][j - 1] : 0) - k * t.of[k - 1][j]) / (k + 1);
  return t;
}

inline constexpr PowerTable kPowers = make_power_table();

/// f by powers of x: less exact than the series by the size of P_k's coefficients, which the small last coefficients of f
/// take back, and with two short chains of operations in place of one long recursion.
template <int degree>
class Powers {
 public:
  explicit Powers(const Series& f) {
    for (int j = 0; j <= degree; ++j) {
      Lanes sum = 0.0;
      for (int k = j; k <= degree; k += 2) sum = mul_add(f[k], Lanes(kPowers.of[k][j]), sum);
      a_[j] = sum;
    }
  }
  static Powers derivative(const Powers& f) {
    Powers slope;
    for (int j = 0; j < degree; ++j) slope.a_[j] = Lanes(j + 1.0) * f.a_[j + 1];
    slope.a_[degree] = 0.0;
    return slope;
  }

  Lanes value(Lanes x) const {
    static_assert(degree % 2 == 0);
    const Lanes z = x * x;
    Lanes even = a_[degree], odd = a_[degree - 1];
    for (int j = degree - 2; j >= 0; j -= 2) even = mul_add(even, z, a_[j]);
    for (int j = degree - 3; j >= 1; j -= 2) odd = mul_add(odd, z, a_[j]);
    return mul_add(odd, x, even);
  }

 private:
  Powers() = default;
  Lanes a_[degree + 1];
};

/// The zero of a monotonic f that changes sign between its ends, in the lanes of `mask`, to the square of Newton's last step,
/// which is `kNear` of a half panel at most. The bracket keeps Newton's method from running away. A lane that has arrived
/// stays: its bits are its own.
template <int degree>
inline Lanes zero_of(const Series& f, const Ends& ends, Mask mask) {
  const Powers<degree> powers(f), slopes = Powers<degree>::derivative(powers);
  constexpr double kNear = 3e-4;
  Lanes left = -1.0, right = 1.0, x = zero_of_parabola(ends, value_in_middle<degree>(f));
  Mask open = mask;
  for (int i = 0; i < 40 && any(open); ++i) {
    const Lanes here = powers.value(x), step = -here / slopes.value(x), next = x + step;
    const Mask same_as_left = here * ends.left > Lanes(0.0);
    left = select(same_as_left, x, left);
    right = select(same_as_left, right, x);
    const Mask inside = (next > left) & (next < right), arrived = abs(step) < Lanes(kNear);
    // Where f is nothing but rounding no step means anything.
    const Lanes otherwise = select(arrived, x, Lanes(0.5) * (left + right));
    x = select(open, select(inside, next, otherwise), x);
    open = but_not(open, arrived);
  }
  return x;
}

/// Cuts f on `part` until, in the lanes of `mask`, it is known where f vanishes, and tells the visitor, part after part:
///
///     keeps_sign(f, part, lanes)       no zero
///     may_cross(f, part, ends, lanes)  monotonic: one zero where the ends differ in sign, else none
template <int degree, typename Visitor>
void search_zeros(const Series& f, const Part& part, Mask mask, int halvings_left, Visitor& visitor) {
  Series slope;
  set_derivative<degree>(slope, f);
  const Mask monotonic = halvings_left == 0 ? mask : mask & has_no_zero<degree>(slope);
  if (any(monotonic)) visitor.may_cross(f, part, ends_of<degree>(f), monotonic);
  const Mask open = but_not(mask, monotonic);
  if (!any(open)) return;
  const Mask sure = open & has_no_zero<degree>(f);
  if (any(sure)) visitor.keeps_sign(f, part, sure);
  const Mask undecided = but_not(open, sure);
  if (!any(undecided)) return;
  Series& half = slope;
  set_left_half<degree>(half, f);
  search_zeros<degree>(half, part.left(), undecided, halvings_left - 1, visitor);
  set_right_half<degree>(half, f);
  search_zeros<degree>(half, part.right(), undecided, halvings_left - 1, visitor);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
