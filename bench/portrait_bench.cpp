/// The program: proves every answer, then times everything in random order, then prints ratios.

#include <cstdio>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/codes.h"
#include "bench/flops.h"
#include "bench/report.h"
#include "engine/base/memory.h"
#include "engine/base/version.h"
#include "engine/sweep/sweep.h"

namespace portrait::bench {
namespace {

constexpr const char* kHelp = R"(Speed of the engine, in ratios to a plain step loop from the same run.

  portrait_bench
  portrait_bench --filter dipdt-pid/ --repetitions 25
  PORTRAIT_ISA=avx2 portrait_bench --json

What is measured and how to read it: bench/README.md.
)";

struct Arguments {
  std::string filter = ".", directory = ".";
  int repetitions = 11;
  bool smoke = false, json = false;
};

Effort effort_of(const Arguments& a) {
  if (a.smoke) return {.repetitions = 1, .seconds = 0, .sweep_settings = 32, .directory = a.directory};
  return {.repetitions = a.repetitions, .seconds = 0.1, .sweep_settings = 0, .directory = a.directory};
}

/// Google Benchmark takes this by the command line alone.
void interleave_repetitions() {
  std::string program = "portrait_bench", interleave = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {program.data(), interleave.data(), nullptr};
  int count = 2;
  benchmark::Initialize(&count, arguments);
}

Report prove_all(const std::vector<Case>& all, const Effort& effort) {
  Report report{.program = program_version(),
                .instruction_set = chosen_baseline().name,
                .sweep_method = method_text(Method::kernel),
                .repetitions = effort.repetitions,
                .threads = usual_threads(),
                .peaks = {},
                .cases = {}};
  for (const Baseline* baseline : available_baselines()) report.peaks.emplace_back(baseline->name);
  for (const Case& of : all) report.cases.push_back({of.name, prove_answers(of), flops_a_setting(of)});
  return report;
}

Results time_all(const std::vector<Case>& all, const Effort& effort, const std::string& filter) {
  interleave_repetitions();
  register_peaks(effort);
  for (const Case& of : all) register_rates(of, effort);
  register_sweeps(effort);
  Results results;
  Collector collector(results);
  if (benchmark::RunSpecifiedBenchmarks(&collector, filter) == 0)
    throw std::invalid_argument(fmt::format("--filter: no benchmark is called like \"{}\"", filter));
  return results;
}

void run(const Arguments& a) {
  const Effort effort = effort_of(a);
  const std::vector<Case> all = a.smoke ? few_of_each(cases()) : cases();
  const Report report = prove_all(all, effort);
  const Results results = time_all(all, effort, a.filter);
  const std::string text = a.json ? json(report, results).dump(2) + "\n" : table(report, results);
  std::fputs(text.c_str(), stdout);
}

}  // namespace
}  // namespace portrait::bench

int main(int argc, char** argv) {
  portrait::keep_freed_memory();
  portrait::bench::Arguments a;
  CLI::App app(portrait::bench::kHelp);
  app.add_option("--filter", a.filter, "regular expression of the benchmarks to run")->capture_default_str();
  app.add_option("--repetitions", a.repetitions)->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--directory", a.directory, "where a sweep stores its file for a while")
      ->capture_default_str()
      ->check(CLI::ExistingDirectory);
  app.add_flag("--smoke", a.smoke, "few settings, one repetition: proves that everything runs, times nothing");
  app.add_flag("--json", a.json, "one object");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    portrait::bench::run(a);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "portrait_bench: {}\n", failure.what());
    return 1;
  }
}
