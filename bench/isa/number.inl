/// One double, or as many as a register holds, under the same operators: the step loop is written once for both.
///
/// One register of each signal, with both responses in flight, was the fastest on every instruction set: with two
/// and four the states no longer fit the register file.
#pragma once

namespace portrait::bench::PORTRAIT_ISA_NAME {

#if defined(__AVX512F__)
inline constexpr int kWidth = 8;
#elif defined(__AVX2__)
inline constexpr int kWidth = 4;
#else
inline constexpr int kWidth = 2;
#endif

typedef double Register __attribute__((vector_size(8 * kWidth)));
typedef long long RegisterBits __attribute__((vector_size(8 * kWidth)));

struct Lanes {
  static constexpr int kCount = kWidth;
  Register r;

  Lanes() = default;
  Lanes(double x) : r(x - Register{}) {}  // NOLINT: a number is the same number in every lane
  explicit Lanes(Register a) : r(a) {}
};

inline Lanes operator+(Lanes a, Lanes b) { return Lanes(a.r + b.r); }
inline Lanes operator-(Lanes a, Lanes b) { return Lanes(a.r - b.r); }
inline Lanes operator*(Lanes a, Lanes b) { return Lanes(a.r * b.r); }
inline Lanes operator/(Lanes a, Lanes b) { return Lanes(a.r / b.r); }
inline Lanes magnitude(Lanes a) {
  const RegisterBits all_but_sign = RegisterBits{} + 0x7fffffffffffffffLL;
  return Lanes(reinterpret_cast<Register>(reinterpret_cast<RegisterBits>(a.r) & all_but_sign));
}

struct One {
  static constexpr int kCount = 1;
  double r;

  One() = default;
  One(double x) : r(x) {}  // NOLINT: the same constants as for Lanes
};

inline One operator+(One a, One b) { return a.r + b.r; }
inline One operator-(One a, One b) { return a.r - b.r; }
inline One operator*(One a, One b) { return a.r * b.r; }
inline One operator/(One a, One b) { return a.r / b.r; }
inline One magnitude(One a) { return __builtin_fabs(a.r); }

template <typename Number>
inline Number gathered(const double* values) {
  Number a;
  __builtin_memcpy(&a.r, values, sizeof a.r);
  return a;
}

template <typename Number>
inline void scattered(Number a, double* values) {
  __builtin_memcpy(values, &a.r, sizeof a.r);
}

}  // namespace portrait::bench::PORTRAIT_ISA_NAME
