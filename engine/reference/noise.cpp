#include "engine/reference/noise.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <unsupported/Eigen/FFT>

#include "engine/base/check.h"
#include "engine/loop/adaptive_integral.h"
#include "engine/measures/variation.h"

namespace portrait::reference {
namespace {

/// g_0 = h_0, g_j = h_j - h_(j-1)
std::vector<double> increments(std::vector<double> h) {
  for (std::size_t j = h.size(); j-- > 1;) h[j] -= h[j - 1];
  return h;
}

/// Smallest power of 2 not below n.
std::size_t power_of_two(std::size_t n) {
  std::size_t size = 1;
  while (size < n) size *= 2;
  return size;
}

using Spectrum = std::vector<std::complex<double>>;

Spectrum spectrum(std::vector<double> x, std::size_t size) {
  x.resize(size, 0.0);
  Eigen::FFT<double> fft;
  Spectrum X;
  fft.fwd(X, x);
  return X;
}

/// The first terms of the product of two power series.
std::vector<double> convolved(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t n = a.size(), size = power_of_two(2 * n);
  Spectrum A = spectrum(a, size);
  const Spectrum B = spectrum(b, size);
  for (std::size_t i = 0; i < A.size(); ++i) A[i] *= B[i];
  Eigen::FFT<double> fft;
  std::vector<double> found;
  fft.inv(found, A);
  found.resize(n);
  return found;
}

double mean_square(std::span<const double> x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return sum / static_cast<double>(x.size());
}

/// x(0-) = 0 and then the samples: what lies between two instants is not seen.
double measure_signal(std::vector<double> x, double at_rest, std::array<double, 9>& TVm) {
  x.insert(x.begin(), 0.0);
  for (int m = 0; m <= 8; ++m) TVm[static_cast<std::size_t>(m)] = std::max(0.0, shape_deviation(x, at_rest, m));
  return total_variation(x);
}

}  // namespace

Sampled sampled(const StepResponse& response, double sampling, std::size_t samples) {
  const Piece& last = response.pieces.back();
  const double end = last.start + last.length;
  Sampled found;
  std::size_t piece = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    // An instant that rounding puts just before an edge belongs to it.
    const double t = static_cast<double>(k) * sampling, later = t + 1e-9 * sampling;
    if (later >= end) {
      found.y.push_back(response.at_rest.y), found.u.push_back(response.at_rest.u);
      continue;
    }
    while (piece + 1 < response.pieces.size() && response.pieces[piece + 1].start <= later) ++piece;
    const Piece& at = response.pieces[piece];
    const double x = std::clamp(2 * (t - at.start) / at.length - 1, -1.0, 1.0);
    found.y.push_back(value(at.y, x)), found.u.push_back(value(at.u, x));
  }
  return found;
}

double noise_gain(const Response& response, double sampling) {
  const StepResponse& r = response.steps[kOutputStep];
  const double end = r.pieces.back().start + r.pieces.back().length;
  const auto h = [&](double t) { return t < 0 ? 0 : t >= end ? r.at_rest.u : u_at(r, t); };
  std::vector<double> edges;  // between them both terms are polynomials
  for (const Piece& piece : r.pieces) edges.insert(edges.end(), {piece.start, piece.start + sampling});
  edges.insert(edges.end(), {end, end + sampling});
  std::sort(edges.begin(), edges.end());
  std::vector<portrait::Panel> panels;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (edges[i + 1] - edges[i] > 1e-12 * end) panels.push_back({0, edges[i], edges[i + 1]});
  const auto pulse_squared = [&](int, double t) {
    const double pulse = h(t) - h(t - sampling);
    return pulse * pulse;
  };
  return std::sqrt(adaptive_integral(panels, pulse_squared, 1e-9) / sampling);
}

NoiseAnswer::NoiseAnswer(const Response& response, double sampling, double horizon) {
  PORTRAIT_CHECK(sampling > 0 && horizon / sampling < static_cast<double>(kMostSamples));
  PORTRAIT_CHECK(!response.steps[kOutputStep].pieces.empty());
  samples_ = samples_up_to(horizon, sampling);
  Sampled h = sampled(response.steps[kOutputStep], sampling, samples_);
  for (double& y : h.y) y -= 1;  // the measured output moves, the plant's own does not
  u_taps_ = increments(std::move(h.u));
  y_taps_ = increments(std::move(h.y));
}

double NoiseAnswer::sigma_ratio(const std::vector<double>& taps) {
  return std::sqrt(mean_square(taps) * static_cast<double>(taps.size()));
}

double NoiseAnswer::u_increment_ratio() const { return sigma_ratio(increments(u_taps_)); }

std::vector<double> NoiseAnswer::answer(const std::vector<double>& taps, const Noise& noise) const {
  std::vector<double> drawn(samples_);
  for (std::size_t k = 0; k < samples_; ++k) drawn[k] = noise_value(noise, k);
  return convolved(taps, drawn);
}

NoisyMeasures noisy_measures(const StepResponse& response, const NoiseAnswer& answer, const Noise& noise) {
  Sampled signals = sampled(response, noise.sampling, answer.samples());
  const std::vector<double> u_noise = answer.u(noise), y_noise = answer.y(noise);
  std::vector<double> drawn(answer.samples());
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    drawn[k] = noise_value(noise, k);
    signals.u[k] += u_noise[k], signals.y[k] += y_noise[k];
  }
  NoisyMeasures found;
  found.TV_u = measure_signal(std::move(signals.u), response.at_rest.u, found.TVm_u);
  found.TV_y = measure_signal(std::move(signals.y), response.at_rest.y, found.TVm_y);
  found.sigma_ratio = std::sqrt(mean_square(u_noise) / mean_square(drawn));
  return found;
}

namespace {

/// sigma of what noise adds to u over that of the noise, both of the second half of the instants.
double sigma_ratio_late(std::span<const double> u, const Noise& noise) {
  double of_u = 0, of_n = 0;
  for (std::size_t k = u.size() / 2; k < u.size(); ++k) {
    const double n = noise_value(noise, k);
    of_u += u[k] * u[k], of_n += n * n;
  }
  return std::sqrt(of_u / of_n);
}

/// TV, TV0, TV1, TV2.
void add_shapes(std::vector<double> x, std::span<const double> noise, double at_rest, std::vector<double>& to) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += noise[k];
  std::array<double, 9> TVm{};
  to.push_back(measure_signal(std::move(x), at_rest, TVm));
  to.insert(to.end(), TVm.begin(), TVm.begin() + 3);
}

}  // namespace

void measure_noise(const Loop& loop, const NoiseTrials& trials, double horizon, MeasureRow& row) {
  const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
  const NoiseAnswer answer(r, trials.noise.sampling, horizon);
  std::vector<std::vector<double>> found;  // by seed, in the order of the catalogue
  for (int i = 0; i < trials.seeds; ++i) {
    const Noise noise = trial(trials, i);
    const std::vector<double> u = answer.u(noise), y = answer.y(noise);
    std::vector<double>& values = found.emplace_back();
    for (const Step step : kUsualSteps) {
      Sampled s = sampled(r.steps[step], noise.sampling, answer.samples());
      add_shapes(std::move(s.y), y, r.steps[step].at_rest.y, values);
      add_shapes(std::move(s.u), u, r.steps[step].at_rest.u, values);
    }
    values.push_back(sigma_ratio_late(u, noise));
  }
  std::vector<double> over_seeds(found.size());
  for (std::size_t m = 0; m < found.front().size(); ++m) {
    for (std::size_t i = 0; i < found.size(); ++i) over_seeds[i] = found[i][m];
    const MeanAndSpread both = mean_and_spread(over_seeds);
    row[portrait::noisy_measures()[2 * m]] = both.mean, row[portrait::noisy_measures()[2 * m + 1]] = both.spread;
  }
  row[Measure::expected_sigma_ratio] = answer.u_sigma_ratio();
}

}  // namespace portrait::reference
