#include "tools/sweep_to_file.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/status.h"
#include "grids/sweep_job.h"
#include "portraits/reader.h"
#include "portraits/run_writer.h"
#include "tools/exit_codes.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/progress.h"

namespace portrait::tools {
namespace {

/// How many settings came out how.
struct Tally {
  StatusCounts count{};

  /// `of_tile`: how often each code occurs, as a tile's summary of its status.
  void add(const std::vector<double>& of_tile) {
    for (std::size_t code = 0; code < count.size(); ++code) count[code] += static_cast<std::uint64_t>(of_tile[code]);
  }
  std::uint64_t operator[](Status status) const { return count[static_cast<std::size_t>(status)]; }
};

/// Settings of these tiles, and how many of them an earlier portrait has.
struct Work {
  std::uint64_t settings = 0, reused = 0;
  std::uint64_t to_measure() const { return settings - reused; }
};

Work work_in(const Tiling& tiling, const std::vector<std::uint64_t>& tiles, const EarlierPortrait* earlier) {
  Work work;
  for (const std::uint64_t tile : tiles) {
    const Box box = tiling.box(tile);
    work.settings += box.size();
    if (earlier != nullptr) work.reused += earlier->reused_in(box);
  }
  return work;
}

std::string resume_command(const std::string& command_line) {
  const bool has = command_line.find(" --resume") != std::string::npos;
  return command_line + (has ? "" : " --resume");
}

// ---------------------------------------------------------------- what is said in the end

int report(const SweepArguments& a, const Grid& grid, const Shard& shard, const SweepOutcome& outcome,
           const Tally& tally, const Work& work) {
  const double rate = outcome.seconds > 0 ? static_cast<double>(outcome.settings_measured) / outcome.seconds : 0;
  const bool whole = shard.count == 1;
  if (a.json) {
    Json json = {{"settings", setting_count(grid)},
                 {"settings_measured", outcome.settings_measured},
                 {"settings_reused", work.reused},
                 {"settled", tally[Status::settled]},
                 {"not_settled", tally[Status::not_settled]},
                 {"unstable", tally[Status::unstable]},
                 {"seconds", outcome.seconds},
                 {"settings_per_second", rate},
                 {"threads", outcome.threads},
                 {"settings_by_reference", outcome.settings_by_reference},
                 {"method", method_text(a.method)},
                 {"file", whole ? a.output : RunFolder::of_target(a.output).path().string()}};
    if (!whole) json["shard"] = shard_text(shard);
    print_json(json);
    return kDone;
  }
  if (a.quiet) return kDone;
  print_message(fmt::format("{} settings in {} on {} threads, {} settings/s", grouped(outcome.settings_measured),
                            duration_text(outcome.seconds), outcome.threads,
                            grouped(static_cast<std::uint64_t>(rate))));
  if (!a.extend.empty()) print_message(fmt::format("{} settings taken from {}", grouped(work.reused), a.extend));
  print_message(fmt::format("{} settled, {} not settled at the horizon, {} unstable",
                            grouped(tally[Status::settled]), grouped(tally[Status::not_settled]),
                            grouped(tally[Status::unstable])));
  if (outcome.settings_by_reference > 0 && a.method == Method::kernel)
    print_message(
        fmt::format("{} settings, too stiff for the kernel's panels, were measured by the reference method",
                    grouped(outcome.settings_by_reference)));
  if (whole) {
    print_message(fmt::format("portrait written to {}", a.output));
  } else {
    const std::string folder = RunFolder::of_target(a.output).path().string();
    print_message(fmt::format("shard {} is complete in {}; when all are: portrait merge {} -o {}",
                              shard_text(shard), folder, folder, a.output));
  }
  return kDone;
}

int stopped(const RunWriter& run, const std::string& command_line, const Grid& grid) {
  print_message(fmt::format("stopped with {} of {} tiles stored in {}; go on with:\n  {}",
                            grouped(run.tiles_done()), grouped(Tiling(grid).tile_count()),
                            run.folder().path().string(), resume_command(command_line)));
  return kStopped;
}

/// The portrait is there already, of this very run: it was killed after its last step but one, or asked for twice.
bool is_done(const std::filesystem::path& output, const Grid& grid, Method method) {
  if (!std::filesystem::exists(output)) return false;
  const PortraitReader portrait(output);
  const RunManifest now = manifest_of(grid, {"", method_text(method)});
  RunManifest kept = now;
  kept.grid_text = portrait.grid().text;
  kept.schema_version = portrait.facts().schema_version;
  kept.program = portrait.facts().program;
  kept.method = portrait.facts().method;
  const std::string differs = difference(kept, now);
  if (!differs.empty())
    throw InputError(fmt::format("{} is there, of another run (--force replaces it):{}", output.string(), differs));
  const RunFolder folder = RunFolder::of_target(output);
  if (!folder.exists()) return true;
  for (const ShardState& shard : folder.shards(fingerprint(now))) {
    const RunLock lock(folder.file_of(shard.shard, "lock"));
    folder.remove(shard.shard);
  }
  folder.remove_if_empty();
  return true;
}

// ---------------------------------------------------------------- the run

/// The settings of a tile that are to measure.
std::vector<Setting> settings_of(const Grid& grid, const Box& box, const EarlierPortrait* earlier) {
  return earlier != nullptr ? earlier->missing_in(box) : settings_in(grid, box);
}

void report_damage(const EarlierPortrait* earlier) {
  if (earlier == nullptr || earlier->measured_again() == 0) return;
  for (const std::string& damage : earlier->damage()) print_message(damage);
  print_message(fmt::format("{} settings were measured again in place of what is damaged",
                            grouped(earlier->measured_again())));
}

/// What is not about to become a portrait is stored, whatever stopped it.
SweepOutcome swept(const SweepJob& job, RunWriter& run, const Shard& shard) try {
  const SweepOutcome outcome = sweep(job);
  if (!outcome.complete || shard.count > 1) run.commit();
  return outcome;
} catch (const StoreError&) {
  throw;  // no use in storing more
} catch (...) {
  run.commit();
  throw;
}

}  // namespace

int sweep_to_file(const SweepArguments& a, const std::string& command_line, const Grid& grid, const Shard& shard,
                  int threads, EarlierPortrait* earlier) {
  const std::filesystem::path output(a.output);
  const Existing existing = a.force ? Existing::replace : Existing::refuse;
  if (a.resume && !a.force && is_done(output, grid, a.method)) {
    if (!a.quiet) print_message(fmt::format("{} is complete already", a.output));
    return kDone;
  }
  check_target(output, existing);
  InterruptGuard interrupt;
  const RunStart start = a.force                       ? RunStart::replace
                         : a.resume || shard.count > 1 ? RunStart::resume
                                                       : RunStart::fresh;
  RunWriter run(output, grid, {command_line, method_text(a.method)}, shard, start);
  for (const std::string& damage : run.set_aside())
    print_message(fmt::format("damaged, set aside and computed again: {}", damage));

  Tally tally;
  const Tiling tiling(grid);
  SweepJob job = sweep_job(grid, tiling, threads);
  job.method = a.method;
  job.tile_count = run.tiles_to_do().size();
  const auto box = [&](std::uint64_t i) { return tiling.box(run.tiles_to_do()[i]); };
  job.settings_of = [&](std::uint64_t i) { return settings_of(grid, box(i), earlier); };
  const Work work = work_in(tiling, run.tiles_to_do(), earlier);
  Progress progress(work.to_measure(), Progress::usual_style(a.quiet));
  const auto store = [&](std::uint64_t i, const MeasureColumns& columns) -> StoreStep {
    return [&, encoded = std::make_shared<EncodedTile>(run.encode(run.tiles_to_do()[i], columns))] {
      tally.add(encoded->record.chunks.back().summary);
      run.write(std::move(*encoded));
    };
  };
  job.prepare = [&](std::uint64_t i, const MeasureColumns& columns) {
    return earlier != nullptr ? store(i, earlier->completed(box(i), columns)) : store(i, columns);
  };
  job.progress = [&](std::uint64_t done) { progress.update(done); };
  job.stop = &interrupt.requested();

  const SweepOutcome outcome = swept(job, run, shard);
  progress.finish();
  report_damage(earlier);
  if (!outcome.complete) return stopped(run, command_line, grid);
  if (shard.count == 1) run.finish({.wall_seconds = outcome.seconds, .threads = outcome.threads}, existing);
  return report(a, grid, shard, outcome, tally, work);
}

}  // namespace portrait::tools
