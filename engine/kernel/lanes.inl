/// Many doubles side by side: the only file that knows vector instructions.
///
/// Compiled once per instruction set, in a namespace of its own (PORTRAIT_ISA_NAME), from files that include no library
/// template, so that no code of one set can be linked into another. A `Lanes` is one register: two hide more latency, but
/// the series of a panel then leave the first cache. Lane i never sees lane j, so a setting's result does not depend on its
/// neighbours.
///
///     a + b, a - b, a * b, a / b, -a        mul_add(a, b, c) = a b + c, fused where the set has it
///     abs, min, max, sqrt                   a < b gives a Mask; select(mask, a, b) takes a where the mask holds
///     negative_bits(a)                      a bit for every lane whose sign is set
///     gather_lanes(a, lanes, to)            the lanes of a bit mask one after the other; writes kLanes numbers, the rest
///                                           of them is of no meaning
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
inline unsigned sign_bits(Register a) { return _mm512_movepi64_mask(_mm512_castpd_si512(a)); }
inline Register pack_left(Register a, unsigned lanes) {
  return _mm512_maskz_compress_pd(static_cast<__mmask8>(lanes), a);
}
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
inline unsigned sign_bits(Register a) { return static_cast<unsigned>(_mm256_movemask_pd(a)); }
/// Halves of the doubles to take, eight a bit mask.
struct HalvesTable {
  alignas(32) int of[16][8];
};
constexpr HalvesTable make_halves_table() {
  HalvesTable t{};
  for (int lanes = 0; lanes < 16; ++lanes) {
    int next = 0;
    for (int lane = 0; lane < 4; ++lane) {
      if ((lanes >> lane & 1) == 0) continue;
      t.of[lanes][next++] = 2 * lane;
      t.of[lanes][next++] = 2 * lane + 1;
    }
  }
  return t;
}
inline constexpr HalvesTable kHalves = make_halves_table();
inline Register pack_left(Register a, unsigned lanes) {
  const __m256i halves = _mm256_load_si256(reinterpret_cast<const __m256i*>(kHalves.of[lanes]));
  return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), halves));
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
inline unsigned sign_bits(Register a) { return static_cast<unsigned>(_mm_movemask_pd(a)); }
inline Register pack_left(Register a, unsigned lanes) { return lanes == 2 ? _mm_unpackhi_pd(a, a) : a; }
#endif

inline constexpr int kLanes = kRegisterLanes;

struct Lanes {
  Register r;

  Lanes() = default;
  Lanes(double x) : r(set_all(x)) {}  // NOLINT: a number is the same number in every lane
  static Lanes of(Register r) {
    Lanes a;
    a.r = r;
    return a;
  }
  static Lanes from(const double* p) { return of(load(p)); }
  void to(double* p) const { store(p, r); }
};

struct Mask {
  RegisterMask m;
  static Mask from(unsigned b) { return {from_bits(b)}; }
};

inline Lanes operator+(Lanes a, Lanes b) { return Lanes::of(a.r + b.r); }
inline Lanes operator-(Lanes a, Lanes b) { return Lanes::of(a.r - b.r); }
inline Lanes operator*(Lanes a, Lanes b) { return Lanes::of(a.r * b.r); }
inline Lanes operator/(Lanes a, Lanes b) { return Lanes::of(a.r / b.r); }
inline Lanes operator-(Lanes a) { return Lanes::of(-a.r); }
inline Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
/// a b + c
inline Lanes mul_add(Lanes a, Lanes b, Lanes c) { return Lanes::of(fused(a.r, b.r, c.r)); }
/// c - a b
inline Lanes mul_sub_from(Lanes a, Lanes b, Lanes c) { return Lanes::of(negative_fused(a.r, b.r, c.r)); }
inline Lanes abs(Lanes a) { return Lanes::of(magnitude(a.r)); }
inline Lanes min(Lanes a, Lanes b) { return Lanes::of(smaller(a.r, b.r)); }
inline Lanes max(Lanes a, Lanes b) { return Lanes::of(larger(a.r, b.r)); }
inline Lanes sqrt(Lanes a) { return Lanes::of(root(a.r)); }
inline Mask operator<(Lanes a, Lanes b) { return {less(a.r, b.r)}; }
inline Mask operator>(Lanes a, Lanes b) { return b < a; }
inline Lanes select(Mask m, Lanes a, Lanes b) { return Lanes::of(choose(m.m, a.r, b.r)); }
inline Mask operator&(Mask a, Mask b) { return {both(a.m, b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {either(a.m, b.m)}; }
/// a and not b
inline Mask but_not(Mask a, Mask b) { return {except(a.m, b.m)}; }
inline Mask select(Mask m, Mask a, Mask b) { return (m & a) | but_not(b, m); }
inline unsigned bits(Mask m) { return bits(m.m); }
inline bool any(Mask m) { return bits(m) != 0; }
inline constexpr unsigned kAllLanes = (1u << kLanes) - 1;
inline Mask all_lanes() { return Mask::from(kAllLanes); }
inline Mask operator!(Mask m) { return but_not(all_lanes(), m); }
inline unsigned negative_bits(Lanes a) { return sign_bits(a.r); }
inline void gather_lanes(Lanes a, unsigned lanes, double* to) { store(to, pack_left(a.r, lanes)); }

}  // namespace portrait::PORTRAIT_ISA_NAME
