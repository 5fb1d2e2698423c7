/// As many multiplications and additions as the core can do: independent chains a = a x + y, held in registers.
///
/// Twelve chains cover four cycles of latency on two units, and with x and y still fit sixteen registers. Without
/// fused instructions (base) each is a multiplication and an addition.
#pragma once

#include "bench/isa/number.inl"

namespace portrait::bench::PORTRAIT_ISA_NAME {

inline double multiply_and_add(long rounds) {
  constexpr int kChains = 12;
  Register x = Lanes(0.999).r, y = Lanes(0.001).r, a[kChains];
  for (int i = 0; i < kChains; ++i) a[i] = Lanes(2.0 + i).r;
  for (long round = 0; round < rounds; ++round)
    for (int i = 0; i < kChains; ++i) a[i] = a[i] * x + y;
  for (int i = 1; i < kChains; ++i) a[0] += a[i];
  const Register sum = a[0];
  asm volatile("" : : "m"(sum));  // the result counts: the compiler must not leave the chains out
  return 2.0 * kChains * kWidth * static_cast<double>(rounds);
}

}  // namespace portrait::bench::PORTRAIT_ISA_NAME
