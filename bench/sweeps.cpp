#include <chrono>
#include <memory>
#include <system_error>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.h"
#include "engine/base/check.h"
#include "grids/sweep_job.h"
#include "portraits/writer.h"

namespace portrait::bench {
namespace {

using Prepare = TileQueue::Prepare;

void run_sweep(const Grid& grid, int threads, const Prepare& prepare) {
  const Tiling tiling(grid);
  SweepJob job = sweep_job(grid, tiling, threads);
  job.prepare = prepare;
  PORTRAIT_CHECK(sweep(job).complete);
}

void sweep_to_nowhere(const Grid& grid, int threads) {
  run_sweep(grid, threads, [](std::uint64_t, const MeasureColumns&) { return [] {}; });
}

/// The file as `portrait sweep` writes it: digests, checks and its name included.
void sweep_to_file(const Grid& grid, int threads, const std::filesystem::path& path) {
  PortraitWriter writer(path, grid, {"portrait_bench", method_text(Method::kernel)}, Existing::replace);
  run_sweep(grid, threads, [&](std::uint64_t tile, const MeasureColumns& columns) {
    return [&writer, encoded = std::make_shared<EncodedTile>(writer.encode(tile, columns))] {
      writer.write(std::move(*encoded));
    };
  });
  writer.publish({0, threads});
}

/// A file of that name in the directory while this lives.
class FileForAWhile {
 public:
  explicit FileForAWhile(const std::filesystem::path& directory) : path_(directory / "portrait_bench.h5") {}
  FileForAWhile(const FileForAWhile&) = delete;
  FileForAWhile& operator=(const FileForAWhile&) = delete;
  ~FileForAWhile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A sweep so long that threads and files do not count by their beginnings.
std::uint64_t settings_for(double seconds) {
  const Grid trial = sweep_grid(8192);
  const auto begin = std::chrono::steady_clock::now();
  sweep_to_nowhere(trial, 1);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return static_cast<std::uint64_t>(static_cast<double>(setting_count(trial)) * seconds / took.count());
}

/// `run` gives back what is to be tidied up when the clock has stopped: removing a large file takes its time.
template <typename Run>
void register_sweep(const char* name, const std::shared_ptr<const Grid>& grid, const Effort& effort, Run run) {
  const auto time = [grid, run](benchmark::State& state) {
    for (auto _ : state) {
      auto left = run(*grid);
      state.PauseTiming();
      left.reset();
      state.ResumeTiming();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(setting_count(*grid)));
  };
  benchmark::RegisterBenchmark(name, time)->UseRealTime()->Iterations(1)->Repetitions(effort.repetitions);
}

}  // namespace

void register_sweeps(const Effort& effort) {
  // Storing has a beginning and an end of its own, of some hundredths of a second: a sweep worth storing is longer.
  constexpr std::uint64_t kStoredSweeps = 8;
  using Left = std::unique_ptr<FileForAWhile>;
  const std::uint64_t count = effort.sweep_settings > 0 ? effort.sweep_settings : settings_for(0.5);
  const auto grid = std::make_shared<const Grid>(sweep_grid(count));
  const auto long_grid = std::make_shared<const Grid>(sweep_grid(kStoredSweeps * count));
  const int threads = usual_threads();
  const auto alone = [](int with) {
    return [with](const Grid& g) -> Left {
      sweep_to_nowhere(g, with);
      return nullptr;
    };
  };
  register_sweep("scaling/one", grid, effort, alone(1));
  register_sweep("scaling/all", grid, effort, alone(threads));
  register_sweep("store/nowhere", long_grid, effort, alone(threads));
  register_sweep("store/file", long_grid, effort, [threads, directory = effort.directory](const Grid& g) -> Left {
    auto file = std::make_unique<FileForAWhile>(directory);
    sweep_to_file(g, threads, file->path());
    return file;
  });
}

}  // namespace portrait::bench
