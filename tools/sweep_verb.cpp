/// portrait sweep: the arguments, and the dry run. The run itself: tools/sweep_to_file.cpp.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/sweep/sweep.h"
#include "grids/grid_file.h"
#include "grids/sweep_job.h"
#include "grids/tiling.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/run_state.h"
#include "tools/shard_argument.h"
#include "tools/sweep_to_file.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait sweep grids/catalog/huba2022-43.toml -o huba.h5
  portrait sweep finer.toml --extend huba.h5 -o finer.h5

Simulates every setting of a grid file (its format: grids/README.md) and stores the measures
in a portrait. The file appears under its name only when it is complete and checked. Until then
the sweep works in FILE.h5.run: stopped by Ctrl-C, by a signal of a cluster or by anything worse,
it goes on with --resume. With --extend only settings that an earlier portrait lacks are
simulated; the result is the same to the bit. A grid for many machines is cut with --shard I/N;
in an array of Slurm, under srun and under mpirun each process takes its own shard by itself.
docs/cluster.md says more.)";

// ---------------------------------------------------------------- dry run

/// Seconds a setting takes on one thread: settings spread evenly over the grid, for about half a second.
double seconds_a_setting(const Grid& grid, Method method) {
  using Clock = std::chrono::steady_clock;
  const std::size_t at_a_time = method == Method::kernel ? TileQueue::kSliceSettings : 1;  // as a sweep does
  const Extras extras = extras_for(grid);
  const std::uint64_t count = setting_count(grid), samples = std::min<std::uint64_t>(count, 4096);
  const auto begin = Clock::now();
  std::uint64_t done = 0;
  double seconds = 0;
  while (done < samples && seconds < 0.5) {
    // 97 is a step through the samples in an order that visits all parts of the grid early.
    std::vector<Setting> settings;
    for (; settings.size() < at_a_time && done < samples; ++done)
      settings.push_back(setting_at(grid, count / samples * (done * 97 % samples)));
    std::vector<SettingMeasured> measured(settings.size());
    measure_settings(method, grid.family, grid.horizon, extras, settings, measured);
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return seconds / static_cast<double>(done);
}

double bytes_of(const Grid& grid) {
  const double value = grid.precision == Precision::real64 ? 8 : 4;
  return static_cast<double>(setting_count(grid)) * (value * static_cast<double>(grid.measures.size()) + 1);
}

std::string size_text(double bytes) {
  const char* units[] = {"B", "KB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

int dry_run(const SweepArguments& a, const Grid& grid, const Tiling& tiling, int threads,
            const EarlierPortrait* earlier) {
  const std::uint64_t settings = setting_count(grid), reused = earlier != nullptr ? earlier->reused() : 0;
  const double seconds = seconds_a_setting(grid, a.method) * static_cast<double>(settings - reused) / threads;
  if (a.json) {
    print_json({{"dry_run", true},
                {"settings", settings},
                {"settings_reused", reused},
                {"tiles", tiling.tile_count()},
                {"threads", threads},
                {"estimated_seconds", seconds},
                {"largest_bytes", bytes_of(grid)}});
    return kDone;
  }
  const std::string taken = reused > 0 ? fmt::format("{} of them taken from {}\n", grouped(reused), a.extend) : "";
  print_text(
      fmt::format("{} settings in {} tiles, {} measures each\n{}about {} on {} threads, at most {} on disk\n",
                  grouped(settings), grouped(tiling.tile_count()), grid.measures.size(), taken,
                  duration_text(seconds), threads, size_text(bytes_of(grid))));
  return kDone;
}

/// The portrait that is to be extended; nothing when none is.
std::unique_ptr<EarlierPortrait> earlier_portrait(const SweepArguments& a, const Grid& grid) {
  if (a.extend.empty()) return nullptr;
  if (run_folder_meant(a.extend))
    throw InputError(fmt::format("{} is a sweep that was stopped: finish it first, with --resume", a.extend));
  std::error_code neither_is_there;
  if (!a.output.empty() && std::filesystem::equivalent(a.output, a.extend, neither_is_there))
    throw InputError(fmt::format("{} stays as it is: give the larger portrait another name with -o", a.extend));
  return std::make_unique<EarlierPortrait>(a.extend, grid, method_text(a.method));
}

int run(SweepArguments& a, const std::string& method, const Invocation& invocation) {
  a.method = method_argument("--method", method);
  const Grid grid = read_grid(a.grid);
  const Tiling tiling(grid);
  const int threads = a.threads > 0 ? a.threads : usual_threads();
  if (const auto reason = why_not_measured(a.method, grid.measures)) throw InputError(a.grid + ": " + *reason);
  const std::unique_ptr<EarlierPortrait> earlier = earlier_portrait(a, grid);
  if (a.dry_run) return dry_run(a, grid, tiling, threads, earlier.get());
  if (a.output.empty()) throw InputError("-o FILE.h5 is missing: where shall the portrait go?");
  const Shard shard = a.shard.empty() ? shard_from(this_environment()) : shard_argument(a.shard);
  return sweep_to_file(a, invocation.command_line, grid, shard, threads, earlier.get());
}

}  // namespace

void add_sweep(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<SweepArguments>();
  auto method = std::make_shared<std::string>(to_string(Method::kernel));
  CLI::App* verb = add_verb(app, "sweep", "simulate every setting of a grid into a portrait", kHelp);
  verb->add_option("grid", a->grid, "grid file")->required();
  verb->add_option("-o,--output", a->output, "portrait file to write");
  verb->add_option("--extend", a->extend, "an earlier portrait: settings that it has are taken from it");
  verb->add_option("--threads", a->threads, "threads (default: all)")->check(CLI::Range(1, 4096));
  verb->add_option("--method", *method, "kernel, or reference, slow, for every measure")->capture_default_str();
  verb->add_flag("--dry-run", a->dry_run, "only say how many settings, how long and how large");
  verb->add_flag("--force", a->force, "replace an existing portrait, throw a stopped sweep away");
  verb->add_flag("--resume", a->resume, "go on with a sweep that was stopped, or begin it");
  verb->add_option("--shard", a->shard, "I/N: compute part I of N alone (default: from Slurm or MPI, else 1/1)");
  verb->add_flag("--quiet", a->quiet, "no progress, no summary");
  verb->add_flag("--json", a->json, "the summary as one JSON object");
  verb->callback([a, method, &invocation] { invocation.exit_code = run(*a, *method, invocation); });
}

}  // namespace portrait::tools
