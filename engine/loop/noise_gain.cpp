#include "engine/loop/noise_gain.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/base/check.h"
#include "engine/loop/adaptive_integral.h"
#include "engine/loop/open_loop.h"
#include "engine/loop/phase_crossovers.h"

namespace portrait {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;
using namespace std::complex_literals;

/// How far the path is turned off the real axis: far enough that exponentials die out soon, and not so far that it
/// comes near the poles of L on the imaginary axis, whose powers would outgrow the integral.
constexpr double kTurn = pi / 9;
/// Of the square, summed differences of two rules: the error itself is far smaller.
constexpr double kTolerance = 1e-9;

/// s^k (T_1 s + 1)(T_2 s + 1)...
struct Factors {
  int integrators = 0;
  std::vector<double> lags;

  Complex at(Complex s) const {
    Complex value = 1;
    for (int i = 0; i < integrators; ++i) value *= s;
    for (const double T : lags) value *= 1.0 + T * s;
    return value;
  }

  /// x divided by D(s), factor by factor so that nothing overflows.
  Complex divide(Complex x, Complex s) const {
    for (int i = 0; i < integrators; ++i) x /= s;
    for (const double T : lags) x /= 1.0 + T * s;
    return x;
  }

  /// x divided by D(s) D(-s); z = -s^2.
  Complex divide_square(Complex x, Complex z) const {
    for (int i = 0; i < integrators; ++i) x /= z;
    for (const double T : lags) x /= 1.0 + T * T * z;
    return x;
  }
};

/// 1 - e^{-z}
Complex one_less_exp(Complex z) {
  const double x = -z.real(), y = -z.imag(), half = std::sin(0.5 * y);
  return {-std::expm1(x) * std::cos(y) + 2 * half * half, -std::exp(x) * std::sin(y)};
}

class NoiseIntegral {
 public:
  NoiseIntegral(const Loop& loop, double sampling) : open_(open_loop(loop)), Ts_(sampling) {
    const Setting& setting = loop.setting;
    plant_.integrators = integrators(loop.family.plant);
    const PlantLags lags = plant_lags(loop);
    plant_.lags.assign(static_cast<std::size_t>(lags.count), lags.time);
    controller_.integrators = has_integral_action(setting) ? 1 : 0;
    controller_.lags.assign(static_cast<std::size_t>(loop.family.n), setting.tau_f);
    numerator_ = controller_numerator(loop);
    squared_ = numerator_squared(open_);
    left_terms_ = static_cast<int>(std::floor(Ts_));
    turn_at_ = turning_frequency();
  }

  double value() const {
    const auto integrand = [this](int piece, double x) { return at(static_cast<Piece>(piece), x); };
    return adaptive_integral(panels(), integrand, kTolerance) / pi;
  }

 private:
  enum Piece : int { kAxis, kRight, kRightFar, kLeft, kLeftFar };

  /// W: no zero of 1 - L(s) L(-s) lies between the real axis and the turned paths, or near them.
  double turning_frequency() const {
    const Polynomial p = difference(squared_, denominator_squared(open_));
    double lowest = 1;
    for (const Complex& x : complex_roots(p)) {
      const Complex omega = std::sqrt(x);
      lowest = std::max(lowest, 1.3 * omega.real() - 1.5 * std::abs(omega.imag()));
    }
    for (const double crossover : gain_crossovers(open_)) lowest = std::max(lowest, 1.3 * crossover);
    return lowest;
  }

  std::vector<Panel> panels() const {
    std::vector<double> edges = axis_edges();
    std::vector<Panel> all;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      if (edges[i + 1] > edges[i]) all.push_back({kAxis, edges[i], edges[i + 1]});
    add_path(kRight, all);
    if (left_terms_ > 0) add_path(kLeft, all);
    return all;
  }

  /// A fraction of a turn of e^{-s} and e^{-s Ts} apart, finer where the loop is slow; and where |S| may have a
  /// peak, as narrow as it likes: its flanks show from there.
  std::vector<double> axis_edges() const {
    std::vector<double> edges{0};
    const double widest = std::min(4 / (1 + Ts_), turn_at_);
    for (double omega = slowest(); omega < widest; omega *= 4) edges.push_back(omega);
    for (double omega = widest; omega < turn_at_; omega += widest) edges.push_back(omega);
    for (const double omega : phase_crossovers(open_, turn_at_)) edges.push_back(omega);
    for (const double omega : gain_crossovers(open_)) edges.push_back(omega);
    edges.push_back(turn_at_);
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  double slowest() const {
    double omega = numerator_.size() > 1 && numerator_[1] > 0 ? std::min(1.0, numerator_[0] / numerator_[1]) : 1;
    for (const auto& lags : {plant_.lags, controller_.lags})
      for (const double T : lags) omega = std::min(omega, 1 / T);
    return 0.1 * omega;
  }

  double path_end() const { return 64 + 4 * turn_at_; }

  void add_path(Piece piece, std::vector<Panel>& all) const {
    double from = 0;
    for (double to = 1 / (1 + Ts_); from < path_end(); from = to, to = std::min(2 * to, path_end()))
      all.push_back({piece, from, to});
    all.push_back({piece + 1, 0, 1});
  }

  double at(Piece piece, double x) const {
    switch (piece) {
      case kAxis:
        return on_axis(x);
      case kRight:
        return on_right_path(x);
      case kRightFar:
        return on_right_path(path_end() / x) * path_end() / (x * x);
      case kLeft:
        return on_left_path(x);
      case kLeftFar:
        return on_left_path(path_end() / x) * path_end() / (x * x);
    }
    return kNaN;
  }

  double on_axis(double omega) const {
    const Complex s(0, omega), N = portrait::value(numerator_, s), D_plant = plant_.at(s);
    const Complex G = N * D_plant / (D_plant * controller_.at(s) + N * std::exp(-s));
    const double angle = 0.5 * omega * Ts_;
    const double hold = angle == 0 ? 1 : std::sin(angle) / angle;
    return std::norm(G) * Ts_ * hold * hold;
  }

  /// Everything that dies out to the right of the imaginary axis of s.
  double on_right_path(double p) const {
    const Complex direction = std::polar(1.0, -kTurn), omega = turn_at_ + p * direction, s = 1i * omega;
    const Complex L = rational(s), delayed = L * std::exp(-s), one_less = one_less_exp(s * Ts_);
    // T e^{s Ts}, less its first terms, which go to the left
    Complex rest = L * std::exp(-s * (left_terms_ + 1 - Ts_)) / (1.0 + delayed);
    for (int k = 0; k < left_terms_; ++k) rest *= -L;
    if (left_terms_ == 0) return weighed(omega, direction, 2.0 * one_less * (1.0 + rest * one_less));
    return weighed(omega, direction,
                   2.0 * one_less - 2.0 * delayed / (1.0 + delayed) * (1.0 + one_less) + 2.0 * rest);
  }

  /// e^{s Ts} (L - L^2 + L^3 ...), as many terms as grow to the right.
  double on_left_path(double p) const {
    const Complex direction = std::polar(1.0, kTurn), omega = turn_at_ + p * direction, s = 1i * omega;
    const Complex L = rational(s), turn = std::exp(s);
    Complex sum = 0, power = -1;
    for (int k = 1; k <= left_terms_; ++k) {
      power *= -L;
      sum = sum * turn + power;
    }
    return weighed(omega, direction, 2.0 * sum * std::exp(s * (Ts_ - left_terms_)));
  }

  /// |C Q|^2/(1 - |L|^2) continued, times `a`, over Ts omega^2.
  double weighed(Complex omega, Complex direction, Complex a) const {
    const Complex z = omega * omega;
    const Complex controller = controller_.divide_square(portrait::value(squared_, z), z);
    const Complex gain = plant_.divide_square(controller, z);
    return (direction * controller / (1.0 - gain) * a / (Ts_ * z)).real();
  }

  /// L without its dead time.
  Complex rational(Complex s) const {
    return plant_.divide(controller_.divide(portrait::value(numerator_, s), s), s);
  }

  OpenLoop open_;
  double Ts_;
  Factors plant_, controller_;
  Polynomial numerator_;
  Polynomial squared_;  ///< |N|^2 over omega^2
  int left_terms_ = 0;  ///< powers of e^{-s} that e^{s Ts} outgrows
  double turn_at_ = 0;  ///< W
};

}  // namespace

double noise_gain(const Loop& loop, double sampling) {
  PORTRAIT_CHECK(std::isfinite(sampling) && sampling > 0);
  if (loop.family.n == 0 && loop.setting.delta > 0) return kInf;
  return std::sqrt(NoiseIntegral(loop, sampling).value());
}

}  // namespace portrait
