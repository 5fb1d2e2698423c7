/// Integrals of the error e: |e|, e^2, t |e|, t e^2.
///
/// Where e may change its sign the lane alone is copied to a queue, as in shape_meter.inl; what the queue finds is summed
/// apart, lane by lane in order of time.
#pragma once

#include "engine/kernel/sums.inl"
#include "engine/kernel/zeros.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// An error on a panel: offset + scale f, with at least the sum of |c_k|, k >= 1, and the sums over f's coefficients.
struct Error {
  const Series& f;
  Lanes offset, scale, rest;
  const ErrorSums& sums;
};

class ErrorMeter;

/// Panels of single lanes on which the error may change its sign.
class SignQueue {
 public:
  SignQueue() {
    set_zero(e_);
    part_ = {Lanes(0.0), Lanes(1.0)};
    iae_ = itae_ = Lanes(0.0);
  }
  void push(ErrorMeter& meter, int lane, const Error& error, double middle, double half);
  void flush();

 private:
  struct Visitor;

  Series e_;
  Part part_;
  Lanes iae_, itae_;
  ErrorMeter* meter_[kLanes];
  int lane_[kLanes];
  int size_ = 0;
};

class ErrorMeter {
 public:
  void begin(SignQueue& queue) {
    queue_ = &queue;
    iae_ = ise_ = itae_ = itse_ = iae_of_queue_ = itae_of_queue_ = Lanes(0.0);
  }

  /// One panel of half length `half` around the time `middle`.
  void watch(const Error& e, double middle, double half, Mask active) {
    const Lanes e0 = mul_add(e.scale, e.f[0], e.offset), e1 = e.scale * e.f[1];
    add_squares(e, e0, e1, middle, half, active);
    const Lanes first = abs(e0), rest = abs(e.scale) * e.rest;
    const Mask sure = active & (first > rest);
    const Lanes length = 2 * half, moment = mul_add(Lanes(middle), e0, Lanes(half / 3) * e1);
    iae_ = select(sure, mul_add(length, first, iae_), iae_);
    itae_ = select(sure, mul_add(length, abs(moment), itae_), itae_);
    const Mask unsure = but_not(active & (first + rest > Lanes(0.0)), sure);
    for (unsigned left = bits(unsure); left != 0; left &= left - 1)
      queue_->push(*this, __builtin_ctz(left), e, middle, half);
  }

  /// All that waits in the queue goes into the integrals. Call it before reading them.
  void evaluate() { queue_->flush(); }

  Lanes iae() const { return iae_ + iae_of_queue_; }
  Lanes itae() const { return itae_ + itae_of_queue_; }
  Lanes ise() const { return ise_; }
  Lanes itse() const { return itse_; }

  void add(int lane, double iae, double itae) {
    lane_of(iae_of_queue_, lane) += iae;
    lane_of(itae_of_queue_, lane) += itae;
  }

 private:
  void add_squares(const Error& e, Lanes e0, Lanes e1, double middle, double half, Mask active) {
    const Lanes factor = e.scale * e.scale;
    const Lanes squares = mul_add(factor, e.sums.squares, e0 * e0);
    const Lanes moments = mul_add(factor, e.sums.moments, Lanes(2.0 / 3) * e0 * e1);
    ise_ = select(active, mul_add(Lanes(2 * half), squares, ise_), ise_);
    const Lanes moment = mul_add(Lanes(middle), squares, Lanes(half) * moments);
    itse_ = select(active, mul_add(Lanes(2 * half), moment, itse_), itse_);
  }

  SignQueue* queue_ = nullptr;
  Lanes iae_, ise_, itae_, itse_;
  Lanes iae_of_queue_, itae_of_queue_;
};

inline void SignQueue::push(ErrorMeter& meter, int lane, const Error& e, double middle, double half) {
  copy_lane(e_, size_, e.f, lane, lane_of(e.scale, lane));
  lane_of(e_[0], size_) += lane_of(e.offset, lane);
  lane_of(part_.center, size_) = middle;
  lane_of(part_.half, size_) = half;
  meter_[size_] = &meter;
  lane_[size_] = lane;
  if (++size_ == kLanes) flush();
}

/// What zeros.inl finds of the errors. Parts are in time.
struct SignQueue::Visitor {
  SignQueue& queue;

  void keeps_sign(const Series& e, const Part& part, Mask mask) {
    const Lanes length = Lanes(2.0) * part.half;
    add(length * abs(e[0]), length * abs(mul_add(part.center, e[0], part.half * Lanes(1.0 / 3) * e[1])), mask);
  }

  void may_cross(const Series& e, const Part& part, const Ends& ends, Mask mask) {
    const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
    keeps_sign(e, part, but_not(mask, crosses));
    if (any(crosses)) both_signs(e, zero_of(e, ends, crosses), part, crosses);
  }

  /// Both integrals from the left end to the zero, and the rest. int_{-1}^x P_k and int_{-1}^x s P_k(s) ds are sums of two
  /// and four polynomials; Newton's last step adds half of itself times e(x).
  void both_signs(const Series& e, const Zero& zero, const Part& part, Mask mask) {
    Series by_x;
    set_times_x(by_x, e);
    Lanes P[kTerms + 1];
    for_each_polynomial<kTerms>(zero.x, [&](int k, Lanes here) { P[k] = here; });
    Lanes until = e[0] * (zero.x + Lanes(1.0)), moment_until = by_x[0] * (zero.x + Lanes(1.0));
    for (int k = 1; k < kTerms; ++k) {
      const Lanes integral = (P[k + 1] - P[k - 1]) * Lanes(1.0 / (2 * k + 1));
      until = mul_add(e[k], integral, until);
      moment_until = mul_add(by_x[k], integral, moment_until);
    }
    const Lanes left_over = Lanes(0.5) * zero.step * zero.here;
    until += left_over;
    moment_until = mul_add(zero.x, left_over, moment_until);
    const Lanes rest = Lanes(2.0) * e[0] - until, moment_rest = Lanes(2.0) * by_x[0] - moment_until;
    const Lanes before = mul_add(part.center, until, part.half * moment_until);
    const Lanes after = mul_add(part.center, rest, part.half * moment_rest);
    add(part.half * (abs(until) + abs(rest)), part.half * (abs(before) + abs(after)), mask);
  }

  void add(Lanes iae, Lanes itae, Mask mask) {
    queue.iae_ = select(mask, queue.iae_ + iae, queue.iae_);
    queue.itae_ = select(mask, queue.itae_ + itae, queue.itae_);
  }
};

inline void SignQueue::flush() {
  if (size_ == 0) return;
  iae_ = itae_ = Lanes(0.0);
  Visitor visitor{*this};
  search_zeros(e_, part_, Mask::from((1u << size_) - 1), kHalvings, visitor);
  for (int slot = 0; slot < size_; ++slot)
    meter_[slot]->add(lane_[slot], lane_of(iae_, slot), lane_of(itae_, slot));
  size_ = 0;
}

}  // namespace portrait::PORTRAIT_ISA_NAME
