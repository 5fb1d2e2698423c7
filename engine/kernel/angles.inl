/// Sine, cosine and angles in lanes.
///
/// Taylor's series after a reduction of the argument that makes them short: no coefficient but 1/n! and 1/(2n + 1).
/// domain    |x| below kLargestAngle for sine and cosine
/// accuracy  some 1e-16, of 1 for sine and cosine, of the value for angles
#pragma once

#include "engine/kernel/lanes.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kLargestAngle = 1e5;

/// (-1)^n/(2n + 1)! and (-1)^n/(2n)!: to |x| = pi/2 the next term is 1e-17.
inline constexpr int kSineTerms = 11;
struct SineSeries {
  double sine[kSineTerms] = {1}, cosine[kSineTerms] = {1};

  constexpr SineSeries() {
    for (int n = 1; n < kSineTerms; ++n) {
      sine[n] = -sine[n - 1] / (2 * n * (2 * n + 1));
      cosine[n] = -cosine[n - 1] / ((2 * n - 1) * (2 * n));
    }
  }
};
inline constexpr SineSeries kSineSeries;

struct SineCosine {
  Lanes sine, cosine;
};

/// x = q pi + r, |r| <= pi/2, with pi in three parts so that q pi is exact for the q in use.
inline SineCosine sine_cosine(Lanes x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves the nearest whole number
  constexpr double kPiParts[3] = {3.1415926534682512, 1.2154201012607932e-10, 4.0445324975919012e-21};
  const Lanes q = mul_add(x, Lanes(1 / kPi), Lanes(kRound)) - Lanes(kRound);
  Lanes r = x;
  for (const double part : kPiParts) r = mul_sub_from(q, Lanes(part), r);
  const Lanes z = r * r;
  Lanes s = kSineSeries.sine[kSineTerms - 1], c = kSineSeries.cosine[kSineTerms - 1];
  for (int n = kSineTerms - 2; n >= 0; --n) {
    s = mul_add(z, s, Lanes(kSineSeries.sine[n]));
    c = mul_add(z, c, Lanes(kSineSeries.cosine[n]));
  }
  // q even or odd leaves 0 or +-1/2 of q/2.
  const Lanes half = Lanes(0.5) * q, rest = half - ((half + Lanes(kRound)) - Lanes(kRound));
  const Lanes turn = mul_sub_from(Lanes(8.0) * rest, rest, Lanes(1.0));
  return {turn * r * s, turn * c};
}

/// The angle of x + j y, x, y >= 0, not both 0: turned back by the nearest multiple of pi/16, up to pi/4; beyond that x and
/// y change places.
inline Lanes acute_angle(Lanes x, Lanes y) {
  constexpr double kTangents[5] = {0, 0.19891236737965800691, 0.41421356237309504880, 0.66817863791929891999, 1};
  constexpr double kMiddles[4] = {0.09849140335716425, 0.30334668360734239, 0.53451113595079164,
                                  0.82067879082866033};
  constexpr double kStep = 0.19634954084936207740;
  const Mask steep = y > x;
  const Lanes top = min(x, y), bottom = max(x, y);
  Lanes tangent = 0.0, angle = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Mask beyond = top > Lanes(kMiddles[i]) * bottom;
    tangent = select(beyond, Lanes(kTangents[i + 1]), tangent);
    angle = select(beyond, Lanes((i + 1) * kStep), angle);
  }
  const Lanes rest = mul_sub_from(tangent, bottom, top) / mul_add(tangent, top, bottom), z = rest * rest;
  Lanes sum = 1.0 / 17;
  for (int n = 7; n >= 0; --n) sum = mul_sub_from(z, sum, Lanes(1.0 / (2 * n + 1)));
  const Lanes whole = mul_add(rest, sum, angle);
  return select(steep, Lanes(8 * kStep) - whole, whole);
}

/// atan(t), t >= 0
inline Lanes arc_tangent(Lanes t) { return acute_angle(Lanes(1.0), t); }

/// The angle of x + j y in [-pi, pi]; not both 0.
inline Lanes angle(Lanes x, Lanes y) {
  const Lanes acute = acute_angle(abs(x), abs(y));
  const Lanes upper = select(x < Lanes(0.0), Lanes(kPi) - acute, acute);
  return select(y < Lanes(0.0), -upper, upper);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
