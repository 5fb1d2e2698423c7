/// Panels of single lanes on which a slope may vanish: searched, a whole vector of them at a time, for the extremes of the
/// signal.
#pragma once

#include "engine/kernel/waiting.inl"
#include "engine/kernel/zeros.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// A signal on a panel: f, with f' per dead time and at least its sum of |c_k|, k >= 1. In place of f's first coefficient
/// its mean counts.
struct Signal {
  const Series& f;
  const Series& slope;
  Lanes mean, slope_rest;

  Lanes start() const { return mean + (value_at_start(f) - f[0]); }
  Lanes end() const { return mean + (value_at_end(f) - f[0]); }
};

class ShapeMeter;

class ExtremeQueue {
 public:
  /// `start`: f' at the panel's start, or where it is 0 there, at its end. `late`: on the last dead time.
  template <int degree>
  void push(ShapeMeter& meter, unsigned lanes, bool late, const Signal& signal, double half, Lanes start) {
    is_smooth_ = degree == kSmoothDegree && (is_smooth_ || size_ == 0);
    slope_.push<degree>(signal.slope, lanes, size_);
    mean_.push(signal.mean, lanes, size_);
    start_.push(start, lanes, size_);
    half_.push_all(half, size_);
    for (unsigned left = lanes; left != 0; left &= left - 1, ++size_) {
      meter_[size_] = &meter;
      late_[size_] = late;
      lane_[size_] = __builtin_ctz(left);
    }
    if (size_ >= kLanes) search(kLanes);
  }

  void flush() {
    if (size_ > 0) search(size_);
  }

 private:
  static constexpr int kMostFound = 2 << kHalvings;
  template <int degree>
  struct Visitor;

  /// The first `slots` lanes that wait. A lane of the lower degree gets the same bits either way: it only adds zeros.
  void search(int slots) { is_smooth_ ? search_as<kSmoothDegree>(slots) : search_as<kDegree>(slots); }
  template <int degree>
  void search_as(int slots);
  /// Slots were filled in order of time: in that order they report, also two of one lane.
  void report(int slots);

  WaitingSeries slope_;
  WaitingRow mean_, start_, half_;
  ShapeMeter* meter_[2 * kLanes];
  int lane_[2 * kLanes];
  bool late_[2 * kLanes];
  int size_ = 0;
  bool is_smooth_ = false;            ///< all that waits has degree kSmoothDegree
  unsigned falling_ = 0;              ///< of the slots in search, the direction so far
  double found_[kMostFound][kLanes];  ///< extremes of a slot, in order of time
  int count_[kLanes] = {};
};

/// What zeros.inl finds of the slopes.
template <int degree>
struct ExtremeQueue::Visitor {
  ExtremeQueue& queue;
  /// The signal has one degree more than its slope.
  static constexpr int kSignalDegree = degree < kDegree ? degree + 2 : kDegree;

  const Powers<kSignalDegree>& f;

  void keeps_sign(const Series& slope, const Part& part, Mask mask) { go_on(slope[0], part, bits(mask)); }

  void may_cross(const Series& slope, const Part& part, const Ends& ends, Mask mask) {
    const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
    const Mask starts = abs(ends.left) > Lanes(0.0), moves = starts | (abs(ends.right) > Lanes(0.0));
    go_on(select(starts, ends.left, ends.right), part, bits(mask & moves));
    if (!any(crosses)) return;
    note(f.value(part.at(zero_of<degree>(slope, ends, crosses))), bits(crosses));
    queue.falling_ ^= bits(crosses);
  }

  /// A zero on the very edge between two parts shows only by the direction.
  void go_on(Lanes slope, const Part& part, unsigned lanes) {
    const unsigned falls = negative_bits(slope), turned = lanes & (falls ^ queue.falling_);
    if (turned != 0) note(f.value(part.start()), turned);
    queue.falling_ = (queue.falling_ & ~lanes) | (falls & lanes);
  }

  void note(Lanes x, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int slot = __builtin_ctz(lanes);
      queue.found_[queue.count_[slot]++][slot] = lane_of(x, slot);
    }
  }
};

template <int degree>
inline void ExtremeQueue::search_as(int slots) {
  Series slope, f;
  slope_.get_first<degree>(slope);
  if (degree < kDegree) set_zero_above(slope, degree);
  set_integral(f, slope, half_.first(), mean_.first());
  falling_ = negative_bits(start_.first());
  const Powers<Visitor<degree>::kSignalDegree> powers(f);
  Visitor<degree> visitor{*this, powers};
  search_zeros<degree>(slope, {Lanes(0.0), Lanes(1.0)}, Mask::from((1u << slots) - 1), kHalvings, visitor);
  report(slots);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
