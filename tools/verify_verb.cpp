/// portrait verify: whether a portrait still is what was written.

#include <fmt/format.h>

#include "portraits/verify.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/run_state.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait verify huba.h5

Reads every value of a portrait and holds it against the digests that were stored with it.
Exit code 4 when anything differs; the damaged datasets are named.)";

int run(const std::string& file) {
  if (const auto folder = run_folder_meant(file)) return verify_run(*folder);
  const VerifyReport report = inspect(file);
  std::string text;
  bool whole = true;
  for (const CheckedDataset& dataset : report.datasets) {
    whole = whole && dataset.problem.empty();
    text += fmt::format("  {:<10} {}  {}\n", dataset.name, dataset.digest,
                        dataset.problem.empty() ? "ok" : dataset.problem);
  }
  print_text(text + fmt::format("{}: {}\n", file, whole ? "whole, every value is as it was written" : "BROKEN"));
  return whole ? kDone : kBroken;
}

}  // namespace

void add_verify(CLI::App& app, Invocation& invocation) {
  auto file = std::make_shared<std::string>();
  CLI::App* verb = add_verb(app, "verify", "whether a portrait still is what was written", kHelp);
  verb->add_option("file", *file, "portrait file")->required();
  verb->callback([file, &invocation] { invocation.exit_code = run(*file); });
}

}  // namespace portrait::tools
