/// Everything that is metered of one step, and which part of a response a panel is.
#pragma once

#include "engine/kernel/error_meter.inl"
#include "engine/kernel/pack.h"
#include "engine/kernel/shape_meter.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// The instants that matter to a response, in whole dead times and panels.
struct Span {
  int intervals;    ///< begun up to the horizon
  int late_from;    ///< the last dead time begins here
  double fraction;  ///< of the last interval that counts; 0 for all of it

  explicit Span(double horizon) {
    const int whole = static_cast<int>(horizon);
    fraction = horizon - whole;
    intervals = whole + (fraction > 0 ? 1 : 0);
    late_from = horizon > 1 ? static_cast<int>(horizon - 1) : 0;
  }
};

/// Where a panel stands in a response. `end`: x up to which it counts; 1 but on the panel that the horizon cuts.
struct Place {
  double middle, half, end;
  bool first_of_all, first_of_interval, last_of_interval, last_of_all, late;
  bool look;  ///< whether the signals are quiet is asked
  Course course = Course::open;
  bool is_cut() const { return end < 1; }
};

/// Where the meters of both steps put what needs a closer look.
struct Queues {
  ExtremeQueue extremes;
  SignQueue signs;
};

struct StepMeters {
  ShapeMeter y, u;
  ErrorMeter e;

  /// The signals that come are y/scale and u/scale, of a step of `step`.
  void begin(Lanes y_rest, Lanes u_rest, double step, Lanes scale, Queues& queues) {
    y.begin(y_rest, scale, queues.extremes);
    u.begin(u_rest, scale, queues.extremes);
    e.begin(Lanes(step), -scale, queues.signs);
  }

  void begin_smooth() { y.begin_smooth(), u.begin_smooth(); }

  void evaluate() {
    y.evaluate();
    u.evaluate();
    e.evaluate();
  }
};

/// What stays within this part of its largest deviation from rest, over a dead time, is at rest for good.
inline constexpr double kQuiet = 1e-11;

inline void watch_cut(ShapeMeter& meter, const Signal& s, const Place& at, Mask active) {
  Series f, slope;
  set_cut_off(f, s.f, at.end);
  set_cut_off(slope, s.slope, at.end);
  const Signal cut{f, slope, f[0] + (s.mean - s.f[0]), rest_bound(slope, 1)};
  if (at.first_of_interval) meter.enter(cut.start(), active);
  meter.watch<kDegree>(cut, 0.5 * at.half * (at.end + 1), active, at.course);
  meter.pass(cut.end(), active);
}

/// One panel of a signal; lanes that are not at rest leave `quiet` when asked.
template <int degree>
__attribute__((noinline)) void watch_signal(ShapeMeter& meter, const Signal& s, const Place& at, bool may_jump,
                                            Mask active, Mask& quiet) {
  // What u jumps from as the last dead time begins is of the dead time before.
  if (!at.is_cut() && (at.first_of_all || (at.first_of_interval && may_jump))) meter.enter(s.start(), active);
  if (at.late) meter.is_late = true;
  if (at.is_cut()) {
    watch_cut(meter, s, at, active);
  } else {
    if (at.first_of_interval && at.late) meter.pass(s.start(), active);
    meter.watch<degree>(s, at.half, active, at.course);
    if (at.late || at.last_of_all || (at.last_of_interval && (may_jump || at.look))) meter.pass(s.end(), active);
  }
  if (at.last_of_all) meter.finish(active);
  if (at.look) quiet = quiet & meter.is_quiet(s, kQuiet);
}

template <int degree>
void watch_error(ErrorMeter& meter, const Error& e, const Place& at, Mask active) {
  if (!at.is_cut()) return meter.watch<degree>(e, at.middle, at.half, active);
  Series cut;
  set_cut_off(cut, e.f, at.end);
  const double half = 0.5 * at.half * (at.end + 1);
  meter.watch<kDegree>({cut, rest_bound(cut, 1), error_sums_of(cut)}, at.middle - at.half + half, half, active);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
