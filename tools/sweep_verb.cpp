/// portrait sweep: grid file -> grid -> tiles of measures -> portrait file. The whole flow in one page.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/status.h"
#include "engine/sweep/sweep.h"
#include "grids/grid_file.h"
#include "grids/tiling.h"
#include "portraits/writer.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait sweep grids/catalog/huba2022-43.toml -o huba.h5

Simulates every setting of a grid file (its format: grids/README.md) and stores the measures
in a portrait. The file appears under its name only when it is complete and checked; Ctrl-C
ends cleanly and leaves nothing behind.)";

struct SweepArguments {
  std::string grid, output, method = "kernel";
  int threads = 0;
  bool dry_run = false, force = false, quiet = false, json = false;
};

Method method_of(const SweepArguments& a) { return method_argument("--method", a.method); }

/// How many settings came out how.
struct Tally {
  std::array<std::uint64_t, kStatusNames.size()> count{};

  void add(const MeasureColumns& columns) {
    for (const Status status : columns.status) ++count[static_cast<std::size_t>(status)];
  }
  std::uint64_t operator[](Status status) const { return count[static_cast<std::size_t>(status)]; }
};

SweepJob job_for(const Grid& grid, const Tiling& tiling, int threads, Method method) {
  SweepJob job;
  job.family = grid.family;
  job.horizon = grid.horizon;
  job.sampling = grid.sampling;
  job.method = method;
  job.measures = grid.measures;
  job.tile_count = tiling.tile_count();
  job.threads = threads;
  job.settings_of = [&](std::uint64_t tile) { return settings_in(grid, tiling.box(tile)); };
  return job;
}

// ---------------------------------------------------------------- dry run

/// Seconds a setting takes on one thread: settings spread evenly over the grid, for about half a second.
double seconds_a_setting(const Grid& grid, Method method) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kAtATime = TileQueue::kSliceSettings;  // as a sweep does
  const std::uint64_t count = setting_count(grid), samples = std::min<std::uint64_t>(count, 4096);
  const auto begin = Clock::now();
  std::uint64_t done = 0;
  double seconds = 0;
  while (done < samples && seconds < 0.5) {
    // 97 is a step through the samples in an order that visits all parts of the grid early.
    std::vector<Setting> settings;
    for (; settings.size() < kAtATime && done < samples; ++done)
      settings.push_back(setting_at(grid, count / samples * (done * 97 % samples)));
    std::vector<SettingMeasured> measured(settings.size());
    measure_settings(method, grid.family, grid.horizon, grid.sampling, settings, measured);
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

int dry_run(const SweepArguments& a, const Grid& grid, const Tiling& tiling, int threads) {
  const std::uint64_t settings = setting_count(grid);
  const double seconds = seconds_a_setting(grid, method_of(a)) * static_cast<double>(settings) / threads;
  if (a.json) {
    print_json({{"dry_run", true},
                {"settings", settings},
                {"tiles", tiling.tile_count()},
                {"threads", threads},
                {"estimated_seconds", seconds},
                {"largest_bytes", bytes_of(grid)}});
    return kDone;
  }
  print_text(fmt::format("{} settings in {} tiles, {} measures each\nabout {} on {} threads, at most {} on disk\n",
                         grouped(settings), grouped(tiling.tile_count()), grid.measures.size(),
                         duration_text(seconds), threads, size_text(bytes_of(grid))));
  return kDone;
}

// ---------------------------------------------------------------- the run itself

/// What a run killed earlier has left beside the target: nobody but the user may know that it is not in use.
void mention_leftovers(const std::filesystem::path& target) {
  const std::string prefix = target.filename().string() + ".tmp-";
  const auto directory = target.parent_path().empty() ? std::filesystem::path(".") : target.parent_path();
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (entry.path().filename().string().starts_with(prefix))
      print_message(
          fmt::format("note: {} is of a run that was killed, or of one that still runs", entry.path().string()));
}

int report(const SweepArguments& a, const SweepOutcome& outcome, const Tally& tally) {
  const double rate = static_cast<double>(outcome.settings_measured) / outcome.seconds;
  if (a.json) {
    print_json({{"settings", outcome.settings_measured},
                {"settled", tally[Status::settled]},
                {"not_settled", tally[Status::not_settled]},
                {"unstable", tally[Status::unstable]},
                {"seconds", outcome.seconds},
                {"settings_per_second", rate},
                {"threads", outcome.threads},
                {"settings_by_reference", outcome.settings_by_reference},
                {"method", method_text(method_of(a))},
                {"file", a.output}});
    return kDone;
  }
  if (a.quiet) return kDone;
  print_message(fmt::format("{} settings in {} on {} threads, {} settings/s", grouped(outcome.settings_measured),
                            duration_text(outcome.seconds), outcome.threads,
                            grouped(static_cast<std::uint64_t>(rate))));
  print_message(fmt::format("{} settled, {} not settled at the horizon, {} unstable",
                            grouped(tally[Status::settled]), grouped(tally[Status::not_settled]),
                            grouped(tally[Status::unstable])));
  if (outcome.settings_by_reference > 0 && method_of(a) == Method::kernel)
    print_message(
        fmt::format("{} settings, too stiff for the kernel's panels, were measured by the reference method",
                    grouped(outcome.settings_by_reference)));
  print_message(fmt::format("portrait written to {}", a.output));
  return kDone;
}

int stopped(const SweepOutcome& outcome, std::uint64_t settings) {
  print_message(fmt::format("stopped after {} of {} settings; no file was written",
                            grouped(outcome.settings_measured), grouped(settings)));
  return kStopped;
}

int sweep_to_file(const SweepArguments& a, const Invocation& invocation, const Grid& grid, SweepJob job) {
  const std::filesystem::path output(a.output);
  mention_leftovers(output);
  InterruptGuard interrupt;
  PortraitWriter writer(output, grid, {invocation.command_line, method_text(job.method)},
                        a.force ? Existing::replace : Existing::refuse);
  interrupt.remove_on_second(writer.temporary_path().string());
  Tally tally;
  Progress progress(setting_count(grid), Progress::usual_style(a.quiet));
  job.prepare = [&](std::uint64_t tile, const MeasureColumns& columns) -> StoreStep {
    return [&, encoded = std::make_shared<EncodedTile>(writer.encode(tile, columns))] {
      writer.write(*encoded);
      tally.add(columns);
    };
  };
  job.progress = [&](std::uint64_t done) { progress.update(done); };
  job.stop = &interrupt.requested();

  const SweepOutcome outcome = sweep(job);
  progress.finish();
  if (!outcome.complete) return stopped(outcome, setting_count(grid));
  writer.publish({.wall_seconds = outcome.seconds, .threads = outcome.threads});
  return report(a, outcome, tally);
}

int run(const SweepArguments& a, const Invocation& invocation) {
  const Grid grid = read_grid(a.grid);
  const Tiling tiling(grid);
  const int threads = a.threads > 0 ? a.threads : usual_threads();
  if (const auto reason = why_not_measured(method_of(a), grid.measures)) throw InputError(a.grid + ": " + *reason);
  if (a.dry_run) return dry_run(a, grid, tiling, threads);
  if (a.output.empty()) throw InputError("-o FILE.h5 is missing: where shall the portrait go?");
  return sweep_to_file(a, invocation, grid, job_for(grid, tiling, threads, method_of(a)));
}

}  // namespace

void add_sweep(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<SweepArguments>();
  CLI::App* verb = add_verb(app, "sweep", "simulate every setting of a grid into a portrait", kHelp);
  verb->add_option("grid", a->grid, "grid file")->required();
  verb->add_option("-o,--output", a->output, "portrait file to write");
  verb->add_option("--threads", a->threads, "threads (default: all)")->check(CLI::Range(1, 4096));
  verb->add_option("--method", a->method, "kernel, or reference, slow, for every measure")->capture_default_str();
  verb->add_flag("--dry-run", a->dry_run, "only say how many settings, how long and how large");
  verb->add_flag("--force", a->force, "replace an existing portrait");
  verb->add_flag("--quiet", a->quiet, "no progress, no summary");
  verb->add_flag("--json", a->json, "the summary as one JSON object");
  verb->callback([a, &invocation] { invocation.exit_code = run(*a, invocation); });
}

}  // namespace portrait::tools
