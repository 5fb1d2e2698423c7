/// Integrals of the error e: |e|, e^2, t |e|, t e^2.
///
/// Where e may change its sign the lane alone goes to a queue, as in shape_meter.inl; what the queue finds is summed
/// apart, lane by lane in order of time.
#pragma once

#include "engine/kernel/sums.inl"
#include "engine/kernel/waiting.inl"
#include "engine/kernel/zeros.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// What the error is made of on a panel, with at least the sum of |c_k|, k >= 1, and the sums over f's coefficients.
struct Error {
  const Series& f;
  Lanes rest;
  const ErrorSums& sums;
};

class ErrorMeter;

/// Panels of single lanes on which the error may change its sign.
class SignQueue {
 public:
  template <int degree>
  void push(ErrorMeter& meter, unsigned lanes, const Series& f, double middle, double half);
  void flush() {
    if (size_ > 0) search(size_);
  }

 private:
  template <int degree>
  struct Visitor;

  /// As in ExtremeQueue.
  void search(int slots) { is_smooth_ ? search_as<kSmoothDegree>(slots) : search_as<kDegree>(slots); }
  template <int degree>
  void search_as(int slots);

  WaitingSeries e_;
  WaitingRow middle_, half_;
  Lanes iae_, itae_;
  ErrorMeter* meter_[2 * kLanes];
  int lane_[2 * kLanes];
  int size_ = 0;
  bool is_smooth_ = false;  ///< all that waits has degree kSmoothDegree
};

/// e = offset + scale f
class ErrorMeter {
 public:
  void begin(Lanes offset, Lanes scale, SignQueue& queue) {
    queue_ = &queue;
    offset_ = offset, scale_ = scale, size_ = abs(scale), square_ = scale * scale;
    iae_ = ise_ = itae_ = itse_ = iae_of_queue_ = itae_of_queue_ = Lanes(0.0);
  }

  /// One panel of half length `half` around the time `middle`. Gives the lanes in which e may change its sign: these are
  /// still to be looked at.
  __attribute__((always_inline)) unsigned see(const Error& e, double middle, double half, Mask active) {
    const Lanes e0 = mul_add(scale_, e.f[0], offset_), e1 = scale_ * e.f[1];
    add_squares(e, e0, e1, middle, half, active);
    const Lanes first = abs(e0), rest = size_ * e.rest;
    const Mask sure = active & (first > rest);
    const Lanes length = 2 * half, moment = mul_add(Lanes(middle), e0, Lanes(half * (1.0 / 3)) * e1);
    iae_ = select(sure, mul_add(length, first, iae_), iae_);
    itae_ = select(sure, mul_add(length, abs(moment), itae_), itae_);
    return bits(but_not(active, sure));
  }

  template <int degree>
  void look_at(unsigned lanes, const Error& e, double middle, double half) {
    lanes &= bits(abs(mul_add(scale_, e.f[0], offset_)) + abs(scale_) * e.rest > Lanes(0.0));
    if (lanes != 0) queue_->push<degree>(*this, lanes, e.f, middle, half);
  }

  template <int degree>
  void watch(const Error& e, double middle, double half, Mask active) {
    const unsigned unsure = see(e, middle, half, active);
    if (unsure != 0) look_at<degree>(unsure, e, middle, half);
  }

  /// All that waits in the queue goes into the integrals. Call it before reading them.
  void evaluate() { queue_->flush(); }

  Lanes offset() const { return offset_; }
  Lanes scale() const { return scale_; }
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
    const Lanes squares = mul_add(square_, e.sums.squares, e0 * e0);
    const Lanes moments = mul_add(square_, e.sums.moments, Lanes(2.0 / 3) * e0 * e1);
    ise_ = select(active, mul_add(Lanes(2 * half), squares, ise_), ise_);
    const Lanes moment = mul_add(Lanes(middle), squares, Lanes(half) * moments);
    itse_ = select(active, mul_add(Lanes(2 * half), moment, itse_), itse_);
  }

  SignQueue* queue_ = nullptr;
  Lanes offset_, scale_, size_, square_;  ///< size_, square_: of scale_
  Lanes iae_, ise_, itae_, itse_;
  Lanes iae_of_queue_, itae_of_queue_;
};

template <int degree>
inline void SignQueue::push(ErrorMeter& meter, unsigned lanes, const Series& f, double middle, double half) {
  is_smooth_ = degree == kSmoothDegree && (is_smooth_ || size_ == 0);
  e_.push<degree>(f, meter.scale(), meter.offset(), lanes, size_);
  middle_.push_all(middle, size_);
  half_.push_all(half, size_);
  for (; lanes != 0; lanes &= lanes - 1, ++size_) {
    meter_[size_] = &meter;
    lane_[size_] = __builtin_ctz(lanes);
  }
  if (size_ >= kLanes) search(kLanes);
}

/// What zeros.inl finds of the errors. Parts are in time.
template <int degree>
struct SignQueue::Visitor {
  SignQueue& queue;
  static constexpr int kMomentDegree = degree < kDegree ? degree + 1 : kDegree;  ///< of x e

  void keeps_sign(const Series& e, const Part& part, Mask mask) {
    const Lanes length = Lanes(2.0) * part.half;
    add(length * abs(e[0]), length * abs(mul_add(part.center, e[0], part.half * Lanes(1.0 / 3) * e[1])), mask);
  }

  void may_cross(const Series& e, const Part& part, const Ends& ends, Mask mask) {
    const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
    keeps_sign(e, part, but_not(mask, crosses));
    if (any(crosses)) both_signs(e, zero_of<degree>(e, ends, crosses), part, crosses);
  }

  /// Both integrals from the left end to the zero at x, and the rest. int_{-1}^x P_k and int_{-1}^x s P_k(s) ds are sums of
  /// two and four polynomials.
  void both_signs(const Series& e, Lanes x, const Part& part, Mask mask) {
    Series by_x;
    set_times_x<degree>(by_x, e);
    Lanes P[kMomentDegree + 2];
    for_each_polynomial<kMomentDegree + 1>(x, [&](int k, Lanes here) { P[k] = here; });
    Lanes until = e[0] * (x + Lanes(1.0)), moment_until = by_x[0] * (x + Lanes(1.0));
    for (int k = 1; k <= kMomentDegree; ++k) {
      const Lanes integral = (P[k + 1] - P[k - 1]) * Lanes(1.0 / (2 * k + 1));
      if (k <= degree) until = mul_add(e[k], integral, until);
      moment_until = mul_add(by_x[k], integral, moment_until);
    }
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

template <int degree>
inline void SignQueue::search_as(int slots) {
  Series e;
  e_.get_first<degree>(e);
  iae_ = itae_ = Lanes(0.0);
  Visitor<degree> visitor{*this};
  search_zeros<degree>(e, {middle_.first(), half_.first()}, Mask::from((1u << slots) - 1), kHalvings, visitor);
  for (int slot = 0; slot < slots; ++slot)
    meter_[slot]->add(lane_[slot], lane_of(iae_, slot), lane_of(itae_, slot));
  size_ -= slots;
  if (size_ == 0) return;
  e_.forget_first<kDegree>();
  middle_.forget_first(), half_.forget_first();
  for (int i = 0; i < size_; ++i) meter_[i] = meter_[i + slots], lane_[i] = lane_[i + slots];
}

}  // namespace portrait::PORTRAIT_ISA_NAME
