#include "portraits/facts.h"

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/version.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "gcc " __VERSION__;
#endif

/// The last second of the year 9999: dates of four-digit years.
constexpr std::int64_t kLastSecond = 253402300799;

std::time_t fixed_time(std::string_view text) {
  std::int64_t seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || seconds < 0 || seconds > kLastSecond)
    throw InputError(fmt::format("SOURCE_DATE_EPOCH must be a number of seconds since 1970 (it is \"{}\")", text));
  return static_cast<std::time_t>(seconds);
}

}  // namespace

std::string date_text() {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(fixed != nullptr ? fixed_time(fixed) : std::time(nullptr)));
}

void write_provenance(const h5::File& file, const Provenance& provenance) {
  const std::string date = provenance.date.empty() ? date_text() : provenance.date;
  file.set_text("schema_name", schema::kName);
  file.set_text("schema_version", schema::kVersion);
  file.set_text("program", program_version());
  file.set_text("history", fmt::format("{} {}", date, provenance.command_line));
  file.set_text("date_created", date);
  file.set_text("method", provenance.method);
  file.set_text("compiler", kCompiler);
  file.set_text("hdf5_version", h5::library_version());
}

void write_run_facts(const h5::File& file, const RunFacts& facts) {
  file.set_integer("threads", facts.threads);
  file.set_real("wall_seconds", facts.wall_seconds);
  file.set_text("state", "complete");
}

Facts read_facts(const h5::File& file) {
  return {.schema_version = file.text("schema_version"),
          .program = file.text("program"),
          .history = file.text("history"),
          .date_created = file.text("date_created"),
          .method = file.text("method"),
          .compiler = file.text("compiler"),
          .hdf5_version = file.text("hdf5_version"),
          .state = file.text("state"),
          .wall_seconds = file.real("wall_seconds"),
          .threads = file.integer("threads")};
}

}  // namespace portrait
