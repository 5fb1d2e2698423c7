/// Numbers and series of single lanes that wait for a whole vector of their kind.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// One number a slot. Lanes come as they are gathered, so up to a vector of them may stand beyond the first vector.
class WaitingRow {
 public:
  void push(Lanes a, unsigned lanes, int size) { gather_lanes(a, lanes, of_ + size); }
  void push_all(Lanes a, int size) { a.to(of_ + size); }
  Lanes first() const { return Lanes::from(of_); }
  void forget_first() { Lanes::from(of_ + kLanes).to(of_); }

 private:
  alignas(64) double of_[2 * kLanes] = {};
};

class WaitingSeries {
 public:
  template <int degree>
  void push(const Series& f, unsigned lanes, int size) {
    for (int k = 0; k <= degree; ++k) rows_[k].push(f[k], lanes, size);
    set_zero_above(degree, size);
  }
  /// offset + scale f
  template <int degree>
  void push(const Series& f, Lanes scale, Lanes offset, unsigned lanes, int size) {
    rows_[0].push(mul_add(scale, f[0], offset), lanes, size);
    for (int k = 1; k <= degree; ++k) rows_[k].push(scale * f[k], lanes, size);
    set_zero_above(degree, size);
  }
  /// Of series that end at `degree` or before.
  template <int degree>
  void get_first(Series& f) const {
    for (int k = 0; k <= degree; ++k) f[k] = rows_[k].first();
  }
  template <int degree>
  void forget_first() {
    for (int k = 0; k <= degree; ++k) rows_[k].forget_first();
  }

 private:
  /// What waits alone, of the lower degree, is read up to that.
  void set_zero_above(int degree, int size) {
    for (int k = degree + 1; k < kTerms; ++k) rows_[k].push_all(0.0, size);
  }

  WaitingRow rows_[kTerms];
};

/// One lane of a vector, to read or to write.
inline double& lane_of(Lanes& a, int lane) { return reinterpret_cast<double*>(&a)[lane]; }
inline const double& lane_of(const Lanes& a, int lane) { return reinterpret_cast<const double*>(&a)[lane]; }

}  // namespace portrait::PORTRAIT_ISA_NAME
