#include "portraits/run_manifest.h"

#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/version.h"
#include "grids/tiling.h"
#include "portraits/digest.h"
#include "portraits/disk.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

using Json = nlohmann::ordered_json;

/// "line 7: kappa = 1, now kappa = 2"
std::string first_line_that_differs(const std::string& kept, const std::string& now) {
  std::istringstream a(kept), b(now);
  std::string before, after;
  for (int line = 1;; ++line) {
    const bool more_before = static_cast<bool>(std::getline(a, before));
    const bool more_after = static_cast<bool>(std::getline(b, after));
    if (!more_before) before = "(its end)";
    if (!more_after) after = "(its end)";
    if (before != after) return fmt::format("line {}: \"{}\", now \"{}\"", line, before, after);
    if (!more_before && !more_after) return "the ends of lines";
  }
}

}  // namespace

RunManifest manifest_of(const Grid& grid, const Provenance& provenance) {
  return {.grid_text = grid.text,
          .schema_version = schema::kVersion,
          .program = program_version(),
          .method = provenance.method,
          .command_line = provenance.command_line,
          .date = provenance.date,
          .settings = setting_count(grid),
          .tiles = Tiling(grid).tile_count()};
}

std::uint64_t fingerprint(const RunManifest& m) {
  std::string all;
  for (const std::string* part : {&m.grid_text, &m.schema_version, &m.program, &m.method})
    all += fmt::format("{}:{}", part->size(), *part);
  return digest_of(all + fmt::format("{}:{}", m.settings, m.tiles));
}

std::string difference(const RunManifest& kept, const RunManifest& now) {
  std::string text;
  if (kept.grid_text != now.grid_text)
    text += fmt::format("\n  the grid: {}", first_line_that_differs(kept.grid_text, now.grid_text));
  const auto compare = [&](const char* what, const std::string& before, const std::string& after) {
    if (before != after) text += fmt::format("\n  {}: {}, now {}", what, before, after);
  };
  compare("the format", kept.schema_version, now.schema_version);
  compare("the program", kept.program, now.program);
  compare("the method", kept.method, now.method);
  if (kept.method != now.method) text += " (PORTRAIT_ISA chooses the instruction set)";
  compare("the settings", std::to_string(kept.settings), std::to_string(now.settings));
  return text;
}

std::string json_text(const RunManifest& m) {
  const Json json = {{"portrait_run", 1},
                     {"fingerprint", digest_text(fingerprint(m))},
                     {"schema_version", m.schema_version},
                     {"program", m.program},
                     {"method", m.method},
                     {"command_line", m.command_line},
                     {"date", m.date},
                     {"settings", m.settings},
                     {"tiles", m.tiles},
                     {"grid_toml", m.grid_text}};
  return json.dump(2) + "\n";
}

RunManifest read_manifest(const std::filesystem::path& path) try {
  const Json json = Json::parse(disk::read_whole_file(path));
  const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
  RunManifest m{.grid_text = text("grid_toml"),
                .schema_version = text("schema_version"),
                .program = text("program"),
                .method = text("method"),
                .command_line = text("command_line"),
                .date = text("date"),
                .settings = json.at("settings").get<std::uint64_t>(),
                .tiles = json.at("tiles").get<std::uint64_t>()};
  if (digest_text(fingerprint(m)) != text("fingerprint"))
    throw IntegrityError(fmt::format("{}: it is not what was written (its fingerprint differs)", path.string()));
  return m;
} catch (const Json::exception& error) {
  throw IntegrityError(fmt::format("{}: this is no manifest of a run: {}", path.string(), error.what()));
}

}  // namespace portrait
