#include <algorithm>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.h"
#include "bench/codes.h"

namespace portrait::bench {
namespace {

/// The scalar loop is slow: it gets these few, from all over the case.
constexpr std::size_t kScalarSettings = 16;

std::vector<Setting> every_nth(const std::vector<Setting>& settings, std::size_t count) {
  std::vector<Setting> chosen;
  const std::size_t kept = std::min(count, settings.size());
  for (std::size_t i = 0; i < kept; ++i) chosen.push_back(settings[i * settings.size() / kept]);
  return chosen;
}

void repeat(benchmark::internal::Benchmark* registered, const Effort& effort) {
  registered->Repetitions(effort.repetitions);
  if (effort.seconds > 0)
    registered->MinTime(effort.seconds);
  else
    registered->Iterations(1);
}

std::int64_t items(const benchmark::State& state, std::size_t settings) {
  return state.iterations() * static_cast<std::int64_t>(settings);
}

void register_engine(const Case& of, const Effort& effort) {
  repeat(benchmark::RegisterBenchmark((of.name + "/engine").c_str(),
                                      [&of](benchmark::State& state) {
                                        MeasureColumns columns(timed_measures(), of.settings.size());
                                        for (auto _ : state) run_engine(of, of.settings, columns);
                                        state.SetItemsProcessed(items(state, of.settings.size()));
                                      }),
         effort);
}

void register_responses(const Case& of, const Effort& effort) {
  repeat(benchmark::RegisterBenchmark((of.name + "/responses").c_str(),
                                      [&of](benchmark::State& state) {
                                        std::vector<kernel::Measured> measured(of.settings.size());
                                        for (auto _ : state) run_responses(of, of.settings, measured);
                                        state.SetItemsProcessed(items(state, of.settings.size()));
                                      }),
         effort);
}

void register_margins(const Case& of, const Effort& effort) {
  repeat(benchmark::RegisterBenchmark((of.name + "/margins").c_str(),
                                      [&of](benchmark::State& state) {
                                        std::vector<kernel::LoopMargins> found(of.settings.size());
                                        for (auto _ : state) run_margins(of, of.settings, found);
                                        state.SetItemsProcessed(items(state, of.settings.size()));
                                      }),
         effort);
}

void register_step_loop(StepCode code, const char* name, const Case& of, std::vector<Setting> settings,
                        const Effort& effort) {
  const auto time = [&of, code, plain = for_step_loop(settings)](benchmark::State& state) {
    std::vector<BothSteps> results(plain.size());
    for (auto _ : state) run_step_loop(code, of, plain, results);
    state.SetItemsProcessed(items(state, plain.size()));
  };
  repeat(benchmark::RegisterBenchmark((of.name + "/" + name).c_str(), time), effort);
}

}  // namespace

void register_peaks(const Effort& effort) {
  for (const Baseline* baseline : available_baselines()) {
    const auto time = [baseline](benchmark::State& state) {
      double operations = 0;
      for (auto _ : state) operations += baseline->multiply_and_add(100'000);
      state.SetItemsProcessed(static_cast<std::int64_t>(operations));
    };
    repeat(benchmark::RegisterBenchmark(("peak/" + std::string(baseline->name)).c_str(), time), effort);
  }
}

void register_rates(const Case& of, const Effort& effort) {
  register_engine(of, effort);
  register_responses(of, effort);
  register_margins(of, effort);
  register_step_loop(StepCode::batched, "batched", of, of.settings, effort);
  register_step_loop(StepCode::scalar, "scalar", of, every_nth(of.settings, kScalarSettings), effort);
}

}  // namespace portrait::bench
