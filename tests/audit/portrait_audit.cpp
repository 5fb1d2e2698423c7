/// portrait_audit --loops N --seed S [--first I] [--threads T] [--json]
///
/// Draws loops of all families and measures each by the kernel, by the reference and by independent means
/// (tests/audit/independent.h). Prints how the errors of the first two against the third are distributed, and the worst of each
/// kind as a command that simulates it. A loop has its own seed, so --first I --loops 1 draws loop I alone. SIGINT or SIGTERM ends it
/// early, with the report of the loops that are done: --first goes on behind them.
///
/// exit code  0; 1 when an error is above what the kernel promises, a status differs, or a loop is found stable that is not
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/loop/parameters.h"
#include "engine/sweep/method.h"
#include "tests/audit/comparison.h"
#include "tests/audit/error_table.h"
#include "tests/audit/independent.h"
#include "tests/oracle/random_cascades.h"

namespace portrait::audit {
namespace {

struct Arguments {
  std::uint64_t loops = 1000, seed = 1, first = 0;
  int threads = 0;
  bool json = false;
};

constexpr std::size_t kFamilies = kFamilyNames.size();
constexpr std::size_t kMostTold = 20;

struct Report {
  std::array<std::array<std::array<Errors, kKinds>, kMethods>, kFamilies> errors;
  std::uint64_t loops = 0, unstable = 0, by_reference = 0;
  double seconds = 0;
  std::vector<std::string> findings;
  std::uint64_t findings_in_all = 0;

  void find(const std::string& text) {
    ++findings_in_all;
    if (findings.size() < kMostTold) findings.push_back(text);
  }
};

// ---------------------------------------------------------------- one loop

/// Of the basic families as often as of the others. tau_f from 0.01, as the kernel promises.
Loop drawn(oracle::Random& random) {
  if (random.chance(0.4)) return oracle::random_cascade(random);
  while (true) {
    const Loop loop = oracle::random_stable_loop(random);
    if (loop.family.n == 0 || loop.setting.tau_f >= 0.01) return loop;
  }
}

/// The same with another gain, stable or not.
Loop with_another_gain(oracle::Random& random, Loop loop) {
  const double factor = random.log_uniform(0.05, 20);
  loop.setting.kappa *= factor, loop.setting.delta *= factor;
  for (double& gain : loop.setting.gains) gain *= factor;
  return loop;
}

// ---------------------------------------------------------------- many loops

void add_loop(Report& report, std::uint64_t number, const Loop& loop, int dead_times, LoopErrors& e) {
  const std::string command = fmt::format("{} --horizon {}", simulate_command(loop), dead_times);
  ++report.loops;
  report.by_reference += e.measured[0].resolved ? 0 : 1;
  for (std::size_t method = 0; method < kMethods; ++method) {
    const std::string said = fmt::format("{} --method {}", command, kMethodNames[method]);
    if (e.measured[method].status != e.truth.status)
      report.find(fmt::format("loop {}: {} and is {}: {}", number, to_string(e.measured[method].status),
                              to_string(e.truth.status), said));
    for (std::size_t k = 0; k < kKinds; ++k) {
      Worst& worst = e.worst[method][k];
      worst.number = number, worst.command = said;
      report.errors[family_of(loop)][method][k].take(worst);
      if (worst.error > kAllowed[k])
        report.find(fmt::format("loop {}: {} = {:.12g} is off by {:.1e} ({:.12g}): {}", number, to_string(worst.measure),
                                worst.found, worst.error, worst.truth, said));
    }
  }
}

/// Stable or not, by all three.
void check_stability(Report& report, std::mutex& mutex, oracle::Random& random, const Loop& stable) {
  const Loop loop = with_another_gain(random, stable);
  if (why_invalid(loop)) return;
  std::array<bool, kMethods> says{};
  for (std::size_t method = 0; method < kMethods; ++method) {
    SettingMeasured measured;
    measure_settings(static_cast<Method>(method), loop.family, Horizon::fixed(1), {}, {&loop.setting, 1}, {&measured, 1});
    says[method] = measured.status != Status::unstable;
  }
  const bool is_stable = is_stable_by_contour(loop);
  const std::lock_guard lock(mutex);
  report.unstable += is_stable ? 0 : 1;
  for (std::size_t method = 0; method < kMethods; ++method)
    if (says[method] != is_stable)
      report.find(fmt::format("stability is {} by contour, not by {}: {}", is_stable, kMethodNames[method], simulate_command(loop)));
}

volatile std::sig_atomic_t ended = 0;

/// On a terminal, ten times over the whole in a file.
void show_progress(std::uint64_t begun, std::uint64_t loops, double seconds) {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  if (begun % (terminal ? 1000 : std::max<std::uint64_t>(loops / 10, 1)) == 0 && begun > 0)
    fmt::print(stderr, "{}{} of {} loops begun, {:.0f} s{}", terminal ? "\r" : "", begun, loops, seconds,
               terminal ? " " : "\n");
}

Report audit(const Arguments& a) {
  Report report;
  std::mutex mutex;
  std::atomic<std::uint64_t> next = 0;
  const auto began = std::chrono::steady_clock::now();
  const auto seconds = [began] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  const auto work = [&] {
    for (std::uint64_t i = next++; i < a.loops && ended == 0; i = next++) {
      show_progress(i, a.loops, seconds());
      oracle::Random random((a.seed << 40) + a.first + i);
      const Loop loop = drawn(random);
      const int dead_times = 10 + random.below(40);
      LoopErrors e = audited(loop, dead_times);
      {
        const std::lock_guard lock(mutex);
        add_loop(report, a.first + i, loop, dead_times, e);
      }
      check_stability(report, mutex, random, loop);
    }
  };
  const int threads = a.threads > 0 ? a.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  others.clear();
  report.seconds = seconds();
  for (auto& family : report.errors)
    for (auto& method : family)
      for (Errors& errors : method) std::sort(errors.largest.begin(), errors.largest.end());
  return report;
}

// ---------------------------------------------------------------- output

void print_table(const Report& report, const Arguments& a) {
  fmt::print(
      "{} stable loops of {} asked, seed {}, from {} on, {:.0f} s; {}; {} were left to the reference by the "
      "kernel\n",
      report.loops, a.loops, a.seed, a.first, report.seconds, method_text(Method::kernel), report.by_reference);
  fmt::print("as many with another gain, of which {} are unstable, by all three\n\n", report.unstable);
  fmt::print("{:<10} {:>7}  {:<10} {:<10} {:>9} {:>9} {:>9} {:>9}\n", "family", "loops", "measures", "method", "half", "99 %", "worst",
             "promised");
  for (std::size_t f = 0; f < kFamilies; ++f)
    for (std::size_t k = 0; k < kKinds; ++k)
      for (std::size_t method = 0; method < kMethods; ++method) {
        const Errors& e = report.errors[f][method][k];
        if (e.largest.empty()) continue;
        fmt::print("{:<10} {:>7}  {:<10} {:<10} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.0e}\n", kFamilyNames[f], e.largest.size(), kKindNames[k],
                   kMethodNames[method], e.quantile(0.5), e.quantile(0.99), e.worst.error, kAllowed[k]);
      }
  fmt::print("\nthe worst of the kernel\n");
  for (std::size_t f = 0; f < kFamilies; ++f)
    for (std::size_t k = 0; k < kKinds; ++k)
      if (const Worst& w = report.errors[f][0][k].worst; !w.command.empty())
        fmt::print("  {:.1e}  {} = {:.12g}, is {:.12g}, loop {}: {}\n", w.error, to_string(w.measure), w.found, w.truth, w.number, w.command);
  for (const std::string& finding : report.findings) fmt::print("WRONG {}\n", finding);
  if (report.findings_in_all > report.findings.size())
    fmt::print("WRONG and {} more\n", report.findings_in_all - report.findings.size());
}

void print_json(const Report& report, const Arguments& a) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (std::size_t f = 0; f < kFamilies; ++f)
    for (std::size_t k = 0; k < kKinds; ++k)
      for (std::size_t method = 0; method < kMethods; ++method) {
        const Errors& e = report.errors[f][method][k];
        if (e.largest.empty()) continue;
        rows.push_back({{"family", kFamilyNames[f]}, {"loops", e.largest.size()}, {"measures", kKindNames[k]},
                        {"method", kMethodNames[method]}, {"half", e.quantile(0.5)}, {"99 %", e.quantile(0.99)},
                        {"worst", e.worst.error}, {"promised", kAllowed[k]}, {"measure", to_string(e.worst.measure)},
                        {"loop", e.worst.number}, {"command", e.worst.command}});
      }
  fmt::print("{}\n", Json({{"loops", report.loops}, {"seed", a.seed}, {"first", a.first}, {"unstable", report.unstable},
                           {"by_reference", report.by_reference}, {"seconds", report.seconds}, {"rows", rows},
                           {"findings", report.findings_in_all}, {"told", report.findings}}).dump(2));
}

int run(int count, char** words) {
  Arguments a;
  CLI::App app("Kernel, reference and independent means on random loops of all families.", "portrait_audit");
  app.add_option("--loops", a.loops, "how many")->capture_default_str()->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
  app.add_option("--seed", a.seed, "of all loops")->capture_default_str()->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 20));
  app.add_option("--first", a.first, "number of the first loop")->capture_default_str()->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 32));
  app.add_option("--threads", a.threads, "default: all")->check(CLI::Range(1, 4096));
  app.add_flag("--json", a.json, "one JSON object");
  CLI11_PARSE(app, count, words);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { ended = 1; });
  const Report report = audit(a);
  a.json ? print_json(report, a) : print_table(report, a);
  return report.findings_in_all == 0 ? 0 : 1;
}

}  // namespace
}  // namespace portrait::audit

int main(int count, char** words) {
  try {
    return portrait::audit::run(count, words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "portrait_audit: {}\n", error.what());
    return 1;
  }
}
