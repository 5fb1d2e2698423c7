/// Sine, cosine and arc tangent in lanes.
///
/// Taylor's series after a reduction of the argument that makes them short: no coefficient but 1/n! and 1/(2n + 1).
/// domain    |x| below 1e5 for sine and cosine, t >= 0 for the arc tangent
#pragma once

#include "engine/kernel/lanes.inl"

namespace portrait::PORTRAIT_ISA_NAME {

struct SineCosine {
  Lanes sine, cosine;
};

/// x = q pi/2 + r, |r| <= pi/4, with pi/2 in three parts so that q pi/2 is exact for the q in use.
inline SineCosine sine_cosine(Lanes x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves the nearest whole number
  constexpr double kHalfPi[3] = {1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21};
  const Lanes q = (x * Lanes(0.63661977236758134308) + Lanes(kRound)) - Lanes(kRound);
  Lanes r = x;
  for (const double part : kHalfPi) r = mul_sub_from(q, Lanes(part), r);
  const Lanes z = r * r;
  Lanes s = 1.0, c = 1.0;
  for (int n = 9; n >= 1; --n) {
    s = mul_sub_from(z * Lanes(1.0 / ((2 * n) * (2 * n + 1))), s, Lanes(1.0));
    c = mul_sub_from(z * Lanes(1.0 / ((2 * n - 1) * (2 * n))), c, Lanes(1.0));
  }
  s = s * r;
  // The quadrant: q mod 4 as -2, -1, 0, 1 or 2.
  const Lanes turns = (q * Lanes(0.25) + Lanes(kRound)) - Lanes(kRound);
  const Lanes quadrant = mul_sub_from(Lanes(4.0), turns, q), size = abs(quadrant);
  const Mask odd = (size > Lanes(0.5)) & (size < Lanes(1.5)), opposite = size > Lanes(1.5);
  const Mask negative = quadrant < Lanes(0.0);
  const Lanes turned_sine = select(negative, -c, c), turned_cosine = select(negative, s, -s);
  return {select(odd, turned_sine, select(opposite, -s, s)), select(odd, turned_cosine, select(opposite, -c, c))};
}

/// atan(t), t >= 0: t is turned back by the nearest multiple of pi/16, up to pi/4, and beyond that comes 1/t.
inline Lanes arc_tangent(Lanes t) {
  constexpr double kTangents[5] = {0, 0.19891236737965800691, 0.41421356237309504880, 0.66817863791929891999, 1};
  constexpr double kMiddles[4] = {0.09849140335716425, 0.30334668360734239, 0.53451113595079164,
                                  0.82067879082866033};
  constexpr double kStep = 0.19634954084936207740;
  const Mask steep = t > Lanes(1.0);
  const Lanes flat = select(steep, Lanes(1.0), t) / select(steep, t, Lanes(1.0));
  Lanes tangent = 0.0, angle = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Mask beyond = flat > Lanes(kMiddles[i]);
    tangent = select(beyond, Lanes(kTangents[i + 1]), tangent);
    angle = select(beyond, Lanes((i + 1) * kStep), angle);
  }
  const Lanes rest = (flat - tangent) / mul_add(flat, tangent, Lanes(1.0)), z = rest * rest;
  Lanes sum = 1.0 / 17;
  for (int n = 7; n >= 0; --n) sum = mul_sub_from(z, sum, Lanes(1.0 / (2 * n + 1)));
  const Lanes whole = mul_add(rest, sum, angle);
  return select(steep, Lanes(8 * kStep) - whole, whole);
}

/// The angle of x + j y in [0, pi], y >= 0; not both 0.
inline Lanes upper_angle(Lanes x, Lanes y) {
  const Lanes acute = arc_tangent(y / abs(x));
  return select(x < Lanes(0.0), Lanes(3.14159265358979323846) - acute, acute);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
