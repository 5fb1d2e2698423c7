/// family_rate [REPETITIONS]
///
/// What a sweep of many lags under a controller given by its gains is worth against the plain step loop that anyone would
/// write for it: jotd of order 3, controllers of K_-1 .. K_3 with the filter of order 3, tau_f = 0.1, horizon 51, 2,400
/// settings, both steps and all measures but noise_gain; then without margins. The plain loop takes 200 steps a dead time
/// (with 50 its many lags add up to a delay that moves IAE by more than 10 %), lags by their exact exponential, and leaves
/// margins and shapes out: it gives IAE and TV. Its answers are compared first, to 5 %.
///
/// And what a sweep under noise is: dipdt, PID, n = 1, five seeds, a value held over 0.1 dead times, TV of u at the instants; the plain
/// loop runs every seed and step anew. One thread; medians of interleaved repetitions.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "engine/sweep/method.h"
#include "grids/grid_file.h"

namespace portrait {
namespace {

constexpr const char* kGrid = R"(plant = "jotd"
j = 3
n = 3
horizon = 51
[parameters]
K_-1 = { from = 0.4, to = 0.5, count = 10 }
K_0 = { from = 1.3, to = 1.6, count = 10 }
K_1 = { from = 1.4, to = 1.7, count = 6 }
K_2 = { from = 0.5, to = 0.65, count = 4 }
K_3 = 0.01
tau_j = 1
tau_f = 0.1
)";

constexpr const char* kNoisyGrid = R"(plant = "dipdt"
n = 1
prefilter = "none"
horizon = 51
sampling = 0.1
noise = 0.02
seeds = 5
[parameters]
kappa = { from = 0.08, to = 0.14, count = 8 }
tau_i = { from = 12, to = 20, count = 8 }
delta = { from = 0.45, to = 0.55, count = 4 }
tau_f = 0.2
)";

constexpr int kSteps = 200, kOrder = 3;

struct Plain {
  double IAE = 0, TV_u = 0, TV_y = 0;
};

/// One response: w or d is 1. `delayed` holds one dead time of outputs.
Plain plain_response(const Setting& s, double w, double d, double horizon, std::array<double, kSteps>& delayed) {
  const double h = 1.0 / kSteps, filter = -std::expm1(-h / s.tau_f), lag = -std::expm1(-h / s.tau_j);
  std::array<double, kOrder> v{}, z{};
  delayed.fill(0);
  double integral = 0, u_before = 0, y_before = 0;
  Plain found;
  const int steps = static_cast<int>(std::lround(horizon * kSteps));
  for (int i = 0; i < steps; ++i) {
    const double y = delayed[static_cast<std::size_t>(i % kSteps)], e = w - y;
    // s^k F^m e by differences of the filter's lags
    std::array<double, kOrder + 1> g{e, v[0], v[1], v[2]};
    double u = s.gains[0] * integral + s.gains[1] * v[kOrder - 1];
    for (int k = 1; k <= kOrder; ++k) {
      for (int l = kOrder; l >= k; --l)
        g[static_cast<std::size_t>(l)] =
            (g[static_cast<std::size_t>(l) - 1] - g[static_cast<std::size_t>(l)]) / s.tau_f;
      u += s.gains[static_cast<std::size_t>(k) + 1] * g[kOrder];
    }
    integral += h * v[kOrder - 1];
    for (int l = kOrder; l-- > 0;) {
      const auto at = static_cast<std::size_t>(l);
      v[at] += filter * ((l == 0 ? e : v[at - 1]) - v[at]);
      z[at] += lag * ((l == 0 ? u + d : z[at - 1]) - z[at]);
    }
    delayed[static_cast<std::size_t>(i % kSteps)] = z[kOrder - 1];
    found.IAE += h * std::abs(e);
    found.TV_u += std::abs(u - u_before), found.TV_y += std::abs(y - y_before);
    u_before = u, y_before = y;
  }
  return found;
}

std::array<Plain, 2> plain(const Setting& s, double horizon) {
  std::array<double, kSteps> delayed;
  return {plain_response(s, 1, 0, horizon, delayed), plain_response(s, 0, 1, horizon, delayed)};
}

/// TV of u at the instants of one noisy response of dipdt under a filtered PID. `delayed` as above.
double plain_noisy_variation(const Setting& s, double w, double d, double horizon, const Noise& noise,
                             std::array<double, kSteps>& delayed) {
  const double h = 1.0 / kSteps, filter = -std::expm1(-h / s.tau_f);
  const int held = static_cast<int>(std::lround(noise.sampling * kSteps));
  const int steps = static_cast<int>(std::lround(horizon * kSteps));
  delayed.fill(0);
  double v = 0, integral = 0, z = 0, z1 = 0, n = 0, before = 0, variation = 0;
  for (int i = 0; i <= steps; ++i) {
    if (i % held == 0) n = noise_value(noise, static_cast<std::uint64_t>(i / held));
    const double e = w - (delayed[static_cast<std::size_t>(i % kSteps)] + n);
    const double u = s.kappa * v + s.kappa / s.tau_i * integral + s.delta * (e - v) / s.tau_f;
    if (i % held == 0) variation += std::abs(u - before), before = u;
    integral += h * v;
    v += filter * (e - v);
    z += h * z1 + 0.5 * h * h * (u + d);
    z1 += h * (u + d);
    delayed[static_cast<std::size_t>(i % kSteps)] = z;
  }
  return variation;
}

struct NoisyBench {
  Grid grid = parse_grid(kNoisyGrid, "family_rate");
  Extras extras{.noise = std::make_shared<const kernel::DrawnNoise>(*grid.noise, grid.horizon.dead_times)};
  std::vector<Setting> settings;
  std::vector<SettingMeasured> measured;
  std::vector<std::array<double, 2>> plainly;

  NoisyBench() : measured(setting_count(grid)), plainly(setting_count(grid)) {
    for (std::uint64_t i = 0; i < setting_count(grid); ++i) settings.push_back(setting_at(grid, i));
  }
  void by_engine() { measure_settings(Method::kernel, grid.family, grid.horizon, extras, settings, measured); }
  void by_plain_loop() {
    std::array<double, kSteps> delayed;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      plainly[i] = {0, 0};
      for (int seed = 0; seed < grid.noise->seeds; ++seed)
        for (const int of_d : {0, 1})
          plainly[i][static_cast<std::size_t>(of_d)] +=
              plain_noisy_variation(settings[i], 1 - of_d, of_d, grid.horizon.dead_times, trial(*grid.noise, seed),
                                    delayed) /
              grid.noise->seeds;
    }
  }

  /// The largest difference of the mean TV, as a part.
  double difference() const {
    double worst = 0;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const MeasureRow& m = measured[i].measures;
      if (method_of(measured[i]) != Method::kernel || std::isnan(m[Measure::noisy_TV_uw]))
        throw std::runtime_error("a noisy setting is unstable, or was left to the reference");
      worst = std::max({worst, std::abs(plainly[i][0] / m[Measure::noisy_TV_uw] - 1),
                        std::abs(plainly[i][1] / m[Measure::noisy_TV_ud] - 1)});
    }
    return worst;
  }
};

struct Bench {
  Grid grid = parse_grid(kGrid, "family_rate");
  std::vector<Setting> settings;
  std::vector<SettingMeasured> measured;
  std::vector<std::array<Plain, 2>> plainly;

  Bench() : measured(setting_count(grid)), plainly(setting_count(grid)) {
    for (std::uint64_t i = 0; i < setting_count(grid); ++i) settings.push_back(setting_at(grid, i));
  }
  void by_engine(bool margins) {
    measure_settings(Method::kernel, grid.family, grid.horizon, {.margins = margins}, settings, measured);
  }
  void by_plain_loop() {
    for (std::size_t i = 0; i < settings.size(); ++i) plainly[i] = plain(settings[i], grid.horizon.dead_times);
  }

  /// The largest difference of IAE and TV, as a part.
  double difference() const {
    double worst = 0;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const MeasureRow& m = measured[i].measures;
      if (measured[i].status != Status::settled || method_of(measured[i]) != Method::kernel)
        throw std::runtime_error("a setting is not settled, or was left to the reference");
      const auto compare = [&](double mine, double theirs) {
        worst = std::max(worst, std::abs(mine / theirs - 1));
      };
      compare(plainly[i][0].IAE, m[Measure::IAE_w]), compare(plainly[i][1].IAE, m[Measure::IAE_d]);
      compare(plainly[i][0].TV_y, m[Measure::TV_yw]), compare(plainly[i][1].TV_y, m[Measure::TV_yd]);
      compare(plainly[i][1].TV_u, m[Measure::TV_ud]);
    }
    return worst;
  }
};

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void run(int repetitions) {
  Bench bench;
  bench.by_engine(true);
  bench.by_plain_loop();
  const double difference = bench.difference();
  if (difference > 0.05) throw std::runtime_error(fmt::format("the plain loop differs by {:.3g}", difference));
  std::vector<double> engine, responses, loop;
  for (int i = 0; i < repetitions; ++i) {
    engine.push_back(seconds([&] { bench.by_engine(true); }));
    responses.push_back(seconds([&] { bench.by_engine(false); }));
    loop.push_back(seconds([&] { bench.by_plain_loop(); }));
  }
  const auto count = static_cast<double>(bench.settings.size());
  fmt::print("{} settings of jotd 3 under K_-1 .. K_3, n = 3, horizon 51, one thread, {} repetitions\n",
             bench.settings.size(), repetitions);
  fmt::print("  {:<28} {:>10.0f} settings/s\n", method_text(Method::kernel), count / median(engine));
  fmt::print("  {:<28} {:>10.0f} settings/s\n", "  without margins", count / median(responses));
  fmt::print("  {:<28} {:>10.0f} settings/s, differs by {:.2g}\n", "plain loop, 200 steps", count / median(loop),
             difference);
  fmt::print("  ratio {:.2f}, without margins {:.2f}\n", median(loop) / median(engine),
             median(loop) / median(responses));
}

void run_noisy(int repetitions) {
  NoisyBench bench;
  bench.by_engine();
  bench.by_plain_loop();
  const double difference = bench.difference();
  if (difference > 0.05)
    throw std::runtime_error(fmt::format("the plain noisy loop differs by {:.3g}", difference));
  std::vector<double> engine, loop;
  for (int i = 0; i < repetitions; ++i) {
    engine.push_back(seconds([&] { bench.by_engine(); }));
    loop.push_back(seconds([&] { bench.by_plain_loop(); }));
  }
  const auto count = static_cast<double>(bench.settings.size());
  fmt::print("{} settings of dipdt under a PID, n = 1, horizon 51, under noise held over 0.1, {} seeds\n",
             bench.settings.size(), bench.grid.noise->seeds);
  fmt::print("  {:<28} {:>10.0f} settings/s\n", method_text(Method::kernel), count / median(engine));
  fmt::print("  {:<28} {:>10.0f} settings/s, differs by {:.2g}\n", "plain loop, 200 steps", count / median(loop),
             difference);
  fmt::print("  ratio {:.2f}\n", median(loop) / median(engine));
}

}  // namespace
}  // namespace portrait

int main(int count, char** arguments) {
  try {
    const int repetitions = count > 1 ? std::max(1, std::atoi(arguments[1])) : 11;
    portrait::run(repetitions);
    portrait::run_noisy(repetitions);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "family_rate: {}\n", failure.what());
    return 1;
  }
}
