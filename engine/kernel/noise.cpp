#include "engine/kernel/noise.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/base/check.h"
#include "engine/loop/steady_state.h"

namespace portrait::kernel {
namespace {

int power_of_two(int n) {
  int size = 1;
  while (size < n) size *= 2;
  return size;
}

/// In place, as NoiseSeries::transform of engine/kernel/noise.inl.
void transform(std::span<std::complex<double>> x, const std::vector<double>& turns) {
  const std::size_t size = x.size();
  for (std::size_t half = size / 2; half > 0; half /= 2)
    for (std::size_t first = 0; first < size; first += 2 * half)
      for (std::size_t j = 0; j < half; ++j) {
        const std::size_t i = j * (size / 2 / half);
        const std::complex<double> a = x[first + j], b = x[first + j + half];
        x[first + j] = a + b;
        x[first + j + half] = std::complex(turns[2 * i], turns[2 * i + 1]) * (a - b);
      }
}

/// So many settings at a time that their samples stay within some megabytes.
constexpr std::size_t kSamplesAtOnce = 200'000;
/// Responses of more settings fill packs better.
constexpr std::size_t kMostSettingsAtOnce = 128;

std::size_t settings_at_once(const Implementation& implementation, const DrawnNoise& noise) {
  const std::size_t fit = kSamplesAtOnce / static_cast<std::size_t>(noise.samples());
  return std::clamp(fit, static_cast<std::size_t>(implementation.lanes), kMostSettingsAtOnce);
}

/// What noise passes: the loop without prefilter.
LoopFamily without_prefilter(LoopFamily family) {
  family.prefilter = Prefilter::none;
  return family;
}

class NoiseMeasurement {
 public:
  NoiseMeasurement(const Implementation& implementation, const LoopFamily& family, const DrawnNoise& noise)
      : implementation_(implementation), family_(family), noise_(noise) {
    const auto samples = static_cast<std::size_t>(noise.samples()), size = static_cast<std::size_t>(noise.size());
    for (std::vector<double>* rows : {&loop_y_, &loop_u_, &y_w_, &u_w_, &y_d_, &u_d_})
      rows->resize(samples * kMaxLanes);
    work_.resize(4 * size * kMaxLanes);
    trials_.resize(static_cast<std::size_t>(noise.trials().seeds));
  }

  void run(std::span<const Setting> settings, std::span<Measured> results) {
    const Horizon horizon = Horizon::fixed(noise_.horizon());
    const auto sampled = [&] {
      return SampledResponses(noise_.trials().noise.sampling, static_cast<std::size_t>(noise_.samples()),
                              settings.size());
    };
    SampledResponses own = sampled();
    measure_responses(implementation_, family_, settings, horizon, results, &own);
    if (family_.prefilter == Prefilter::none) return run_packs(settings, own, own, results);
    SampledResponses loop = sampled();
    std::vector<Measured> of_loop(settings.size());
    measure_responses(implementation_, without_prefilter(family_), settings, horizon, of_loop, &loop);
    for (std::size_t i = 0; i < settings.size(); ++i)
      results[i].resolved = results[i].resolved && of_loop[i].resolved;
    run_packs(settings, own, loop, results);
  }

 private:
  void run_packs(std::span<const Setting> settings, const SampledResponses& own, const SampledResponses& loop,
                 std::span<Measured> results) {
    const auto lanes = static_cast<std::size_t>(implementation_.lanes);
    std::vector<std::size_t> resolved;
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (results[i].resolved) resolved.push_back(i);
    for (std::span<const std::size_t> left = resolved; !left.empty();
         left = left.subspan(std::min(lanes, left.size())))
      run_pack(settings, left.first(std::min(lanes, left.size())), own, loop, results);
  }

  void run_pack(std::span<const Setting> settings, std::span<const std::size_t> which, const SampledResponses& own,
                const SampledResponses& loop, std::span<Measured> results) {
    NoisePack pack = pack_of_rows();
    for (std::size_t lane = 0; lane < kMaxLanes; ++lane) {
      const std::size_t i = which[std::min(lane, which.size() - 1)];
      fill_lane(pack, lane, {family_, settings[i]});
      fill_rows(lane, i, own, loop);
    }
    NoiseResult result;
    result.trials = trials_.data();
    implementation_.run_noise(pack, result);
    for (std::size_t lane = 0; lane < which.size(); ++lane) take(result, lane, results[which[lane]].measures);
  }

  NoisePack pack_of_rows() {
    NoisePack pack{};
    pack.samples = noise_.samples(), pack.size = noise_.size(), pack.seeds = noise_.trials().seeds;
    pack.loop_y = loop_y_.data(), pack.loop_u = loop_u_.data();
    pack.y_w = y_w_.data(), pack.u_w = u_w_.data(), pack.y_d = y_d_.data(), pack.u_d = u_d_.data();
    pack.turns = noise_.turns().data(), pack.spectra = noise_.spectra().data(), pack.work = work_.data();
    return pack;
  }

  static void fill_lane(NoisePack& pack, std::size_t lane, const Loop& loop) {
    const SteadyState w = rest_after_setpoint_step(loop), d = rest_after_disturbance_step(loop);
    pack.y_rest_w[lane] = w.y, pack.u_rest_w[lane] = w.u;
    pack.y_rest_d[lane] = d.y, pack.u_rest_d[lane] = d.u;
  }

  void fill_rows(std::size_t lane, std::size_t setting, const SampledResponses& own, const SampledResponses& loop) {
    const auto fill = [&](std::vector<double>& rows, std::span<const double> signal) {
      for (std::size_t k = 0; k < signal.size(); ++k) rows[k * kMaxLanes + lane] = signal[k];
    };
    fill(loop_y_, loop.of(setting, SampledResponses::kYw)), fill(loop_u_, loop.of(setting, SampledResponses::kUw));
    fill(y_w_, own.of(setting, SampledResponses::kYw)), fill(u_w_, own.of(setting, SampledResponses::kUw));
    fill(y_d_, own.of(setting, SampledResponses::kYd)), fill(u_d_, own.of(setting, SampledResponses::kUd));
  }

  /// Means and spreads stand in the catalogue one after the other.
  void take(const NoiseResult& result, std::size_t lane, MeasureRow& row) const {
    std::vector<double> values(trials_.size());
    std::size_t place = 0;
    const auto store = [&] {
      const MeanAndSpread found = mean_and_spread(values);
      row[noisy_measures()[place++]] = found.mean;
      row[noisy_measures()[place++]] = found.spread;
    };
    for (std::size_t shape = 0; shape < std::size(trials_[0].shapes); ++shape) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = trials_[i].shapes[shape][lane];
      store();
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::sqrt(trials_[i].u_squares[lane] / noise_.squares()[i]);
    store();
    row[Measure::expected_sigma_ratio] = result.expected[lane];
  }

  const Implementation& implementation_;
  LoopFamily family_;
  const DrawnNoise& noise_;
  std::vector<double> loop_y_, loop_u_, y_w_, u_w_, y_d_, u_d_, work_;
  std::vector<NoiseTrial> trials_;
};

}  // namespace

DrawnNoise::DrawnNoise(const NoiseTrials& trials, double horizon) : trials_(trials), horizon_(horizon) {
  PORTRAIT_CHECK(trials.seeds >= 1 && trials.noise.sampling > 0 && horizon > 0);
  const std::size_t samples = samples_up_to(horizon, trials.noise.sampling);
  PORTRAIT_CHECK(samples <= kMostNoiseSamples &&
                 samples * static_cast<std::size_t>(trials.seeds) <= kMostNoiseValues);
  samples_ = static_cast<int>(samples);
  size_ = power_of_two(2 * samples_ - 1);
  for (int i = 0; i < size_ / 2; ++i) {
    const double angle = 2 * std::numbers::pi * i / size_;
    turns_.insert(turns_.end(), {std::cos(angle), -std::sin(angle)});
  }
  for (int seed = 0; seed < trials.seeds; ++seed) draw(seed);
}

void DrawnNoise::draw(int seed) {
  const Noise noise = trial(trials_, seed);
  std::vector<std::complex<double>> values(static_cast<std::size_t>(size_));
  double squares = 0;
  for (int k = 0; k < samples_; ++k) {
    const double n = noise_value(noise, static_cast<std::uint64_t>(k));
    values[static_cast<std::size_t>(k)] = n;
    if (k >= samples_ / 2) squares += n * n;
  }
  transform(values, turns_);
  for (const std::complex<double> z : values) spectra_.insert(spectra_.end(), {z.real() / size_, z.imag() / size_});
  squares_.push_back(squares);
}

void measure_under_noise(const Implementation& implementation, const LoopFamily& family,
                         std::span<const Setting> settings, const DrawnNoise& noise, std::span<Measured> results) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  NoiseMeasurement measurement(implementation, family, noise);
  const std::size_t most = settings_at_once(implementation, noise);
  for (std::size_t first = 0; first < settings.size(); first += most) {
    const std::size_t count = std::min(most, settings.size() - first);
    measurement.run(settings.subspan(first, count), results.subspan(first, count));
  }
}

}  // namespace portrait::kernel
