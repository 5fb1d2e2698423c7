/// portrait merge: the shards of a grid, one portrait.

#include <chrono>

#include <fmt/format.h>

#include "engine/sweep/sweep.h"
#include "portraits/merge.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait merge big.h5.run -o big.h5
  portrait merge node1/big.h5.run node2/big.h5.run -o big.h5

Makes one portrait of the shards that `portrait sweep --shard I/N` left in their run folders.
Every tile is held against its digest; missing shards are named; a tile that two shards have
must be the same in both. The folders stay as they are.)";

struct MergeArguments {
  std::vector<std::string> shards;
  std::string output;
  bool force = false, json = false, quiet = false;
};

int run(const MergeArguments& a, const Invocation& invocation) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<RunFolder> folders;
  for (const std::string& name : a.shards)
    folders.push_back(RunFolder::is_one(name) ? RunFolder(name) : RunFolder::of_target(name));
  const MergeReport merged = merge_runs(folders, a.output, a.force ? Existing::replace : Existing::refuse,
                                        {.wall_seconds = 0, .threads = usual_threads()}, invocation.command_line);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double rate = static_cast<double>(merged.bytes) * 1e-6 / took.count();
  if (a.json)
    print_json({{"settings", merged.settings},
                {"tiles", merged.tiles},
                {"shards", merged.shards},
                {"duplicates", merged.duplicates},
                {"bytes", merged.bytes},
                {"seconds", took.count()},
                {"megabytes_per_second", rate},
                {"file", a.output}});
  else if (!a.quiet)
    print_message(fmt::format("{} settings of {} shards merged into {}, {:.0f} MB/s", grouped(merged.settings),
                              merged.shards, a.output, rate));
  return kDone;
}

}  // namespace

void add_merge(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<MergeArguments>();
  CLI::App* verb = add_verb(app, "merge", "one portrait of the shards of a grid", kHelp);
  verb->add_option("shards", a->shards, "run folders of shards")->required();
  verb->add_option("-o,--output", a->output, "portrait file to write")->required();
  verb->add_flag("--force", a->force, "replace an existing portrait");
  verb->add_flag("--quiet", a->quiet, "no summary");
  verb->add_flag("--json", a->json, "the summary as one JSON object");
  verb->callback([a, &invocation] { invocation.exit_code = run(*a, invocation); });
}

}  // namespace portrait::tools
