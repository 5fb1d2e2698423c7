/// Signals at the instants k Ts, k = 0, 1, ..., as limits from the right, written lane beside lane.
///
/// An instant belongs to the panel that begins at it or holds it. What is not written, since its lane has come to rest, is rest.
#pragma once

#include "engine/kernel/pack.h"
#include "engine/kernel/shape_meter.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// f at x.
template <int degree>
inline Lanes value_at(const Series& f, double x) {
  double before = 1, here = x;
  Lanes sum = mul_add(f[1], Lanes(x), f[0]);
  for (int k = 1; k < degree; ++k) {
    const double next = ((2 * k + 1) * x * here - k * before) / (k + 1);
    before = here, here = next;
    sum = mul_add(f[k + 1], Lanes(here), sum);
  }
  return sum;
}

/// One signal: x = scale * f.
class Sampler {
 public:
  Sampler(const kernel::PackSamples& samples, double* to, Lanes scale, Lanes rest)
      : sampling_(samples.sampling), count_(samples.count), to_(to), scale_(scale), rest_(rest) {}

  /// Rest everywhere, and 0 before `from`.
  void begin(double from) {
    const int first = first_from(from);
    for (int i = 0; i < count_; ++i) (i < first ? Lanes(0.0) : rest_).to(place(i));
  }

  /// The instants of a panel of the given start and half length.
  template <int degree>
  void take(const Signal& s, double start, double half, Mask active) {
    const int end = first_from(start + 2 * half);
    for (int i = first_from(start); i < end; ++i) {
      const double x = (i * sampling_ - start) / half - 1, inside = x < -1 ? -1 : x > 1 ? 1 : x;
      const Lanes f = value_at<degree>(s.f, inside) + (s.mean - s.f[0]);
      select(active, scale_ * f, rest_).to(place(i));
    }
  }

 private:
  double* place(int i) const { return to_ + static_cast<long>(i) * kernel::kMaxLanes; }

  /// The first instant not before t; one that rounding puts just before an edge belongs to it.
  int first_from(double t) const {
    const double at = t / sampling_ - 1e-9;
    if (!(at > 0)) return 0;
    if (at >= count_) return count_;
    const int whole = static_cast<int>(at);
    return whole < at ? whole + 1 : whole;
  }

  double sampling_;
  int count_;
  double* to_;
  Lanes scale_, rest_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
