#include "tools/run_state.h"

#include <fmt/format.h>

#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"

namespace portrait::tools {
namespace {

struct RunState {
  RunManifest manifest;
  std::vector<ShardState> shards;
  std::uint64_t tiles_stored = 0;
  int damaged = 0, set_aside = 0;
  bool running = false;
};

RunState state_of(const RunFolder& folder) {
  RunState state{.manifest = read_manifest(folder.manifest()), .shards = {}};
  state.shards = folder.shards(fingerprint(state.manifest));
  std::vector<bool> stored(state.manifest.tiles);
  for (const ShardState& shard : state.shards) {
    state.running = state.running || shard.writer.has_value();
    state.set_aside += shard.batches_set_aside;
    for (const StoredBatch& batch : shard.batches) {
      state.damaged += batch.problem.empty() ? 0 : 1;
      for (const TileRecord& tile : batch.batch.tiles) stored.at(tile.number) = true;
    }
  }
  for (const bool is : stored) state.tiles_stored += is ? 1 : 0;
  return state;
}

std::string state_text(const RunState& state) {
  if (state.running) return "running";
  return state.tiles_stored == state.manifest.tiles ? "all tiles stored, not merged" : "stopped";
}

Json json_shard(const ShardState& shard) {
  Json batches = Json::array();
  for (const StoredBatch& batch : shard.batches)
    if (!batch.problem.empty()) batches.push_back({{"file", batch.path.string()}, {"problem", batch.problem}});
  return {{"shard", shard_text(shard.shard)},
          {"tiles_stored", shard.tiles()},
          {"batches", shard.batches.size()},
          {"writer", shard.writer ? Json(*shard.writer) : Json(nullptr)},
          {"damaged", batches},
          {"set_aside", shard.batches_set_aside}};
}

}  // namespace

std::optional<RunFolder> run_folder_meant(const std::string& name) {
  if (RunFolder::is_one(name)) return RunFolder(name);
  const RunFolder folder = RunFolder::of_target(name);
  if (!std::filesystem::exists(name) && RunFolder::is_one(folder.path())) return folder;
  return std::nullopt;
}

int print_run_state(const RunFolder& folder, bool json) {
  const RunState state = state_of(folder);
  if (json) {
    Json shards = Json::array();
    for (const ShardState& shard : state.shards) shards.push_back(json_shard(shard));
    print_json({{"state", state_text(state)},
                {"settings", state.manifest.settings},
                {"tiles", state.manifest.tiles},
                {"tiles_stored", state.tiles_stored},
                {"schema_version", state.manifest.schema_version},
                {"program", state.manifest.program},
                {"method", state.manifest.method},
                {"command_line", state.manifest.command_line},
                {"date", state.manifest.date},
                {"shards", shards}});
    return kDone;
  }
  const double part = 100.0 * static_cast<double>(state.tiles_stored) / static_cast<double>(state.manifest.tiles);
  std::string text = fmt::format("a sweep that is {}: {} of {} tiles stored, {:.1f} %, of {} settings\n",
                                 state_text(state), grouped(state.tiles_stored), grouped(state.manifest.tiles), part,
                                 grouped(state.manifest.settings));
  text += fmt::format("begun     {}, {}\nmade by   {}, method {}\n", state.manifest.date, state.manifest.command_line,
                      state.manifest.program, state.manifest.method);
  for (const ShardState& shard : state.shards) {
    text += fmt::format("shard {:<8} {} tiles in {} batches{}\n", shard_text(shard.shard), grouped(shard.tiles()),
                        shard.batches.size(), shard.writer ? ", written by " + *shard.writer : "");
    for (const StoredBatch& batch : shard.batches)
      if (!batch.problem.empty()) text += fmt::format("  damaged: {}: {}\n", batch.path.string(), batch.problem);
    if (shard.batches_set_aside > 0) text += fmt::format("  {} batches were damaged and set aside\n", shard.batches_set_aside);
  }
  print_text(text);
  return kDone;
}

int verify_run(const RunFolder& folder) {
  const RunState state = state_of(folder);
  std::string text;
  bool whole = true;
  for (const ShardState& shard : state.shards)
    for (const StoredBatch& batch : shard.batches) {
      const std::string problem = batch.problem.empty() ? data_problem(shard.data, batch.batch) : batch.problem;
      whole = whole && problem.empty();
      text += fmt::format("  {:<26} {} tiles  {}\n", batch.path.filename().string(), batch.batch.tiles.size(),
                          problem.empty() ? "ok" : problem);
    }
  print_text(text + fmt::format("{}: {}\n", folder.path().string(),
                                whole ? "whole so far, every tile is as it was written" : "BROKEN"));
  return whole ? kDone : kBroken;
}

}  // namespace portrait::tools
