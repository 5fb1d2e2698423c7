#include "portraits/earlier_portrait.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/base/version.h"
#include "engine/base/words.h"
#include "engine/sweep/method.h"
#include "grids/sweep_job.h"
#include "grids/tiling.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

bool has(const std::vector<Measure>& measures, Measure measure) {
  return std::find(measures.begin(), measures.end(), measure) != measures.end();
}

std::string sampling_text(const Grid& grid) { return grid.sampling ? number_text(*grid.sampling) : "none"; }

std::string noise_text(const std::optional<NoiseTrials>& trials) {
  if (!trials) return "none";
  const Noise& n = trials->noise;
  return fmt::format("{} of {} held over {}, {} seeds from {}", to_string(n.kind), number_text(n.amplitude),
                     number_text(n.sampling), trials->seeds, n.seed);
}

/// What keeps the stored numbers from being those that would be computed, a line each; empty: nothing does.
std::string what_differs(const PortraitReader& kept, const Grid& grid, const std::string& method) {
  const Grid& before = kept.grid();
  std::string text;
  const auto compare = [&](const char* what, const std::string& then, const std::string& now) {
    if (then != now) text += fmt::format("\n  {}: {}, now {}", what, then, now);
  };
  const auto word = [](auto value) { return std::string(to_string(value)); };
  compare("plant", word(before.family.plant), word(grid.family.plant));
  compare("n", std::to_string(before.family.n), std::to_string(grid.family.n));
  compare("prefilter", word(before.family.prefilter), word(grid.family.prefilter));
  compare("horizon", schema::horizon_text(before.horizon), schema::horizon_text(grid.horizon));
  if (has(grid.measures, Measure::noise_gain)) compare("sampling", sampling_text(before), sampling_text(grid));
  if (std::any_of(grid.measures.begin(), grid.measures.end(), is_noisy))
    compare("noise", noise_text(before.noise), noise_text(grid.noise));
  if (before.precision == Precision::real32 && grid.precision == Precision::real64)
    compare("precision", "single", "double");
  compare("the program", kept.facts().program, program_version());
  compare("the method", kept.facts().method, method);
  if (kept.facts().method != method) text += " (PORTRAIT_ISA chooses the instruction set)";
  std::vector<std::string_view> lacking;
  for (const Measure measure : grid.measures)
    if (!kept.has(measure)) lacking.push_back(to_string(measure));
  if (!lacking.empty())
    text += fmt::format(
        "\n  measures: it lacks {} (to compute one measure of a setting takes as long as all of them: "
        "leave them out of the grid, or sweep it anew)",
        joined(lacking));
  return text;
}

}  // namespace

EarlierPortrait::EarlierPortrait(const std::filesystem::path& path, const Grid& grid, const std::string& method)
    : grid_(grid), reader_(path), rows_(reader_.grid()), overlap_(grid, reader_.grid()) {
  const std::string differs = what_differs(reader_, grid, method);
  if (!differs.empty())
    throw InputError(fmt::format("{} cannot be extended to this grid:{}", path.string(), differs));
  if (const auto apart = overlap_.apart())
    throw InputError(
        fmt::format("{} has no setting of this grid: no value of {} is in both", path.string(), to_string(*apart)));
}

std::vector<Setting> EarlierPortrait::missing_in(const Box& box) const {
  std::vector<Setting> settings = settings_in(grid_, box);
  if (reused_in(box) == 0) return settings;
  const std::vector<std::uint64_t> numbers = overlap_.numbers_in(box);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (numbers[i] == Overlap::kNone) settings[kept++] = settings[i];
  settings.resize(kept);
  return settings;
}

MeasureColumns EarlierPortrait::completed(const Box& box, const MeasureColumns& missing) {
  if (reused_in(box) == 0) return missing;
  const std::vector<std::uint64_t> numbers = overlap_.numbers_in(box);
  MeasureColumns columns(missing.kept, numbers.size());
  std::vector<Wanted> wanted;
  std::size_t next = 0;
  for (std::size_t place = 0; place < numbers.size(); ++place) {
    if (numbers[place] != Overlap::kNone) {
      wanted.push_back({numbers[place], place});
      continue;
    }
    for (std::size_t k = 0; k < columns.kept.size(); ++k) columns.values[k][place] = missing.values[k].at(next);
    columns.status[place] = missing.status.at(next++);
  }
  PORTRAIT_CHECK_EQ(next, missing.settings());
  std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) { return a.number < b.number; });
  std::unique_ptr<ColumnSource> reader = take_reader();
  for (Run left = wanted; !left.empty();) {
    const std::uint64_t end = rows_.range(rows_.tile_of(left.front().number)).end();
    const auto beyond = std::find_if(left.begin(), left.end(), [&](const Wanted& w) { return w.number >= end; });
    const Run run = left.first(static_cast<std::size_t>(beyond - left.begin()));
    take_over(*reader, run, box, columns);
    left = left.subspan(run.size());
  }
  give_back(std::move(reader));
  return columns;
}

/// Readers keep the tile that they read last, and tiles are asked for in their order.
std::unique_ptr<ColumnSource> EarlierPortrait::take_reader() {
  const std::scoped_lock lock(mutex_);
  if (free_.empty()) return reader_.for_another_thread();
  std::unique_ptr<ColumnSource> reader = std::move(free_.back());
  free_.pop_back();
  return reader;
}

void EarlierPortrait::give_back(std::unique_ptr<ColumnSource> reader) {
  const std::scoped_lock lock(mutex_);
  free_.push_back(std::move(reader));
}

void EarlierPortrait::take_over(const ColumnSource& reader, Run run, const Box& box, MeasureColumns& columns) {
  try {
    copy(reader, run, columns);
  } catch (const IntegrityError& error) {
    measure(run, box, columns);
    const std::scoped_lock lock(mutex_);
    measured_again_ += run.size();
    if (std::find(damage_.begin(), damage_.end(), error.what()) == damage_.end())
      damage_.emplace_back(error.what());
  }
}

void EarlierPortrait::copy(const ColumnSource& reader, Run run, MeasureColumns& columns) const {
  const std::uint64_t first = run.front().number;
  const auto count = static_cast<std::size_t>(run.back().number - first + 1);
  std::vector<double> values;
  for (std::size_t k = 0; k < columns.kept.size(); ++k) {
    reader.read(columns.kept[k], first, count, values);
    for (const Wanted& wanted : run) columns.values[k][wanted.place] = values[wanted.number - first];
  }
  std::vector<Status> statuses;
  reader.read_statuses(first, count, statuses);
  for (const Wanted& wanted : run) {
    columns.status[wanted.place] = statuses[wanted.number - first];
    if (columns.status[wanted.place] == Status::not_computed)
      throw IntegrityError(fmt::format("{}: setting {} was not computed", reader_.path().string(), wanted.number));
  }
}

void EarlierPortrait::measure(Run run, const Box& box, MeasureColumns& columns) const {
  const std::vector<Setting> all = settings_in(grid_, box);
  std::vector<Setting> settings;
  for (const Wanted& wanted : run) settings.push_back(all[wanted.place]);
  std::vector<SettingMeasured> measured(settings.size());
  measure_settings(method_for(grid_.measures), grid_.family, grid_.horizon, extras_for(grid_), settings, measured);
  for (std::size_t i = 0; i < run.size(); ++i) columns.set(run[i].place, measured[i].status, measured[i].measures);
}

std::vector<std::string> EarlierPortrait::damage() const {
  const std::scoped_lock lock(mutex_);
  return damage_;
}

std::uint64_t EarlierPortrait::measured_again() const {
  const std::scoped_lock lock(mutex_);
  return measured_again_;
}

}  // namespace portrait
