/// The plants without their dead time, on a panel: z from u + d.
///
///     dipdt  z'' = u + d        ipdt  z' = u + d        fotd  tau_1 z' + z = u + d
#pragma once

#include "engine/kernel/legendre.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

/// The measured output on a panel, z of one dead time before, with the derivatives that are known: two of fotd and ipdt,
/// three of dipdt. The plant's input and its slope are among them or lie where nothing else does.
struct Output {
  Series y, y1, y2, y3;

  void begin() {
    set_zero(y), set_zero(y1), set_zero(y2), set_zero(y3);
  }
};

template <kernel::PlantKind kind>
class PlantStep {
 public:
  void begin(Lanes tau_1) {
    tau_1_ = tau_1;
    if constexpr (kind == kernel::PlantKind::fotd) rate_ = Lanes(1.0) / tau_1;
    z_ = z1_ = Lanes(0.0);
  }

  /// Where u and u' are to be written before `step`: that saves copying them.
  static Series& input(Output& z) { return kind == kernel::PlantKind::ipdt ? z.y1 : z.y2; }
  static Series& input_slope(Output& z) { return kind == kernel::PlantKind::ipdt ? z.y2 : z.y3; }

  /// From input and input slope, d = `load` added, to z and its derivatives.
  void step(Output& z, const Lag& lag, const IntegralWeights& weights, double half_length, double load) {
    const Lanes length = 2 * half_length;
    Series& u = input(z);
    u[0] += Lanes(load);
    const Lanes mean = u[0];
    if constexpr (kind == kernel::PlantKind::dipdt) {
      set_integral(z.y1, u, weights, z1_);
      set_integral(z.y, z.y1, weights, z_);
      z_ = mul_add(length, z.y1[0], z_);
      z1_ = mul_add(length, mean, z1_);
    } else if constexpr (kind == kernel::PlantKind::ipdt) {
      set_integral(z.y, u, weights, z_);
      z_ = mul_add(length, mean, z_);
    } else {
      lag.set_slope(z.y1, u, z_);
      for (int k = 0; k < kTerms; ++k) {
        z.y[k] = mul_sub_from(tau_1_, z.y1[k], u[k]);
        z.y2[k] = rate_ * (z.y3[k] - z.y1[k]);
      }
      z_ = mul_add(length, z.y1[0], z_);
    }
  }

 private:
  Lanes tau_1_, rate_;
  Lanes z_, z1_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
