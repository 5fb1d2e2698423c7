#include "tests/engine/loop/root_count.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace portrait {
namespace {

using Real = long double;
using Complex = std::complex<Real>;
using Coefficients = std::vector<Real>;  ///< from the lowest power up

struct Valued {
  Complex value, slope;
};

Valued horner(const Coefficients& p, Complex s) {
  Valued sum{0, 0};
  for (auto a = p.rbegin(); a != p.rend(); ++a) {
    sum.slope = sum.slope * s + sum.value;
    sum.value = sum.value * s + *a;
  }
  return sum;
}

void multiply_by_lag(Coefficients& p, Real T) {
  p.push_back(0);
  for (std::size_t i = p.size() - 1; i > 0; --i) p[i] += T * p[i - 1];
}

/// f, and what is needed to know when N no longer matters.
class Characteristic {
 public:
  explicit Characteristic(const Loop& loop) {
    const Setting& s = loop.setting;
    const bool integral = std::isfinite(s.tau_i);
    if (integral) N_.push_back(Real{s.kappa} / s.tau_i);
    N_.push_back(s.kappa);
    N_.push_back(s.delta);
    D_.assign(static_cast<std::size_t>(integrators(loop.family.plant) + (integral ? 1 : 0)), 0);
    D_.push_back(1);
    if (loop.family.plant == Plant::fotd) multiply_by_lag(D_, s.tau_1);
    for (int i = 0; i < loop.family.n; ++i) multiply_by_lag(D_, s.tau_f);
  }

  explicit Characteristic(const GeneralLoop& loop) : Td_(loop.plant.dead_time), any_roots_(true) {
    const Polynomial N = product(loop.plant.rational.numerator, loop.controller.on_output);
    const Polynomial D =
        product(written_out(loop.plant.rational.denominator), written_out(loop.controller.denominator));
    N_.assign(N.begin(), N.end()), D_.assign(D.begin(), D.end());
  }

  Valued operator()(Complex s) const {
    const Valued N = horner(N_, s), D = horner(D_, s);
    const Complex delay = std::exp(-Td_ * s);
    return {D.value + N.value * delay, D.slope + (N.slope - Td_ * N.value) * delay};
  }

  /// No root lies further out in the right half-plane: |D(s)| >= |D(j|s|)| does not hold, but |D(s)| >= |s|^k and
  /// |1 + T s| >= max(1, T |s|) do, and |N| is at most the sum of its terms.
  Real radius() const {
    Real R = 1;
    while (!dominated_beyond(R)) R *= Real{1.25};
    return R;
  }

 private:
  /// The bound of |N/D| falls with |s| once it is below 1 at the highest powers.
  bool dominated_beyond(Real R) const {
    Real n = 0, power = 1;
    for (const Real a : N_) n += std::abs(a) * power, power *= R;
    const std::size_t last = D_.size() - 1;
    power = 1;
    for (std::size_t i = 0; i < last && any_roots_; ++i) n += std::abs(D_[i]) * power, power *= R;
    return n < Real{0.999999} * std::abs(D_[last]) * std::pow(R, static_cast<Real>(last));
  }

  Coefficients N_, D_;
  Real Td_ = 1;
  bool any_roots_ = false;  ///< then |D(s)| >= |d_n| |s|^n - |d_(n-1)| |s|^(n-1) - ... is all that is known
};

class Walk {
 public:
  explicit Walk(const Characteristic& f) : f_(f) {}

  /// Change of arg f along a smooth path s(t), t from 0 to 1, |ds/dt| = speed.
  template <typename Path>
  Real along(Path path, Real speed) const {
    Real t = 0, turned = 0, step = 1;
    Valued here = f_(path(0));
    while (t < 1) {
      const Real reach = std::abs(here.value) / (std::abs(here.slope) * speed);
      step = std::min({Real{0.2L} * reach, kLongest / speed, 1 - t});
      Valued next = f_(path(t + step));
      while (std::abs(next.value - here.value) > Real{0.25L} * std::abs(here.value)) {
        step /= 2;
        next = f_(path(t + step));
      }
      turned += std::arg(next.value / here.value);
      here = next;
      t = 1 - t <= step ? 1 : t + step;
    }
    return turned;
  }

 private:
  static constexpr Real kLongest = 0.1L;  ///< e^{-s} turns by no more
  const Characteristic& f_;
};

}  // namespace

namespace {

int counted(const Characteristic& f) {
  const Walk walk(f);
  const Real R = f.radius();
  const Real up = walk.along([R](Real t) { return Complex(0, R * t); }, R);
  const Real quarter = std::numbers::pi_v<Real> / 2;
  const Real back = walk.along([=](Real t) { return std::polar(R, quarter * (1 - t)); }, quarter * R);
  // The whole contour runs against the clock: down the axis, and back from -jR over R to jR.
  return static_cast<int>(std::lround(-(up + back) / std::numbers::pi_v<Real>));
}

}  // namespace

int unstable_roots_by_contour(const Loop& loop) { return counted(Characteristic(loop)); }
int unstable_roots_by_contour(const GeneralLoop& loop) { return counted(Characteristic(loop)); }

}  // namespace portrait
