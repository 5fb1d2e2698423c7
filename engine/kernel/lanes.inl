/// Many doubles side by side: the only file that knows vector instructions.
///
/// Compiled once per instruction set, in a namespace of its own (PORTRAIT_ISA_NAME), from files that include no library
/// template, so that no code of one set can be linked into another. A `Lanes` is two registers, which hides the latency
/// of the serial recurrences; lane i never sees lane j, so a setting's result does not depend on its neighbours.
///
///     a + b, a - b, a * b, a / b, -a        mul_add(a, b, c) = a b + c, fused where the set has it
///     abs, min, max, sqrt                   a < b gives a Mask; select(mask, a, b) takes a where the mask holds
#pragma once

#include <immintrin.h>

namespace portrait::PORTRAIT_ISA_NAME {

#if defined(__AVX512F__)
using Register = __m512d;
using RegisterMask = __mmask8;
inline constexpr int kRegisterLanes = 8;
inline Register set_all(double x) { return _mm512_set1_pd(x); }
inline Register load(const double* p) { return _mm512_loadu_pd(p); }
inline void store(double* p, Register a) { _mm512_storeu_pd(p, a); }
inline Register fused(Register a, Register b, Register c) { return _mm512_fmadd_pd(a, b, c); }
inline Register negative_fused(Register a, Register b, Register c) { return _mm512_fnmadd_pd(a, b, c); }
inline Register magnitude(Register a) { return _mm512_abs_pd(a); }
inline Register smaller(Register a, Register b) { return _mm512_min_pd(a, b); }
inline Register larger(Register a, Register b) { return _mm512_max_pd(a, b); }
inline Register root(Register a) { return _mm512_sqrt_pd(a); }
inline RegisterMask less(Register a, Register b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
inline Register choose(RegisterMask m, Register a, Register b) { return _mm512_mask_blend_pd(m, b, a); }
inline RegisterMask both(RegisterMask a, RegisterMask b) { return static_cast<RegisterMask>(a & b); }
inline RegisterMask either(RegisterMask a, RegisterMask b) { return static_cast<RegisterMask>(a | b); }
inline RegisterMask except(RegisterMask a, RegisterMask b) { return static_cast<RegisterMask>(a & ~b); }
inline unsigned bits(RegisterMask m) { return m; }
inline RegisterMask from_bits(unsigned b) { return static_cast<RegisterMask>(b); }
#elif defined(__AVX2__)
using Register = __m256d;
using RegisterMask = __m256d;
inline constexpr int kRegisterLanes = 4;
inline Register set_all(double x) { return _mm256_set1_pd(x); }
inline Register load(const double* p) { return _mm256_loadu_pd(p); }
inline void store(double* p, Register a) { _mm256_storeu_pd(p, a); }
inline Register fused(Register a, Register b, Register c) { return _mm256_fmadd_pd(a, b, c); }
inline Register negative_fused(Register a, Register b, Register c) { return _mm256_fnmadd_pd(a, b, c); }
inline Register magnitude(Register a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
inline Register smaller(Register a, Register b) { return _mm256_min_pd(a, b); }
inline Register larger(Register a, Register b) { return _mm256_max_pd(a, b); }
inline Register root(Register a) { return _mm256_sqrt_pd(a); }
inline RegisterMask less(Register a, Register b) { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
inline Register choose(RegisterMask m, Register a, Register b) { return _mm256_blendv_pd(b, a, m); }
inline RegisterMask both(RegisterMask a, RegisterMask b) { return _mm256_and_pd(a, b); }
inline RegisterMask either(RegisterMask a, RegisterMask b) { return _mm256_or_pd(a, b); }
inline RegisterMask except(RegisterMask a, RegisterMask b) { return _mm256_andnot_pd(b, a); }
inline unsigned bits(RegisterMask m) { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
inline RegisterMask from_bits(unsigned b) {
  const __m256i lane = _mm256_set_epi64x(8, 4, 2, 1);
  const __m256i chosen = _mm256_and_si256(_mm256_set1_epi64x(static_cast<long long>(b)), lane);
  return _mm256_castsi256_pd(_mm256_cmpeq_epi64(chosen, lane));
}
#else
using Register = __m128d;
using RegisterMask = __m128d;
inline constexpr int kRegisterLanes = 2;
inline Register set_all(double x) { return _mm_set1_pd(x); }
inline Register load(const double* p) { return _mm_loadu_pd(p); }
inline void store(double* p, Register a) { _mm_storeu_pd(p, a); }
inline Register fused(Register a, Register b, Register c) { return _mm_add_pd(_mm_mul_pd(a, b), c); }
inline Register negative_fused(Register a, Register b, Register c) { return _mm_sub_pd(c, _mm_mul_pd(a, b)); }
inline Register magnitude(Register a) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a); }
inline Register smaller(Register a, Register b) { return _mm_min_pd(a, b); }
inline Register larger(Register a, Register b) { return _mm_max_pd(a, b); }
inline Register root(Register a) { return _mm_sqrt_pd(a); }
inline RegisterMask less(Register a, Register b) { return _mm_cmplt_pd(a, b); }
inline Register choose(RegisterMask m, Register a, Register b) {
  return _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b));
}
inline RegisterMask both(RegisterMask a, RegisterMask b) { return _mm_and_pd(a, b); }
inline RegisterMask either(RegisterMask a, RegisterMask b) { return _mm_or_pd(a, b); }
inline RegisterMask except(RegisterMask a, RegisterMask b) { return _mm_andnot_pd(b, a); }
inline unsigned bits(RegisterMask m) { return static_cast<unsigned>(_mm_movemask_pd(m)); }
inline RegisterMask from_bits(unsigned b) {
  return _mm_castsi128_pd(_mm_set_epi64x((b & 2) ? -1 : 0, (b & 1) ? -1 : 0));
}
#endif

inline constexpr int kRegisters = 2;
inline constexpr int kLanes = kRegisters * kRegisterLanes;

struct Lanes {
  Register r[kRegisters];

  Lanes() = default;
  Lanes(double x) : r{set_all(x), set_all(x)} {}  // NOLINT: a number is the same number in every lane
  Lanes(Register a, Register b) : r{a, b} {}
  static Lanes from(const double* p) { return {load(p), load(p + kRegisterLanes)}; }
  void to(double* p) const {
    store(p, r[0]);
    store(p + kRegisterLanes, r[1]);
  }
};

struct Mask {
  RegisterMask m[kRegisters];
  static Mask from(unsigned b) {
    return {{from_bits(b & ((1u << kRegisterLanes) - 1)), from_bits(b >> kRegisterLanes)}};
  }
};

inline Lanes operator+(Lanes a, Lanes b) { return {a.r[0] + b.r[0], a.r[1] + b.r[1]}; }
inline Lanes operator-(Lanes a, Lanes b) { return {a.r[0] - b.r[0], a.r[1] - b.r[1]}; }
inline Lanes operator*(Lanes a, Lanes b) { return {a.r[0] * b.r[0], a.r[1] * b.r[1]}; }
inline Lanes operator/(Lanes a, Lanes b) { return {a.r[0] / b.r[0], a.r[1] / b.r[1]}; }
inline Lanes operator-(Lanes a) { return {-a.r[0], -a.r[1]}; }
inline Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
/// a b + c
inline Lanes mul_add(Lanes a, Lanes b, Lanes c) {
  return {fused(a.r[0], b.r[0], c.r[0]), fused(a.r[1], b.r[1], c.r[1])};
}
/// c - a b
inline Lanes mul_sub_from(Lanes a, Lanes b, Lanes c) {
  return {negative_fused(a.r[0], b.r[0], c.r[0]), negative_fused(a.r[1], b.r[1], c.r[1])};
}
inline Lanes abs(Lanes a) { return {magnitude(a.r[0]), magnitude(a.r[1])}; }
inline Lanes min(Lanes a, Lanes b) { return {smaller(a.r[0], b.r[0]), smaller(a.r[1], b.r[1])}; }
inline Lanes max(Lanes a, Lanes b) { return {larger(a.r[0], b.r[0]), larger(a.r[1], b.r[1])}; }
inline Lanes sqrt(Lanes a) { return {root(a.r[0]), root(a.r[1])}; }
inline Mask operator<(Lanes a, Lanes b) { return {{less(a.r[0], b.r[0]), less(a.r[1], b.r[1])}}; }
inline Mask operator>(Lanes a, Lanes b) { return b < a; }
inline Lanes select(Mask m, Lanes a, Lanes b) {
  return {choose(m.m[0], a.r[0], b.r[0]), choose(m.m[1], a.r[1], b.r[1])};
}
inline Mask operator&(Mask a, Mask b) { return {{both(a.m[0], b.m[0]), both(a.m[1], b.m[1])}}; }
inline Mask operator|(Mask a, Mask b) { return {{either(a.m[0], b.m[0]), either(a.m[1], b.m[1])}}; }
/// a and not b
inline Mask but_not(Mask a, Mask b) { return {{except(a.m[0], b.m[0]), except(a.m[1], b.m[1])}}; }
inline unsigned bits(Mask m) { return bits(m.m[0]) | bits(m.m[1]) << kRegisterLanes; }
inline bool any(Mask m) { return bits(m) != 0; }
inline Mask operator!(Mask m) { return but_not(Mask::from((1u << kLanes) - 1), m); }

}  // namespace portrait::PORTRAIT_ISA_NAME
