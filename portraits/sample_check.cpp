#include "portraits/sample_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <unordered_set>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/open_loop.h"
#include "engine/sweep/method.h"
#include "grids/sweep_job.h"

namespace portrait {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr double kAllowed = 1e-8, kAllowedOfVariation = 1e-7;
constexpr double kSmall = 1e-3;            ///< below it errors are absolute
constexpr double kSingle = 1.2e-7;         ///< two single numbers next to each other
constexpr double kFast = 1e-3;             ///< a time constant of the filter below which rounding shows
constexpr double kAtRest = 1e-5;           ///< a peak below this frequency is the value at rest
constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool is_place(Measure m) { return m == Measure::Ms_omega || m == Measure::Mt_omega; }

/// TV_uw of "TV2_uw" and "u_max_w". Integrals of the error, classes and properties of the loop are judged by themselves.
std::optional<Measure> variation_of_signal(Measure m) {
  std::string name(to_string(m));
  for (const std::string_view of_noise : {"noisy_", "spread_"})
    if (name.starts_with(of_noise)) return measure_named("noisy_TV_" + name.substr(name.rfind('_') + 1));
  if (name.starts_with("TV")) return measure_named("TV_" + name.substr(name.find('_') + 1));
  if (name.find("_max_") == std::string::npos) return std::nullopt;
  return measure_named("TV_" + name.substr(0, 1) + name.back());
}

/// |1/(1 + L)| or |L/(1 + L)|.
double height(const Loop& loop, Measure place, double omega) {
  const std::complex<double> L = response_at(open_loop(loop), omega);
  return (place == Measure::Ms_omega ? 1.0 : std::abs(L)) / std::abs(1.0 + L);
}

/// What rounding leaves of a signal that passes a fast filter: it is some 1e-16 delta/tau_f for each panel of it.
double resolution(const Loop& loop) { return loop.family.n == 0 ? 1 : std::min(1.0, loop.setting.tau_f / kFast); }

double relative(double a, double b) { return std::abs(a - b) / std::max(kSmall, std::abs(b)); }

double error_of_place(const Loop& loop, Measure m, double stored, double truth) {
  if (std::max(stored, truth) < kAtRest) return 0;
  if (!std::isfinite(stored) || !std::isfinite(truth)) return kInfinite;
  const double there = height(loop, m, truth), here = height(loop, m, stored);
  return std::min(relative(stored, truth), relative(here, there));
}

double error_of(const Loop& loop, Measure m, double stored, const MeasureRow& truth) {
  if (stored == truth[m] || (std::isnan(stored) && std::isnan(truth[m]))) return 0;
  if (is_place(m)) return error_of_place(loop, m, stored, truth[m]);
  const double off = std::abs(stored - truth[m]);
  if (!std::isfinite(off)) return kInfinite;
  const std::optional<Measure> variation = variation_of_signal(m);
  const double part_of = variation ? truth[*variation] : 0;
  return resolution(loop) * off / std::max({kSmall, part_of, std::abs(truth[m])});
}

/// What is stored of settings first, first + 1, ... of `numbers`.
struct Block {
  std::vector<std::uint64_t> numbers;
  std::vector<Status> statuses;
  std::vector<std::vector<double>> values;  ///< values[k][i] of measure k
  std::vector<SettingMeasured> truth;
};

Block stored_block(const ColumnSource& source, std::span<const std::uint64_t> numbers) {
  Block block{{numbers.begin(), numbers.end()}, {}, {}, std::vector<SettingMeasured>(numbers.size())};
  std::vector<Status> status;
  for (const std::uint64_t number : numbers) {
    source.read_statuses(number, 1, status);
    block.statuses.push_back(status[0]);
  }
  std::vector<double> value;
  for (const Measure measure : source.grid().measures) {
    std::vector<double>& column = block.values.emplace_back();
    for (const std::uint64_t number : numbers) {
      source.read(measure, number, 1, value);
      column.push_back(value[0]);
    }
  }
  return block;
}

void simulate(const Grid& grid, Block& block, const SampleRequest& request, std::uint64_t before) {
  const Extras extras = extras_for(grid);
  std::atomic<std::size_t> next = 0;
  const auto work = [&](bool tells) {
    for (std::size_t i = next++; i < block.numbers.size(); i = next++) {
      const Setting setting = setting_at(grid, block.numbers[i]);
      if (const auto why = why_invalid(Loop{grid.family, setting}))
        throw IntegrityError(fmt::format("setting {} of the portrait is no loop: {}", block.numbers[i], *why));
      measure_settings(Method::reference, grid.family, grid.horizon, extras, {&setting, 1},
                       {&block.truth[i], 1});
      if (tells && request.progress) request.progress(before + i);
    }
  };
  const std::size_t threads = request.threads > 0 ? static_cast<std::size_t>(request.threads)
                                                  : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::future<void>> others;
  while (others.size() + 1 < std::min(threads, block.numbers.size()))
    others.push_back(std::async(std::launch::async, work, false));
  work(true);
  for (std::future<void>& other : others) other.get();
}

void compare(const Grid& grid, const Block& block, SampleReport& report) {
  for (std::size_t i = 0; i < block.numbers.size(); ++i) {
    const std::uint64_t number = block.numbers[i];
    const SettingMeasured& truth = block.truth[i];
    bool failed = block.statuses[i] != truth.status;
    if (failed && report.statuses.size() < kMostMismatches)
      report.statuses.push_back({number, block.statuses[i], truth.status});
    const Loop loop{grid.family, setting_at(grid, number)};
    for (std::size_t k = 0; k < report.measures.size(); ++k) {
      MeasureCheck& check = report.measures[k];
      const double stored = block.values[k][i], error = error_of(loop, check.measure, stored, truth.measures);
      if (error > check.worst) {
        check.worst = error, check.where = number;
        check.stored = stored, check.truth = truth.measures[check.measure];
      }
      if (error <= check.allowed) continue;
      ++check.failed;
      failed = true;
    }
    report.failed += failed ? 1 : 0;
  }
}

}  // namespace

/// Floyd's algorithm: each set of `count` numbers is as likely as any other.
std::vector<std::uint64_t> random_settings(std::uint64_t total, std::uint64_t count, std::uint64_t seed) {
  count = std::min(count, total);
  std::mt19937_64 random(seed);
  std::unordered_set<std::uint64_t> chosen;
  for (std::uint64_t last = total - count; last < total; ++last) {
    const std::uint64_t number = random() % (last + 1);  // settings are far below 2^64: no number is favoured visibly
    chosen.insert(chosen.contains(number) ? last : number);
  }
  std::vector<std::uint64_t> numbers(chosen.begin(), chosen.end());
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

SampleReport check_sample(const ColumnSource& source, const SampleRequest& request) {
  const Grid& grid = source.grid();
  const std::vector<std::uint64_t> numbers =
      random_settings(setting_count(grid), request.settings, request.seed);
  SampleReport report{.settings = numbers.size(), .failed = 0, .measures = {}, .statuses = {}};
  const double rounding = grid.precision == Precision::real32 ? kSingle : 0;
  for (const Measure measure : grid.measures)
    report.measures.push_back(
        {.measure = measure, .allowed = (variation_of_signal(measure) ? kAllowedOfVariation : kAllowed) + rounding});
  for (std::size_t done = 0; done < numbers.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, numbers.size() - done);
    Block block = stored_block(source, std::span(numbers).subspan(done, count));
    simulate(grid, block, request, done);
    compare(grid, block, report);
  }
  return report;
}

}  // namespace portrait
