/// Total variation, distance from shapes with at most one and two pulses, and largest magnitude of a signal that starts from
/// x(0-) = 0. See engine/measures/variation.h for the definitions.
///
/// Extremes are located, never sampled: a slope that its first term keeps away from zero needs nothing but that test and a
/// comparison of signs. Where it fails, the lane alone goes to a queue (extreme_queue.inl), which searches a whole vector of
/// such lanes at a time, of whatever signal and time they come. Turning points are noted lane by lane in order of time, and
/// evaluated for all lanes together.
///
/// A signal is x = scale * f; up to `take` everything here is f.
#pragma once

#include "engine/kernel/extreme_queue.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr double kNegligible = 1e-14;
/// What the last coefficient but one counts: of a smooth signal on a whole dead time it is many times the last.
template <int degree>
inline constexpr double kBeforeLast = degree == kDegree ? 1 : 0.125;

/// Which way a signal goes on a panel, where it is known before anyone looks.
enum class Course { open, rises, falls };

class ShapeMeter {
 public:
  bool is_late = false;  ///< the last dead time has begun

  void begin(Lanes at_rest, Lanes scale, ExtremeQueue& queue) {
    queue_ = &queue;
    rest_ = at_rest;
    scale_ = scale;
    last_ = variation_ = largest_ = passed_ = end_ = late_ = tail_ = smooth_tail_ = mean_ = Lanes(0.0);
    furthest_ = shape1_ = shape2_ = abs(at_rest);
    above_ = below_ = Lanes(-1e300);
  }

  /// From now on series end at kSmoothDegree.
  void begin_smooth() {
    smooth_tail_ = tail_;
    tail_ = Lanes(0.0);
    is_smooth_ = true;
  }

  /// The response begins here, or may jump here.
  void enter(Lanes x, Mask active) {
    const unsigned jumps = bits(active & (abs(x - passed_) > Lanes(1e-13) * max(mean_, abs(x))));
    if (jumps == 0) return;
    turn(passed_, jumps);
    turn(x, jumps);
    known_ &= ~jumps;
  }

  /// What a panel shows at first sight: lanes whose slope certainly keeps its sign, and those in which it is negative.
  struct Sight {
    unsigned sure, falls;
  };

  static Sight see(const Signal& s, Mask active) {
    return {bits(active & (abs(s.slope[0]) > s.slope_rest)), negative_bits(s.slope[0])};
  }

  void see_size(const Signal& s, Mask active) { mean_ = select(active, max(mean_, abs(s.mean)), mean_); }

  /// Where a panel's series ends.
  template <int degree>
  void see_end(const Signal& s, Mask active) {
    tail_ = select(active, max(tail_, mul_add(kBeforeLast<degree>, abs(s.f[degree - 1]), abs(s.f[degree]))), tail_);
  }

  /// Whether in all of these lanes the signal goes on as before: then a panel needs nothing but to be seen.
  bool goes_on(const Sight& sight, unsigned on) const {
    return (((sight.falls ^ falling_) | ~(known_ & sight.sure)) & on) == 0;
  }

  /// One panel, of the given half length, that has been seen.
  void take_in(const Sight& sight, const Signal& s, double half, unsigned on) {
    if (sight.sure != on) return watch_closely(s, half, on, sight.sure);
    go_on(sight.falls, on, s);
  }

  template <int degree>
  void watch(const Signal& s, double half, Mask active, Course course = Course::open) {
    const unsigned on = bits(active);
    see_end<degree>(s, active);
    see_size(s, active);
    Sight sight = see(s, active);
    if (course != Course::open) sight = {on, course == Course::falls ? on : 0};
    take_in(sight, s, half, on);
  }

  /// The value at an edge of a panel.
  void pass(Lanes x, Mask active) {
    passed_ = select(active, x, passed_);
    if (is_late) late_ = select(active, max(late_, abs(mul_add(scale_, x, -rest_))), late_);
  }

  /// The horizon, or rest: the last value passed is the last point. In these lanes nothing follows.
  void finish(Mask mask) {
    end_ = select(mask, passed_, end_);
    ended_ |= bits(mask);
  }

  /// All that was noted goes into the measures. Call it once, before reading them.
  void evaluate() {
    queue_->flush();
    drain();
    take(scale_ * end_, Mask::from(ended_));
  }

  /// Lanes in which the signal stays at rest on this panel.
  Mask is_quiet(const Signal& s, double part) const {
    return abs(mul_add(scale_, s.mean, -rest_)) + abs(scale_) * rest_bound(s.f, 1) < Lanes(part) * largest_seen();
  }
  /// Those and some more, by the mean alone.
  Mask may_be_quiet(const Signal& s, double part) const {
    return abs(mul_add(scale_, s.mean, -rest_)) < Lanes(part) * largest_seen();
  }

  Lanes variation() const { return variation_; }
  Lanes largest() const { return largest_; }
  Lanes late_part() const { return late_ / furthest_; }
  /// Largest last coefficients as a part of the signal: at kDegree, and at kSmoothDegree.
  Lanes tail_part() const { return part(is_smooth_ ? smooth_tail_ : tail_); }
  Lanes smooth_tail_part() const { return part(is_smooth_ ? tail_ : smooth_tail_); }
  /// TVm
  Lanes deviation0() const { return deviation(abs(rest_)); }
  Lanes deviation1() const { return deviation(shape1_); }
  Lanes deviation2() const { return deviation(shape2_); }

  /// A turning point of one lane. `late`: of the last dead time. REQUIRES: those before it have been noted.
  void note(int lane, double x, bool late) {
    if (late) note_late(lane, x);
    turns_[count_[lane]][lane] = x;
    if (++count_[lane] == kMostTurns) drain();
  }

  void waits(int lane) { waiting_ |= 1u << lane; }
  void no_longer_waits(int lane) { waiting_ &= ~(1u << lane); }

 private:
  static constexpr int kMostTurns = 32;

  /// A turning point, in these lanes, after all that came before.
  void turn(Lanes x, unsigned lanes) {
    if (lanes & waiting_) queue_->flush();
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      note(lane, lane_of(x, lane), is_late);
    }
  }

  void note_late(int lane, double x) {
    const double to_rest = __builtin_fabs(lane_of(scale_, lane) * x - lane_of(rest_, lane));
    double& late = lane_of(late_, lane);
    late = to_rest > late ? to_rest : late;
  }

  /// From the panel's start f falls in the lanes of `falls`, and rises in the others of `lanes`.
  void go_on(unsigned falls, unsigned lanes, const Signal& s) {
    const unsigned turned = known_ & lanes & (falls ^ falling_);
    if (turned != 0) turn(s.start(), turned);
    falling_ = (falling_ & ~lanes) | (falls & lanes);
    known_ |= lanes;
  }

  __attribute__((noinline)) void watch_closely(const Signal& s, double half, unsigned on, unsigned sure) {
    see_size(s, Mask::from(on & ~sure));
    // What moves less than rounding has no direction.
    const Lanes least = Lanes(kNegligible / half) * mean_;
    const unsigned moves = on & bits(abs(s.slope[0]) + s.slope_rest > least);
    const Ends ends = is_smooth_ ? ends_of<kSmoothDegree>(s.slope) : ends_of(s.slope);
    // Where f' is 0 at one end its direction is that of the other.
    const Mask starts = abs(ends.left) > Lanes(0.0), stops = abs(ends.right) > Lanes(0.0);
    const Lanes start = select(starts, ends.left, ends.right), end = select(stops, ends.right, ends.left);
    const unsigned directed = moves & bits(starts | stops), unsure = moves & ~sure;
    go_on(negative_bits(start), directed, s);
    falling_ = (falling_ & ~directed) | (negative_bits(end) & directed);
    if (unsure == 0) return;
    waiting_ |= unsure;
    is_smooth_ ? queue_->push<kSmoothDegree>(*this, unsure, is_late, s, half, start)
               : queue_->push<kDegree>(*this, unsure, is_late, s, half, start);
  }

  void drain() {
    int most = 0;
    for (const int count : count_) most = count > most ? count : most;
    for (int k = 0; k < most; ++k) {
      unsigned there = 0;
      for (int lane = 0; lane < kLanes; ++lane) there |= (k < count_[lane] ? 1u : 0u) << lane;
      take(scale_ * Lanes::from(turns_[k]), Mask::from(there));
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
    const Lanes second = select(is_above, below_ + x, above_ - x);
    const Lanes one = first + to_rest, two = max(one, second + to_rest);
    const Mask pulse = is_above | is_below;
    shape1_ = select(pulse, max(shape1_, one), shape1_);
    shape2_ = select(pulse, max(shape2_, two), shape2_);
    above_ = select(is_above, max(above_, first + x), above_);
    below_ = select(is_below, max(below_, first - x), below_);
  }

  Lanes largest_seen() const { return max(abs(rest_), abs(scale_) * mean_); }
  Lanes part(Lanes tail) const { return abs(scale_) * tail / largest_; }
  Lanes deviation(Lanes shape) const { return max(Lanes(0.0), variation_ + abs(rest_ - last_) - shape); }

  Lanes rest_;   ///< x(inf)
  Lanes scale_;  ///< x/f
  // Of f:
  Lanes passed_;              ///< value at the end of the last panel passed
  Lanes end_;                 ///< last value, of lanes that have ended
  Lanes mean_;                ///< largest mean of a panel, of those where the signal may turn and of some others
  Lanes tail_, smooth_tail_;  ///< largest last coefficients: of the degree in use, of the one before
  unsigned falling_ = 0;      ///< direction since the last turning point, a bit a lane
  unsigned known_ = 0;        ///< lanes that have a direction
  unsigned waiting_ = 0;      ///< lanes with panels in the queue
  unsigned ended_ = 0;        ///< lanes in which nothing follows
  // Of x:
  Lanes late_;                 ///< largest |x - x(inf)| over the last dead time
  Lanes last_;                 ///< value at the last turning point
  Lanes variation_, largest_;  ///< TV and max |x| up to the last turning point
  Lanes furthest_;             ///< largest |x - x(inf)|
  Lanes shape1_, shape2_;      ///< variation of the best shape with at most one, at most two pulses
  Lanes above_, below_;        ///< best first pulse seen from the next one: its variation plus, minus its value
  ExtremeQueue* queue_ = nullptr;
  bool is_smooth_ = false;
  double turns_[kMostTurns][kLanes];  ///< of f
  int count_[kLanes] = {};
};

inline void ExtremeQueue::report(int slots) {
  for (int slot = 0; slot < slots; ++slot) {
    meter_[slot]->no_longer_waits(lane_[slot]);
    for (int i = 0; i < count_[slot]; ++i) meter_[slot]->note(lane_[slot], found_[i][slot], late_[slot]);
    count_[slot] = 0;
  }
  size_ -= slots;
  if (size_ == 0) return;
  slope_.forget_first<kDegree>();
  mean_.forget_first(), start_.forget_first(), half_.forget_first();
  for (int i = 0; i < size_; ++i) {
    meter_[i] = meter_[i + slots], lane_[i] = lane_[i + slots], late_[i] = late_[i + slots];
    meter_[i]->waits(lane_[i]);
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
