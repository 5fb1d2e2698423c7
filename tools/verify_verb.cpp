/// portrait verify: whether a portrait still is what was written, and whether what was written is right.

#include <algorithm>
#include <optional>
#include <random>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/parameters.h"
#include "portraits/reader.h"
#include "portraits/sample_check.h"
#include "portraits/verify.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/run_state.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait verify huba.h5
  portrait verify huba.h5 --sample 1000

Reads every value of a portrait and holds it against the digests that were stored with it.
With --sample so many settings, chosen at random, are simulated once more by the reference
method, and every stored measure is compared: the worst difference of each is printed beside
what is allowed. --seed repeats a choice. Exit code 4 when anything differs.)";

struct VerifyArguments {
  std::string file;
  std::uint64_t sample = 0, seed = 0;
  bool has_seed = false, quiet = false, json = false;
  int threads = 0;
};

struct Sampled {
  SampleRequest request;
  SampleReport report;
  bool agrees() const { return report.failed == 0; }
};

bool is_whole(const VerifyReport& report) {
  return std::all_of(report.datasets.begin(), report.datasets.end(),
                     [](const CheckedDataset& dataset) { return dataset.problem.empty(); });
}

Sampled sampled(const VerifyArguments& a, const PortraitReader& portrait) {
  Progress progress(std::min(a.sample, portrait.settings()), Progress::usual_style(a.quiet || a.json));
  Sampled sampled{{.settings = a.sample, .seed = a.has_seed ? a.seed : std::random_device()(), .threads = a.threads}, {}};
  sampled.request.progress = [&](std::uint64_t done) { progress.update(done); };
  sampled.report = check_sample(portrait, sampled.request);
  return sampled;
}

// ---------------------------------------------------------------- text

std::string datasets_text(const VerifyReport& report) {
  std::string text;
  for (const CheckedDataset& dataset : report.datasets)
    text += fmt::format("  {:<10} {}  {}\n", dataset.name, dataset.digest,
                        dataset.problem.empty() ? "ok" : dataset.problem);
  return text;
}

std::string command_at(const Grid& grid, std::uint64_t number) {
  const std::string horizon = grid.horizon.automatic ? "auto" : fmt::format("{}", grid.horizon.dead_times);
  return fmt::format("{} --horizon {} --method reference", simulate_command({grid.family, setting_at(grid, number)}),
                     horizon);
}

std::string sample_text(const Sampled& sampled, const Grid& grid) {
  std::string text = fmt::format("{} settings, seed {}, simulated again by the reference method\n  {:<10} {:>9} {:>9}\n",
                                 grouped(sampled.report.settings), sampled.request.seed, "measure", "worst", "allowed");
  for (const MeasureCheck& m : sampled.report.measures) {
    text += fmt::format("  {:<10} {:>9.1e} {:>9.1e}  {}\n", to_string(m.measure), m.worst, m.allowed,
                        m.failed == 0 ? "ok" : fmt::format("WRONG in {} settings", grouped(m.failed)));
    if (m.failed > 0)
      text += fmt::format("    setting {}: stored {}, now {}: {}\n", m.where, m.stored, m.truth, command_at(grid, m.where));
  }
  text += fmt::format("  {:<30}  {}\n", "status", sampled.report.statuses.empty() ? "ok" : "WRONG");
  for (const StatusMismatch& s : sampled.report.statuses)
    text += fmt::format("    setting {}: stored {}, now {}: {}\n", s.where, to_string(s.stored), to_string(s.truth),
                        command_at(grid, s.where));
  return text;
}

std::string verdict(bool whole, const Sampled* sampled) {
  if (!whole) return "BROKEN";
  const char* const as_written = "whole, every value is as it was written";
  if (sampled == nullptr) return as_written;
  if (sampled->agrees()) return fmt::format("{}, and {} settings are right", as_written, grouped(sampled->report.settings));
  return fmt::format("{}, yet {} of {} settings are WRONG", as_written, grouped(sampled->report.failed),
                     grouped(sampled->report.settings));
}

// ---------------------------------------------------------------- JSON

Json json_sample(const Sampled& sampled) {
  Json measures = Json::object(), statuses = Json::array();
  for (const MeasureCheck& m : sampled.report.measures)
    measures[std::string(to_string(m.measure))] = {{"worst", json_number(m.worst)},    {"allowed", m.allowed},
                                                   {"failed", m.failed},               {"setting", m.where},
                                                   {"stored", json_number(m.stored)}, {"reference", json_number(m.truth)}};
  for (const StatusMismatch& s : sampled.report.statuses)
    statuses.push_back({{"setting", s.where}, {"stored", to_string(s.stored)}, {"reference", to_string(s.truth)}});
  return {{"settings", sampled.report.settings}, {"seed", sampled.request.seed}, {"failed", sampled.report.failed},
          {"measures", measures}, {"statuses", statuses}};
}

Json json_of(const std::string& file, const VerifyReport& report, const Sampled* sampled) {
  Json datasets = Json::array();
  for (const CheckedDataset& dataset : report.datasets)
    datasets.push_back({{"name", dataset.name},
                        {"xxh3_64", dataset.digest},
                        {"problem", dataset.problem.empty() ? Json(nullptr) : Json(dataset.problem)}});
  return {{"file", file}, {"whole", is_whole(report)}, {"datasets", datasets},
          {"sample", sampled != nullptr ? json_sample(*sampled) : Json(nullptr)}};
}

int run(const VerifyArguments& a) {
  if (const auto folder = run_folder_meant(a.file)) {
    if (a.sample > 0) throw InputError(fmt::format("{} is a sweep that was stopped: --sample is for its portrait", a.file));
    return verify_run(*folder);
  }
  const VerifyReport report = inspect(a.file, a.threads);
  const bool whole = is_whole(report);
  std::optional<PortraitReader> portrait;
  std::optional<Sampled> sample;
  if (whole && a.sample > 0) {
    portrait.emplace(a.file);
    sample = sampled(a, *portrait);
  }
  const Sampled* const checked = sample ? &*sample : nullptr;
  if (a.json)
    print_json(json_of(a.file, report, checked));
  else
    print_text(datasets_text(report) + (sample ? sample_text(*sample, portrait->grid()) : "") +
               fmt::format("{}: {}\n", a.file, verdict(whole, checked)));
  return whole && (!sample || sample->agrees()) ? kDone : kBroken;
}

}  // namespace

void add_verify(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<VerifyArguments>();
  CLI::App* verb = add_verb(app, "verify", "whether a portrait still is what was written, and right", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("--sample", a->sample, "also simulate so many settings again, by the reference method")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  const CLI::Option* seed = verb->add_option("--seed", a->seed, "of the choice of settings (default: another each time)");
  verb->add_option("--threads", a->threads, "threads (default: all)")->check(CLI::Range(1, 4096));
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->add_flag("--json", a->json, "one JSON object");
  verb->callback([a, seed, &invocation] {
    a->has_seed = seed->count() > 0;
    invocation.exit_code = run(*a);
  });
}

}  // namespace portrait::tools
