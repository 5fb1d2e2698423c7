#include "tools/shard_argument.h"

#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace portrait::tools {
namespace {

constexpr int kMostShards = 1'000'000;

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

int needed(const Environment& environment, const char* name) {
  const std::optional<std::string> text = environment(name);
  const std::optional<int> number = text ? whole_number(*text) : std::nullopt;
  if (!number) throw InputError(fmt::format("the environment says no number in {}: give --shard I/N", name));
  return *number;
}

/// Rank and number of ranks of a parallel start, or of a step of srun.
Shard ranks(const Environment& environment) {
  const std::pair<const char*, const char*> names[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                                       {"PMI_RANK", "PMI_SIZE"},
                                                       {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, size] : names)
    if (environment(rank) && environment(size))
      return {needed(environment, rank) + 1, needed(environment, size)};
  return {};
}

Shard array_task(const Environment& environment) {
  if (!environment("SLURM_ARRAY_TASK_ID")) return {};
  const int first = needed(environment, "SLURM_ARRAY_TASK_MIN");
  const int step = environment("SLURM_ARRAY_TASK_STEP") ? needed(environment, "SLURM_ARRAY_TASK_STEP") : 1;
  const int count = needed(environment, "SLURM_ARRAY_TASK_COUNT");
  const int from_first = needed(environment, "SLURM_ARRAY_TASK_ID") - first;
  if (step < 1 || from_first % step != 0 || from_first / step >= count)
    throw InputError("the tasks of this array are not evenly numbered: give --shard I/N");
  return {from_first / step + 1, count};
}

Shard checked(const Shard& shard, const std::string& source) {
  if (shard.count < 1 || shard.count > kMostShards || shard.number < 1 || shard.number > shard.count)
    throw InputError(fmt::format("{} must be I/N with 1 <= I <= N <= {}", source, kMostShards));
  return shard;
}

}  // namespace

Shard shard_argument(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = whole_number(std::string_view(text).substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  return checked({number.value_or(0), count.value_or(0)}, fmt::format("--shard {}", text));
}

Environment this_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
  };
}

Shard shard_from(const Environment& environment) {
  const Shard rank = checked(ranks(environment), "the rank in the environment");
  const Shard task = checked(array_task(environment), "the array task in the environment");
  return checked({(task.number - 1) * rank.count + rank.number, task.count * rank.count}, "the shard of the environment");
}

}  // namespace portrait::tools
