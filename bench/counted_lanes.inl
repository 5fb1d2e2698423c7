/// The names of engine/kernel/lanes.inl over plain numbers that count what is done to them: the kernel, compiled
/// over these, says how many floating-point operations a setting takes. As many lanes as the widest instruction set
/// has, since what happens in any lane of a pack is done to all of them.
///
/// counts    a + b, a - b, a b, a/b, sqrt, min, max and a < b as one operation, mul_add as two; changes of sign,
///           |a|, select, masks and the moving of lanes as none
#pragma once

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr int kLanes = 8;

/// Operations of each lane since the program began. One thread only.
inline long operations = 0;

struct Lanes {
  double v[kLanes];

  Lanes() = default;
  Lanes(double x) {  // NOLINT: a number is the same number in every lane
    for (double& lane : v) lane = x;
  }
  static Lanes from(const double* p) {
    Lanes a;
    for (int i = 0; i < kLanes; ++i) a.v[i] = p[i];
    return a;
  }
  void to(double* p) const {
    for (int i = 0; i < kLanes; ++i) p[i] = v[i];
  }
};

struct Mask {
  unsigned m;
  static Mask from(unsigned b) { return {b}; }
};

template <typename Operation>
inline Lanes each(int count, Operation operation) {
  operations += count;
  Lanes c;
  for (int i = 0; i < kLanes; ++i) c.v[i] = operation(i);
  return c;
}

inline Lanes operator+(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] * b.v[i]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] / b.v[i]; });
}
inline Lanes operator-(Lanes a) {
  return each(0, [&](int i) { return -a.v[i]; });
}
inline Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
inline Lanes mul_add(Lanes a, Lanes b, Lanes c) {
  return each(2, [&](int i) { return __builtin_fma(a.v[i], b.v[i], c.v[i]); });
}
inline Lanes mul_sub_from(Lanes a, Lanes b, Lanes c) {
  return each(2, [&](int i) { return __builtin_fma(-a.v[i], b.v[i], c.v[i]); });
}
inline Lanes abs(Lanes a) {
  return each(0, [&](int i) { return __builtin_fabs(a.v[i]); });
}
inline Lanes min(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Lanes max(Lanes a, Lanes b) {
  return each(1, [&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline Lanes sqrt(Lanes a) {
  return each(1, [&](int i) { return __builtin_sqrt(a.v[i]); });
}
inline Mask operator<(Lanes a, Lanes b) {
  operations += 1;
  unsigned m = 0;
  for (int i = 0; i < kLanes; ++i) m |= (a.v[i] < b.v[i] ? 1u : 0u) << i;
  return {m};
}
inline Mask operator>(Lanes a, Lanes b) { return b < a; }
inline Lanes select(Mask m, Lanes a, Lanes b) {
  return each(0, [&](int i) { return (m.m >> i & 1u) != 0 ? a.v[i] : b.v[i]; });
}
inline Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
inline Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
inline Mask but_not(Mask a, Mask b) { return {a.m & ~b.m}; }
inline Mask select(Mask m, Mask a, Mask b) { return (m & a) | but_not(b, m); }
inline unsigned bits(Mask m) { return m.m; }
inline bool any(Mask m) { return m.m != 0; }

inline constexpr unsigned kAllLanes = (1u << kLanes) - 1;
inline Mask all_lanes() { return Mask::from(kAllLanes); }
inline Mask operator!(Mask m) { return but_not(all_lanes(), m); }
inline unsigned negative_bits(Lanes a) {
  unsigned m = 0;
  for (int i = 0; i < kLanes; ++i) m |= (__builtin_signbit(a.v[i]) != 0 ? 1u : 0u) << i;
  return m;
}
inline void gather_lanes(Lanes a, unsigned lanes, double* to) {
  for (int i = 0; i < kLanes; ++i)
    if ((lanes >> i & 1u) != 0) *to++ = a.v[i];
}

}  // namespace portrait::PORTRAIT_ISA_NAME
