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
template <typename T>
std::vector<T> gains(const Loop& loop) {
  const Setting& s = loop.setting;
  if (has_gains(loop.family)) return {s.gains.begin(), s.gains.begin() + loop.family.m + 2};
  return {std::isfinite(s.tau_i) ? T{s.kappa} / T{s.tau_i} : 0, s.kappa, s.delta};
}

int lags(const Loop& loop) {
  return loop.family.plant == Plant::fotd ? 1 : loop.family.plant == Plant::jotd ? loop.family.j : 0;
}

Real lag(const Loop& loop) { return loop.family.plant == Plant::fotd ? loop.setting.tau_1 : loop.setting.tau_j; }

/// L(j omega) = C Q P, factor by factor.
template <typename T>
class OpenLoop {
 public:
  explicit OpenLoop(const Loop& loop)
      : gains_(gains<T>(loop)),
        integrators_(integrators(loop.family.plant)),
        lags_(lags(loop)),
        n_(loop.family.n),
        lag_(static_cast<T>(lag(loop))),
        tau_f_(static_cast<T>(loop.setting.tau_f)) {}

  std::complex<T> operator()(T omega) const {
    std::complex<T> L = std::polar(T{1}, -omega) * controller(omega);
    for (int i = 0; i < integrators_; ++i) L = {L.imag() / omega, -L.real() / omega};
    L = behind_lags(L, lags_, lag_ * omega);
    return behind_lags(L, n_, tau_f_ * omega);
  }

 private:
  /// K_-1/s + K_0 + K_1 s + ..., powers of s from -1 up: -j/omega, 1, j omega, -omega^2, ...
  std::complex<T> controller(T omega) const {
    T real = 0, imaginary = 0, power = 1 / omega;
    for (std::size_t i = 0; i < gains_.size(); ++i, power *= omega) {
      const T term = (i % 4 == 0 || i % 4 == 3 ? -1 : 1) * gains_[i] * power;
      (i % 2 == 0 ? imaginary : real) += term;
    }
    return {real, imaginary};
  }

  /// x/(1 + j T omega)^count
  static std::complex<T> behind_lags(std::complex<T> x, int count, T T_omega) {
    const T real = 1 / (1 + T_omega * T_omega), imaginary = -T_omega * real;
    for (int i = 0; i < count; ++i)
      x = {x.real() * real - x.imag() * imaginary, x.real() * imaginary + x.imag() * real};
    return x;
  }

  std::vector<T> gains_;
  int integrators_, lags_, n_;
  T lag_, tau_f_;
};

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
  const std::vector<Real> K = gains<Real>(loop);
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

/// Of the last dead time, its own beginning included, against the whole, whose turning points are given.
bool is_settled(const oracle::Signal& signal, const std::vector<Real>& whole, std::size_t pieces, Real rest) {
  const oracle::Signal last(signal.end() - static_cast<std::ptrdiff_t>(pieces), signal.end());
  std::vector<Real> points = oracle::turning_points(last);
  points.front() = oracle::value(last.front().c, 0);
  return largest_from(points, rest) <= Real{kSettlingBand} * largest_from(whole, rest);
}

void put_signal(MeasureRow& row, const std::array<Measure, 4>& of, Measure largest, const std::vector<Real>& points,
                Real rest) {
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
  const std::vector<Real> of_y = oracle::turning_points(exact.y()), of_u = oracle::turning_points(exact.u());
  put_signal(row, names.of_y, names.y_max, of_y, rest.y);
  put_signal(row, names.of_u, names.u_max, of_u, rest.u);
  const auto last = static_cast<std::size_t>(pieces);
  return is_settled(exact.y(), of_y, last, rest.y) && is_settled(exact.u(), of_u, last, rest.u);
}

// ---------------------------------------------------------------- margins

/// Of the walk, in double: it only says between which two frequencies to look in long double.
struct Sample {
  double omega;
  std::complex<double> L;
  double squared;  ///< |L|^2
};

/// 2 % to 1e-3, where nothing turns; then 0.4 %, at most 0.02, and 0.06 from 60 on.
double step_from(double omega, int fineness) {
  const double part = omega < 1e-3 ? 0.02 : 0.004, most = omega < 60 ? 0.02 : 0.06;
  return std::min(part * omega, most) / fineness;
}

/// Up to where |L| has fallen below a tenth of its value at any phase crossover, or 1000.
std::vector<Sample> walk(const Loop& loop, int fineness) {
  const OpenLoop<double> at(loop);
  std::vector<Sample> samples;
  double crossing = 0;  // the largest |L|^2 below 1 at which it met the negative real axis
  for (double omega = 1e-11; omega < 1000; omega += step_from(omega, fineness)) {
    const std::complex<double> L = at(omega);
    const double squared = std::norm(L);
    if (!samples.empty() && L.imag() * samples.back().L.imag() < 0 && L.real() < 0 && squared < 1)
      crossing = std::max(crossing, squared);
    samples.push_back({omega, L, squared});
    if (omega > 60 && squared < crossing / 100 && squared < 1e-6) break;
  }
  return samples;
}

/// Where f, of different sign at both ends, is 0. Where only double saw the signs differ, one end is as good as the zero.
template <typename Function>
Real zero_between(const Function& f, Real low, Real high) {
  const Real at_low = f(low), at_high = f(high);
  if (at_low * at_high < 0) return oracle::zero_between(f, low, high, at_low, at_high);
  return std::abs(at_low) < std::abs(at_high) ? low : high;
}

constexpr auto kSquaredSensitivity = []<typename T>(std::complex<T> L) { return 1 / std::norm(T{1} + L); };
constexpr auto kSquaredComplementary = []<typename T>(std::complex<T> L) {
  return std::norm(L) / std::norm(T{1} + L);
};

/// The peak between two frequencies, f having one in between: golden sections, to 1e-8 of their distance, where a peak is flat.
template <typename Height>
Real peak_between(const OpenLoop<Real>& at, const Height& height, Real low, Real high) {
  constexpr Real kGolden = 1 / std::numbers::phi_v<Real>;
  Real left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  Real of_left = height(at(left)), of_right = height(at(right)), best = std::max(of_left, of_right);
  for (int k = 0; k < 38; ++k) {
    if (of_left < of_right) {
      low = left, left = right, of_left = of_right, right = low + kGolden * (high - low);
      best = std::max(best, of_right = height(at(right)));
    } else {
      high = right, right = left, of_right = of_left, left = high - kGolden * (high - low);
      best = std::max(best, of_left = height(at(left)));
    }
  }
  return best;
}

/// The highest of f over all frequencies, f^2 = height(L).
template <typename Height>
Real peak(const OpenLoop<Real>& at, const std::vector<Sample>& samples, const Height& height) {
  std::vector<double> heights;
  for (const Sample& sample : samples) heights.push_back(height(sample.L));
  const double highest = *std::max_element(heights.begin(), heights.end());
  Real best = std::max(height(at(samples.front().omega)), height(at(samples.back().omega)));
  for (std::size_t i = 1; i + 1 < samples.size(); ++i)
    if (heights[i] >= heights[i - 1] && heights[i] >= heights[i + 1] && heights[i] >= 0.81 * highest)
      best = std::max(best, peak_between(at, height, samples[i - 1].omega, samples[i + 1].omega));
  return std::sqrt(best);
}

/// lim |L| as omega -> inf: above 0 where the controller's derivative is not filtered and the plant has one lag or integrator.
Real neutral_gain(const Loop& loop) {
  const std::vector<Real> K = gains<Real>(loop);
  const int least = integrators(loop.family.plant) + lags(loop);
  if (loop.family.n > 0 || K.size() < 3 || least != 1) return 0;
  return lags(loop) == 1 ? K[2] / lag(loop) : K[2];
}

void put_peaks(const Loop& loop, const OpenLoop<Real>& at, const std::vector<Sample>& samples, MeasureRow& row) {
  const Real beyond = neutral_gain(loop), K_0 = gains<Real>(loop)[1];
  const bool integrates = gains<Real>(loop)[0] > 0 || integrators(loop.family.plant) > 0;
  row[Measure::Ms] = static_cast<double>(std::max(peak(at, samples, kSquaredSensitivity), 1 / (1 - beyond)));
  const Real before = integrates ? 1 : K_0 / (1 + K_0);
  row[Measure::Mt] =
      static_cast<double>(std::max({peak(at, samples, kSquaredComplementary), beyond / (1 - beyond), before}));
}

void put_gain_margins(const Loop& loop, const OpenLoop<Real>& at, const std::vector<Sample>& samples,
                      MeasureRow& row) {
  Real above = neutral_gain(loop) > 0 ? 1 / neutral_gain(loop) : Real{kInf}, below = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].L.imag() * samples[i - 1].L.imag() > 0 || samples[i].L.real() > 0) continue;
    const Real omega = zero_between([&](Real w) { return at(w).imag(); }, samples[i - 1].omega, samples[i].omega);
    const Real factor = 1 / std::abs(at(omega));
    (factor > 1 ? above : below) = factor > 1 ? std::min(above, factor) : std::max(below, factor);
  }
  row[Measure::GM] = static_cast<double>(above), row[Measure::GM_low] = static_cast<double>(below);
}

void put_phase_margins(const OpenLoop<Real>& at, const std::vector<Sample>& samples, MeasureRow& row) {
  constexpr Real pi = std::numbers::pi_v<Real>;
  Real phase = kInf, delay = kInf;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if ((samples[i].squared < 1) == (samples[i - 1].squared < 1)) continue;
    const Real omega =
        zero_between([&](Real w) { return std::norm(at(w)) - 1; }, samples[i - 1].omega, samples[i].omega);
    const Real turn = std::arg(-at(omega));  // from -1, lead positive
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
  const OpenLoop<Real> at(loop);
  const std::vector<Sample> samples = walk(loop, fineness);
  put_peaks(loop, at, samples, found.measures);
  put_gain_margins(loop, at, samples, found.measures);
  put_phase_margins(at, samples, found.measures);
  return found;
}

}  // namespace portrait::audit
