/// Total variation, distance from shapes with at most one and two pulses, and largest magnitude of a signal that starts from
/// x(0-) = 0. See engine/measures/variation.h for the definitions.
///
/// Extremes are located, never sampled: a slope that its first term keeps away from zero needs nothing but that test, a sum of
/// magnitudes and a comparison. Where it fails, the lane alone is copied to a queue, and the search is made for a whole
/// vector of such lanes, of whatever signal and time they come. Turning points are noted lane by lane in order of time, and
/// evaluated for all lanes together.
#pragma once

#include "engine/kernel/zeros.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr double kNegligible = 1e-14;

/// A signal on a panel: scale times f, with f' per dead time and at least its sum of |c_k|, k >= 1.
struct Signal {
  const Series& f;
  const Series& slope;
  Lanes scale, slope_rest;
};

class ShapeMeter;

/// Panels of single lanes on which the slope may vanish.
class ExtremeQueue {
 public:
  ExtremeQueue() {
    set_zero(f_);
    set_zero(slope_);
    half_ = rising_ = Lanes(0.0);
  }

  void push(ShapeMeter& meter, int lane, const Signal& signal, double half, double direction);
  void flush();

 private:
  static constexpr int kMostFound = 2 << kHalvings;
  struct Visitor;

  Series f_, slope_;
  Lanes half_, rising_;
  ShapeMeter* meter_[kLanes];
  int lane_[kLanes];
  int size_ = 0;
  double found_[kMostFound][kLanes];  ///< extremes of a slot, in order of time
  int count_[kLanes] = {};
};

class ShapeMeter {
 public:
  bool is_late = false;  ///< the last dead time has begun

  void begin(Lanes at_rest, ExtremeQueue& queue) {
    queue_ = &queue;
    rest_ = at_rest;
    last_ = rising_ = variation_ = largest_ = passed_ = late_ = tail_ = scale_ = Lanes(0.0);
    furthest_ = reach_ = shape1_ = shape2_ = abs(at_rest);
    above_ = below_ = Lanes(-1e300);
  }

  /// The response begins here, or may jump here.
  void enter(Lanes x, Mask active) {
    const Mask jumps = active & (abs(x - passed_) > Lanes(1e-13) * max(scale_, abs(x)));
    if (!any(jumps)) return;
    turn(passed_, jumps);
    turn(x, jumps);
    rising_ = select(jumps, Lanes(0.0), rising_);
  }

  /// One panel, of the given half length.
  void watch(const Signal& s, double half, Mask active) {
    const Lanes size = abs(s.scale), first = abs(s.slope[0]), mean = s.scale * s.f[0];
    tail_ = select(active, max(tail_, size * (abs(s.f[kDegree]) + abs(s.f[kDegree - 1]))), tail_);
    scale_ = select(active, max(scale_, abs(mean)), scale_);
    reach_ = select(active, max(reach_, abs(mean - rest_)), reach_);
    // What moves less than rounding has no direction.
    const Mask moves = active & (Lanes(half) * size * (first + s.slope_rest) > Lanes(kNegligible) * scale_);
    const Mask unsure = but_not(moves, first > s.slope_rest);
    if (any(unsure)) return watch_closely(s, half, moves, unsure);
    const Lanes slope = s.scale * s.slope[0];
    go_on(slope, slope, s, moves);
  }

  /// The value at an edge of a panel.
  void pass(Lanes x, Mask active) {
    passed_ = select(active, x, passed_);
    if (is_late) late_ = select(active, max(late_, abs(x - rest_)), late_);
  }

  /// The last dead time begins.
  void begin_late() {
    evaluate();
    is_late = true;
  }

  /// The horizon: the last value passed is the last point.
  void finish(Mask mask) { turn(passed_, mask); }

  /// All that was noted goes into the measures. Call it before reading them.
  void evaluate() {
    queue_->flush();
    drain();
  }

  /// Lanes in which f stays at rest on this panel.
  Mask is_quiet(const Signal& s, double part) const {
    return abs(mul_add(s.scale, s.f[0], -rest_)) + abs(s.scale) * rest_bound(s.f, 1) < Lanes(part) * reach_;
  }

  Lanes variation() const { return variation_; }
  Lanes largest() const { return largest_; }
  Lanes late_part() const { return late_ / furthest_; }
  Lanes tail_part() const { return tail_ / largest_; }
  /// TVm
  Lanes deviation0() const { return deviation(abs(rest_)); }
  Lanes deviation1() const { return deviation(shape1_); }
  Lanes deviation2() const { return deviation(shape2_); }

  /// A turning point of one lane. REQUIRES: those before it have been noted.
  void note(int lane, double x) {
    turns_[count_[lane]][lane] = x;
    if (++count_[lane] == kMostTurns) drain();
  }

  void no_longer_waits(int lane) { waiting_ &= ~(1u << lane); }

 private:
  static constexpr int kMostTurns = 32;

  /// A turning point, in the lanes of `mask`, after all that came before.
  void turn(Lanes x, Mask mask) {
    if (bits(mask) & waiting_) queue_->flush();
    for (unsigned left = bits(mask); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      note(lane, lane_of(x, lane));
    }
  }

  /// From the panel's start f goes in the direction of `slope`, at its end in that of `end`.
  void go_on(Lanes slope, Lanes end, const Signal& s, Mask mask) {
    const Lanes direction = select(slope > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
    const Mask turned = mask & (direction * rising_ < Lanes(0.0));
    if (any(turned)) turn(s.scale * value_at_start(s.f), turned);
    rising_ = select(mask, select(end > Lanes(0.0), Lanes(1.0), Lanes(-1.0)), rising_);
  }

  __attribute__((noinline)) void watch_closely(const Signal& s, double half, Mask moves, Mask unsure) {
    Ends ends = ends_of(s.slope);
    ends = {s.scale * ends.left, s.scale * ends.right};
    // Where f' is 0 at one end its direction is that of the other.
    const Mask starts = abs(ends.left) > Lanes(0.0), stops = abs(ends.right) > Lanes(0.0);
    const Lanes start = select(starts, ends.left, ends.right), end = select(stops, ends.right, ends.left);
    go_on(start, end, s, moves & (starts | stops));
    for (unsigned left = bits(unsure); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      waiting_ |= 1u << lane;
      queue_->push(*this, lane, s, half, lane_of(start, lane));
    }
  }

  void drain() {
    int most = 0;
    for (const int count : count_) most = count > most ? count : most;
    for (int k = 0; k < most; ++k) {
      unsigned there = 0;
      for (int lane = 0; lane < kLanes; ++lane) there |= (k < count_[lane] ? 1u : 0u) << lane;
      take(Lanes::from(turns_[k]), Mask::from(there));
    }
    for (int& count : count_) count = 0;
  }

  void take(Lanes x, Mask mask) {
    variation_ = select(mask, variation_ + abs(x - last_), variation_);
    largest_ = select(mask, max(largest_, abs(x)), largest_);
    last_ = select(mask, x, last_);
    const Mask is_above = mask & (x > rest_), is_below = mask & (x < rest_);
    const Lanes to_rest = abs(x - rest_), first = abs(x);
    furthest_ = select(mask, max(furthest_, to_rest), furthest_);
    if (is_late) late_ = select(mask, max(late_, to_rest), late_);
    const Lanes second = select(is_above, below_ + x, above_ - x);
    const Lanes one = first + to_rest, two = max(one, second + to_rest);
    const Mask pulse = is_above | is_below;
    shape1_ = select(pulse, max(shape1_, one), shape1_);
    shape2_ = select(pulse, max(shape2_, two), shape2_);
    above_ = select(is_above, max(above_, first + x), above_);
    below_ = select(is_below, max(below_, first - x), below_);
  }

  Lanes deviation(Lanes shape) const { return max(Lanes(0.0), variation_ + abs(rest_ - last_) - shape); }

  Lanes rest_;                 ///< x(inf)
  Lanes rising_;               ///< direction since the last turning point: 1, -1, or 0 for none yet
  Lanes passed_;               ///< value at the end of the last panel passed
  Lanes scale_, reach_;        ///< largest mean of a panel, and its largest distance from rest
  Lanes tail_;                 ///< largest last coefficients: how far from resolved
  Lanes late_;                 ///< largest |x - x(inf)| over the last dead time
  Lanes last_;                 ///< value at the last turning point
  Lanes variation_, largest_;  ///< TV and max |x| up to the last turning point
  Lanes furthest_;             ///< largest |x - x(inf)|
  Lanes shape1_, shape2_;      ///< variation of the best shape with at most one, at most two pulses
  Lanes above_, below_;        ///< best first pulse seen from the next one: its variation plus, minus its value
  ExtremeQueue* queue_ = nullptr;
  unsigned waiting_ = 0;  ///< lanes with panels in the queue
  double turns_[kMostTurns][kLanes];
  int count_[kLanes] = {};
};

inline void ExtremeQueue::push(ShapeMeter& meter, int lane, const Signal& s, double half, double direction) {
  const double scale = lane_of(s.scale, lane);
  copy_lane(f_, size_, s.f, lane, scale);
  copy_lane(slope_, size_, s.slope, lane, scale);
  lane_of(half_, size_) = half;
  lane_of(rising_, size_) = direction > 0 ? 1.0 : -1.0;
  meter_[size_] = &meter;
  lane_[size_] = lane;
  if (++size_ == kLanes) flush();
}

/// What zeros.inl finds of the slopes.
struct ExtremeQueue::Visitor {
  ExtremeQueue& queue;

  void keeps_sign(const Series& slope, const Part& part, Mask mask) { go_on(slope[0], part, mask); }

  void may_cross(const Series& slope, const Part& part, const Ends& ends, Mask mask) {
    const Mask crosses = mask & (ends.left * ends.right < Lanes(0.0));
    const Lanes start = select(abs(ends.left) > Lanes(0.0), ends.left, ends.right);
    go_on(start, part, mask & (abs(start) > Lanes(0.0)));
    if (!any(crosses)) return;
    const Zero zero = zero_of(slope, ends, crosses);
    // From x on Newton's last step adds half of itself times f'; f' by the panel's x.
    const Lanes left_over = Lanes(0.5) * queue.half_ * part.half * zero.step * zero.here;
    note(value(queue.f_, part.at(zero.x)) + left_over, crosses);
    queue.rising_ = select(crosses, -queue.rising_, queue.rising_);
  }

  /// A zero on the very edge between two parts shows only by the direction.
  void go_on(Lanes slope, const Part& part, Mask mask) {
    const Lanes direction = select(slope > Lanes(0.0), Lanes(1.0), Lanes(-1.0));
    const Mask turned = mask & (direction * queue.rising_ < Lanes(0.0));
    if (any(turned)) note(value(queue.f_, part.start()), turned);
    queue.rising_ = select(mask, direction, queue.rising_);
  }

  void note(Lanes x, Mask mask) {
    for (unsigned left = bits(mask); left != 0; left &= left - 1) {
      const int slot = __builtin_ctz(left);
      queue.found_[queue.count_[slot]++][slot] = lane_of(x, slot);
    }
  }
};

/// Slots were filled in order of time: in that order they report, also two of one lane.
inline void ExtremeQueue::flush() {
  if (size_ == 0) return;
  Visitor visitor{*this};
  search_zeros(slope_, {Lanes(0.0), Lanes(1.0)}, Mask::from((1u << size_) - 1), kHalvings, visitor);
  const int slots = size_;
  size_ = 0;
  for (int slot = 0; slot < slots; ++slot) {
    meter_[slot]->no_longer_waits(lane_[slot]);
    for (int i = 0; i < count_[slot]; ++i) meter_[slot]->note(lane_[slot], found_[i][slot]);
    count_[slot] = 0;
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
