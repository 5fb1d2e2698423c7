#include "tests/audit/independent.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "engine/measures/step_measures.h"
#include "tests/engine/loop/root_count.h"
#include "tests/oracle/method_of_steps.h"

namespace portrait::audit {
namespace {

using oracle::Real;
using Complex = std::complex<Real>;

// ---------------------------------------------------------------- the loop as it is written

/// K_-1, K_0, K_1, ...
std::vector<Real> gains(const Loop& loop) {
  const Setting& s = loop.setting;
  if (has_gains(loop.family)) return {s.gains.begin(), s.gains.begin() + loop.family.m + 2};
  return {std::isfinite(s.tau_i) ? Real{s.kappa} / s.tau_i : 0, s.kappa, s.delta};
}

int lags(const Loop& loop) {
  return loop.family.plant == Plant::fotd ? 1 : loop.family.plant == Plant::jotd ? loop.family.j : 0;
}

Real lag(const Loop& loop) { return loop.family.plant == Plant::fotd ? loop.setting.tau_1 : loop.setting.tau_j; }

Complex open_loop_at(const Loop& loop, Real omega) {
  const Complex s(0, omega);
  Complex C = 0, power = Real{1} / s;
  for (const Real K : gains(loop)) C += K * power, power *= s;
  Complex L = C * std::exp(-s);
  for (int i = 0; i < integrators(loop.family.plant); ++i) L /= s;
  for (int i = 0; i < lags(loop); ++i) L /= Real{1} + lag(loop) * s;
  for (int i = 0; i < loop.family.n; ++i) L /= Real{1} + Real{loop.setting.tau_f} * s;
  return L;
}

// ---------------------------------------------------------------- responses

/// No piece longer than four of the shortest time constant that its power series must hold.
int pieces_for(const Loop& loop) {
  const Setting& s = loop.setting;
  double shortest = 4;
  const bool pid = !has_gains(loop.family);
  if (loop.family.n > 0) shortest = std::min(shortest, s.tau_f);
  if (lags(loop) > 0) shortest = std::min(shortest, static_cast<double>(lag(loop)));
  if (pid && loop.family.prefilter != Prefilter::none) shortest = std::min(shortest, s.tau_i);
  if (pid && loop.family.prefilter == Prefilter::full && s.delta > 0) shortest = std::min(shortest, tau_d(s));
  return 1 + static_cast<int>(1 / (4 * shortest));
}

struct Rest {
  Real y, u;
};

/// P(0) = 1 of a plant without integrators, inf of one with; K_-1/s at s = 0 is inf.
Rest at_rest(const Loop& loop, bool setpoint) {
  const std::vector<Real> K = gains(loop);
  const bool integral = K[0] > 0, integrating = integrators(loop.family.plant) > 0;
  if (integrating) return {setpoint ? 1 : integral ? 0 : 1 / K[1], Real(setpoint ? 0 : -1)};
  if (integral) return {Real(setpoint ? 1 : 0), Real(setpoint ? 1 : -1)};
  const Real y = (setpoint ? K[1] : 1) / (1 + K[1]);
  return {y, setpoint ? y : -K[1] * y};
}

Real largest_from(const std::vector<Real>& points, Real rest) {
  Real largest = 0;
  for (const Real x : points) largest = std::max(largest, std::abs(x - rest));
  return largest;
}

/// Of the last dead time, its own beginning included, against the whole.
bool is_settled(const oracle::Signal& signal, std::size_t pieces, Real rest) {
  const oracle::Signal last(signal.end() - static_cast<std::ptrdiff_t>(pieces), signal.end());
  std::vector<Real> points = oracle::turning_points(last);
  points.front() = oracle::value(last.front().c, 0);
  return largest_from(points, rest) <= Real{kSettlingBand} * largest_from(oracle::turning_points(signal), rest);
}

void put_signal(MeasureRow& row, const std::array<Measure, 4>& of, Measure largest, const oracle::Signal& signal, Real rest) {
  const std::vector<Real> points = oracle::turning_points(signal);
  row[of[0]] = static_cast<double>(oracle::variation(points));
  for (int m = 0; m <= 2; ++m)
    row[of[static_cast<std::size_t>(m) + 1]] = static_cast<double>(oracle::shape_deviation(points, rest, m));
  row[largest] = static_cast<double>(largest_from(points, 0));
}

/// Gives back whether the response has settled.
bool put_step(const Loop& loop, bool setpoint, int dead_times, int fineness, MeasureRow& row) {
  const StepMeasures& names = setpoint ? kSetpointMeasures : kDisturbanceMeasures;
  const int pieces = fineness * pieces_for(loop);
  oracle::MethodOfSteps exact(loop, setpoint ? 1 : 0, setpoint ? 0 : 1, pieces);
  exact.run_to(dead_times);
  const Rest rest = at_rest(loop, setpoint);
  const Real target = setpoint ? 1 : 0;
  if (rest.y == target) {
    const oracle::ErrorIntegrals e = oracle::error_integrals(exact.y(), target);
    row[names.IAE] = static_cast<double>(e.IAE), row[names.ISE] = static_cast<double>(e.ISE);
    row[names.ITAE] = static_cast<double>(e.ITAE), row[names.ITSE] = static_cast<double>(e.ITSE);
  }
  put_signal(row, names.of_y, names.y_max, exact.y(), rest.y);
  put_signal(row, names.of_u, names.u_max, exact.u(), rest.u);
  const auto last = static_cast<std::size_t>(pieces);
  return is_settled(exact.y(), last, rest.y) && is_settled(exact.u(), last, rest.u);
}

// ---------------------------------------------------------------- margins

struct Sample {
  Real omega;
  Complex L;
};

/// Steps of 2 % to 1e-3, where nothing turns; then of 0.4 % or 0.02, up to where |L| has fallen below a tenth of its value at any phase crossover, or 1000.
std::vector<Sample> walk(const Loop& loop, int fineness) {
  std::vector<Sample> samples;
  const Real part = Real{0.004L} / fineness, most = Real{0.02L} / fineness;
  Real crossing = 0;  // the largest |L| below 1 at which it met the negative real axis
  for (Real omega = 1e-11L; omega < 1000; omega += std::min((omega < Real{1e-3L} ? 5 : 1) * part * omega, most)) {
    const Complex L = open_loop_at(loop, omega);
    if (!samples.empty() && L.imag() * samples.back().L.imag() < 0 && L.real() < 0 && std::abs(L) < 1)
      crossing = std::max(crossing, std::abs(L));
    samples.push_back({omega, L});
    if (omega > 60 && std::abs(L) < crossing / 10 && std::abs(L) < Real{1e-3L}) break;
  }
  return samples;
}

/// Where f, of different sign at both ends, is 0.
template <typename Function>
Real bisected(const Function& f, Real low, Real high) {
  const bool negative = f(low) < 0;
  for (int i = 0; i < 70; ++i) {
    const Real middle = (low + high) / 2;
    ((f(middle) < 0) == negative ? low : high) = middle;
  }
  return low;
}

template <typename Function>
Real peak(const std::vector<Sample>& samples, const Function& of) {
  const auto at = [&](std::size_t i) { return of.height(samples[i].L); };
  Real highest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) highest = std::max(highest, at(i));
  Real best = highest;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (at(i) < at(i - 1) || at(i) < at(i + 1) || at(i) < Real{0.9L} * highest) continue;
    Real low = samples[i - 1].omega, high = samples[i + 1].omega;
    for (int k = 0; k < 90; ++k) {  // thirds: f has one peak in between
      const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
      const Real left = of.height(of.L(a)), right = of.height(of.L(b));
      best = std::max({best, left, right});
      (left < right ? low : high) = left < right ? a : b;
    }
  }
  return best;
}

struct Sensitivity {
  const Loop& loop;
  bool complementary;
  Complex L(Real omega) const { return open_loop_at(loop, omega); }
  Real height(Complex L) const { return (complementary ? std::abs(L) : 1) / std::abs(Real{1} + L); }
};

/// lim |L| as omega -> inf: above 0 where the controller's derivative is not filtered and the plant has one lag or integrator.
Real neutral_gain(const Loop& loop) {
  const std::vector<Real> K = gains(loop);
  const int least = integrators(loop.family.plant) + lags(loop);
  if (loop.family.n > 0 || K.size() < 3 || least != 1) return 0;
  return lags(loop) == 1 ? K[2] / lag(loop) : K[2];
}

void put_peaks(const Loop& loop, const std::vector<Sample>& samples, MeasureRow& row) {
  const Real beyond = neutral_gain(loop), K_0 = gains(loop)[1];
  const bool integrates = gains(loop)[0] > 0 || integrators(loop.family.plant) > 0;
  row[Measure::Ms] = static_cast<double>(std::max(peak(samples, Sensitivity{loop, false}), 1 / (1 - beyond)));
  const Real before = integrates ? 1 : K_0 / (1 + K_0);
  row[Measure::Mt] = static_cast<double>(
      std::max({peak(samples, Sensitivity{loop, true}), beyond / (1 - beyond), before}));
}

void put_gain_margins(const Loop& loop, const std::vector<Sample>& samples, MeasureRow& row) {
  Real above = neutral_gain(loop) > 0 ? 1 / neutral_gain(loop) : Real{kInf}, below = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].L.imag() * samples[i - 1].L.imag() > 0 || samples[i].L.real() > 0) continue;
    const Real omega = bisected([&](Real w) { return open_loop_at(loop, w).imag(); }, samples[i - 1].omega, samples[i].omega);
    const Real factor = 1 / std::abs(open_loop_at(loop, omega));
    (factor > 1 ? above : below) = factor > 1 ? std::min(above, factor) : std::max(below, factor);
  }
  row[Measure::GM] = static_cast<double>(above), row[Measure::GM_low] = static_cast<double>(below);
}

void put_phase_margins(const Loop& loop, const std::vector<Sample>& samples, MeasureRow& row) {
  constexpr Real pi = std::numbers::pi_v<Real>;
  Real phase = kInf, delay = kInf;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if ((std::abs(samples[i].L) < 1) == (std::abs(samples[i - 1].L) < 1)) continue;
    const Real omega = bisected([&](Real w) { return std::abs(open_loop_at(loop, w)) - 1; }, samples[i - 1].omega, samples[i].omega);
    const Real turn = std::arg(-open_loop_at(loop, omega));  // from -1, lead positive
    phase = std::min(phase, std::abs(turn) * 180 / pi);
    delay = std::min(delay, (turn < 0 ? turn + 2 * pi : turn) / omega);
  }
  row[Measure::PM] = static_cast<double>(phase), row[Measure::DM] = static_cast<double>(delay);
}

}  // namespace

bool is_stable_by_contour(const Loop& loop) {
  if (neutral_gain(loop) >= 1) return false;
  return (is_basic(loop.family) ? unstable_roots_by_contour(loop) : unstable_roots_by_contour(general(loop))) == 0;
}

Independent measured_independently(const Loop& loop, int dead_times, int fineness) {
  Independent found;
  const bool of_w = put_step(loop, true, dead_times, fineness, found.measures);
  const bool of_d = put_step(loop, false, dead_times, fineness, found.measures);
  found.status = of_w && of_d ? Status::settled : Status::not_settled;
  const std::vector<Sample> samples = walk(loop, fineness);
  put_peaks(loop, samples, found.measures);
  put_gain_margins(loop, samples, found.measures);
  put_phase_margins(loop, samples, found.measures);
  return found;
}

}  // namespace portrait::audit
