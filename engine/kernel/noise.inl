/// Loops under held noise, a lane each: what engine/reference/noise.h defines, from sampled responses.
///
///     u_k = u(k Ts) + sum_j g_j n_(k-j)          g_0 = h(0),  g_j = h(j Ts) - h((j-1) Ts)
///
/// h, the response to a step of the measured output, is that to a step of the setpoint without prefilter, times -1. Both
/// convolutions, of u and of y, are one complex Fourier transform: g_u + i g_y in, u + i y out. Decimation in frequency on
/// the way in and in time on the way out: the spectra stay in the order that this leaves, and nothing is sorted.
#pragma once

#include "engine/kernel/complex.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

/// Complex values, lane beside lane.
class NoiseSeries {
 public:
  NoiseSeries(double* values, int size, const double* turns) : values_(values), size_(size), turns_(turns) {}

  Complex get(int i) const { return {Lanes::from(at(i)), Lanes::from(at(i) + kernel::kMaxLanes)}; }
  void set(int i, Complex z) { z.re.to(at(i)), z.im.to(at(i) + kernel::kMaxLanes); }

  void transform() {
    for (int half = size_ / 2; half > 0; half /= 2)
      for (int first = 0; first < size_; first += 2 * half)
        for (int j = 0; j < half; ++j) {
          const Complex a = get(first + j), b = get(first + j + half);
          set(first + j, a + b);
          set(first + j + half, turn(j * (size_ / 2 / half), 1) * (a + -b));
        }
  }

  /// Back, times `size`.
  void transform_back() {
    for (int half = 1; half < size_; half *= 2)
      for (int first = 0; first < size_; first += 2 * half)
        for (int j = 0; j < half; ++j) {
          const Complex a = get(first + j), b = turn(j * (size_ / 2 / half), -1) * get(first + j + half);
          set(first + j, a + b);
          set(first + j + half, a + -b);
        }
  }

 private:
  double* at(int i) const { return values_ + static_cast<long>(i) * 2 * kernel::kMaxLanes; }
  Complex turn(int i, double direction) const { return {Lanes(turns_[2 * i]), Lanes(direction * turns_[2 * i + 1])}; }

  double* values_;
  int size_;
  const double* turns_;
};

/// TV, TV0, TV1 and TV2 of a signal that is known at instants: engine/measures/variation.h.
class SampledShape {
 public:
  explicit SampledShape(Lanes rest) : rest_(rest), shape1_(abs(rest)), shape2_(abs(rest)) {}

  void take(Lanes x) {
    variation_ += abs(x - last_);
    last_ = x;
    const Mask above = x > rest_, below = x < rest_, pulse = above | below;
    const Lanes to_rest = abs(x - rest_), first = abs(x), second = select(above, below_ + x, above_ - x);
    shape1_ = select(pulse, max(shape1_, first + to_rest), shape1_);
    shape2_ = select(pulse, max(shape2_, max(first, second) + to_rest), shape2_);
    above_ = select(above, max(above_, first + x), above_);
    below_ = select(below, max(below_, first - x), below_);
  }

  void store(kernel::PackColumn* to) const {
    variation_.to(to[0]);
    deviation(abs(rest_)).to(to[1]);
    deviation(max(shape1_, abs(rest_))).to(to[2]);
    deviation(max(shape2_, abs(rest_))).to(to[3]);
  }

 private:
  Lanes deviation(Lanes shape) const { return max(Lanes(0.0), variation_ + abs(rest_ - last_) - shape); }

  Lanes rest_, shape1_, shape2_;
  Lanes last_ = 0.0, variation_ = 0.0, above_ = -1e300, below_ = -1e300;
};

inline Lanes lanes_at(const double* rows, int i) {
  return Lanes::from(rows + static_cast<long>(i) * kernel::kMaxLanes);
}

/// g_u + i g_y and zeros behind; sum g_u^2 into `expected`.
inline void set_taps(const kernel::NoisePack& pack, NoiseSeries& taps, kernel::NoiseResult& result) {
  Complex last = {Lanes(0.0), Lanes(0.0)};
  Lanes squares = 0.0;
  for (int i = 0; i < pack.samples; ++i) {
    const Complex h = {-lanes_at(pack.loop_u, i), -lanes_at(pack.loop_y, i)};
    const Complex g = h + -last;
    taps.set(i, g);
    squares = mul_add(g.re, g.re, squares);
    last = h;
  }
  for (int i = pack.samples; i < pack.size; ++i) taps.set(i, {Lanes(0.0), Lanes(0.0)});
  sqrt(squares).to(result.expected);
}

/// What the noise of one seed does.
inline void convolve(const kernel::NoisePack& pack, const double* spectrum, const NoiseSeries& taps, NoiseSeries& to) {
  for (int i = 0; i < pack.size; ++i)
    to.set(i, taps.get(i) * Complex{Lanes(spectrum[2 * i]), Lanes(spectrum[2 * i + 1])});
  to.transform_back();
}

inline void measure_trial(const kernel::NoisePack& pack, const NoiseSeries& noise, kernel::NoiseTrial& trial) {
  SampledShape y_w(Lanes::from(pack.y_rest_w)), u_w(Lanes::from(pack.u_rest_w));
  SampledShape y_d(Lanes::from(pack.y_rest_d)), u_d(Lanes::from(pack.u_rest_d));
  Lanes squares = 0.0;
  for (int i = 0; i < pack.samples; ++i) {
    const Complex n = noise.get(i);
    y_w.take(lanes_at(pack.y_w, i) + n.im), u_w.take(lanes_at(pack.u_w, i) + n.re);
    y_d.take(lanes_at(pack.y_d, i) + n.im), u_d.take(lanes_at(pack.u_d, i) + n.re);
    if (i >= pack.samples / 2) squares = mul_add(n.re, n.re, squares);
  }
  y_w.store(trial.shapes), u_w.store(trial.shapes + 4);
  y_d.store(trial.shapes + 8), u_d.store(trial.shapes + 12);
  squares.to(trial.u_squares);
}

inline void run_noise(const kernel::NoisePack& pack, kernel::NoiseResult& result) {
  NoiseSeries taps(pack.work, pack.size, pack.turns);
  NoiseSeries noise(pack.work + static_cast<long>(pack.size) * 2 * kernel::kMaxLanes, pack.size, pack.turns);
  set_taps(pack, taps, result);
  taps.transform();
  for (int seed = 0; seed < pack.seeds; ++seed) {
    convolve(pack, pack.spectra + static_cast<long>(seed) * 2 * pack.size, taps, noise);
    measure_trial(pack, noise, result.trials[seed]);
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
