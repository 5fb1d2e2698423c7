#include "grids/grid_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "engine/kernel/noise.h"
#include "grids/document.h"
#include "grids/parameter_entries.h"
#include "grids/toml.h"

namespace portrait {
namespace {

using Words = std::vector<std::string_view>;

/// The thing that `named` knows by this word, or an error that names the nearest word.
template <typename Named>
auto thing_in(std::string_view noun, const Value& value, Named named, const Words& known) {
  const std::string& word = text_in(noun, value);
  if (const auto thing = named(word)) return *thing;
  throw InputError(value.place, fmt::format("unknown {} {}{}", noun, in_quotes(word), suggestion(word, known)));
}

Plant plant_in(const Value& root) {
  const Entry& entry = need(root, "plant", "one of " + joined({kPlantNames.begin(), kPlantNames.end()}));
  return thing_in("plant", entry.value, plant_named, {kPlantNames.begin(), kPlantNames.end()});
}

int filter_order_in(const Value::Table& root) {
  const Entry* entry = find(root, "n");
  if (!entry) return 0;
  const std::int64_t n = whole_number_in("n", entry->value);
  if (0 <= n && n <= kMaxFilterOrder) return static_cast<int>(n);
  throw InputError(entry->value.place, fmt::format("\"n\" must be 0 .. {} (it is {})", kMaxFilterOrder, n));
}

Prefilter prefilter_in(const Value::Table& root, int n) {
  const Entry* entry = find(root, "prefilter");
  if (!entry) return usual_prefilter(n);
  return thing_in("prefilter", entry->value, prefilter_named, {kPrefilterNames.begin(), kPrefilterNames.end()});
}

/// The order of jotd.
int plant_order_in(const Value& root, Plant plant) {
  const Entry* entry = find(std::get<Value::Table>(root.content), "j");
  if (plant != Plant::jotd) {
    if (entry) throw InputError(entry->place, "\"j\" is the order of plant \"jotd\"");
    return 0;
  }
  const Value& value = need(root, "j", fmt::format("the order of jotd, 1 .. {}", kMaxPlantOrder)).value;
  const std::int64_t j = whole_number_in("j", value);
  if (1 <= j && j <= kMaxPlantOrder) return static_cast<int>(j);
  throw InputError(value.place, fmt::format("\"j\" must be 1 .. {} (it is {})", kMaxPlantOrder, j));
}

/// The highest gain K_m that the parameters name.
const Entry* last_gain_in(const Value::Table& parameters) {
  const Entry* last = nullptr;
  for (const Entry& entry : parameters) {
    const auto parameter = parameter_named(entry.key);
    if (parameter && gain_place(*parameter) && (!last || *parameter > *parameter_named(last->key))) last = &entry;
  }
  return last;
}

LoopFamily with_gains(const Value::Table& table, const Entry& last, LoopFamily family) {
  const Entry* prefilter = find(table, "prefilter");
  family.m = static_cast<int>(*gain_place(*parameter_named(last.key))) - 1;
  family.prefilter = prefilter ? prefilter_in(table, family.n) : Prefilter::none;
  const auto why = why_invalid(family);
  if (!why) return family;
  throw InputError(family.prefilter != Prefilter::none && prefilter ? prefilter->value.place : last.place, *why);
}

LoopFamily family_in(const Value& root) {
  const auto& table = std::get<Value::Table>(root.content);
  LoopFamily family{.plant = plant_in(root), .n = filter_order_in(table)};
  family.j = plant_order_in(root, family.plant);
  const Entry* parameters = find(table, "parameters");
  const bool is_table = parameters && std::holds_alternative<Value::Table>(parameters->value.content);
  const Entry* gain = is_table ? last_gain_in(std::get<Value::Table>(parameters->value.content)) : nullptr;
  if (gain) return with_gains(table, *gain, family);
  family.prefilter = prefilter_in(table, family.n);
  return family;
}

Horizon horizon_in(const Value& root) {
  const Value& value = need(root, "horizon", "a number of dead times, or \"auto\"").value;
  const auto automatic = [](std::string_view word) {
    return word == "auto" ? std::optional(Horizon::until_settled()) : std::nullopt;
  };
  if (std::holds_alternative<std::string>(value.content)) return thing_in("horizon", value, automatic, {"auto"});
  if (!is_number(value)) throw_wrong_kind("horizon", value, "a number or \"auto\"");
  const double dead_times = number_in("horizon", value);
  if (dead_times > 0 && dead_times <= kHorizonCap) return Horizon::fixed(dead_times);
  throw InputError(value.place, fmt::format("\"horizon\" must be above 0 and at most {}, or \"auto\" (it is {})",
                                            kHorizonCap, number_text(dead_times)));
}

Precision precision_in(const Value::Table& root) {
  const auto named = [](std::string_view word) -> std::optional<Precision> {
    if (word == "double") return Precision::real64;
    if (word == "single") return Precision::real32;
    return std::nullopt;
  };
  const Entry* entry = find(root, "precision");
  return entry ? thing_in("precision", entry->value, named, {"double", "single"}) : Precision::real64;
}

Words measure_names() {
  Words names;
  for (const Measure measure : all_measures()) names.push_back(to_string(measure));
  return names;
}

std::optional<double> sampling_in(const Value::Table& root) {
  const Entry* entry = find(root, "sampling");
  if (!entry) return std::nullopt;
  const double dead_times = number_in("sampling", entry->value);
  if (dead_times > 0 && dead_times <= kHorizonCap) return dead_times;
  throw InputError(entry->value.place, fmt::format("\"sampling\" must be above 0 and at most {} (it is {})",
                                                   kHorizonCap, number_text(dead_times)));
}

std::vector<Measure> usual_measures(const Grid& grid) {
  std::vector<Measure> usual;
  for (const Measure measure : standard_measures())
    if (grid.sampling || measure != Measure::noise_gain) usual.push_back(measure);
  if (!grid.noise) return usual;
  const auto noisy = noisy_measures();
  usual.insert(usual.end(), noisy.begin(), noisy.end());
  return usual;
}

std::vector<Measure> measures_in(const Value::Table& root, const Grid& grid) {
  const Entry* entry = find(root, "measures");
  if (!entry) return usual_measures(grid);
  std::vector<Measure> kept;
  for (const Value& item : list_in("measures", entry->value)) {
    kept.push_back(thing_in("measure", item, measure_named, measure_names()));
    if (kept.back() == Measure::noise_gain && !grid.sampling)
      throw InputError(item.place,
                       "measure \"noise_gain\" needs the key \"sampling\": over how many dead times noise "
                       "is held, as in sampling = 0.1");
    if (is_noisy(kept.back()) && !grid.noise)
      throw InputError(item.place,
                       fmt::format("measure \"{}\" needs the key \"noise\", the amplitude of the noise, as in "
                                   "noise = 0.01",
                                   to_string(kept.back())));
    if (std::count(kept.begin(), kept.end(), kept.back()) > 1)
      throw InputError(item.place, fmt::format("measure \"{}\" stands twice in the list", to_string(kept.back())));
  }
  if (kept.empty())
    throw InputError(entry->value.place, "\"measures\" is empty: leave the key out to keep every measure");
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::string title_in(const Value::Table& root) {
  const Entry* entry = find(root, "title");
  return entry ? text_in("title", entry->value) : std::string();
}

/// In C, since a stream does not say why it failed.
std::string read_text(const std::filesystem::path& path) {
  const auto fail = [&] {
    throw InputError({path.string()}, fmt::format("cannot be read: {}", std::strerror(errno)));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail();
  std::string text;
  std::array<char, 65536> piece;
  while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), file.get()))
    text.append(piece.data(), size);
  if (std::ferror(file.get())) fail();
  return text;
}

std::int64_t whole_number_at_least(std::int64_t least, std::int64_t most, std::int64_t usual, const char* key,
                                   const Value::Table& root) {
  const Entry* entry = find(root, key);
  if (!entry) return usual;
  const std::int64_t value = whole_number_in(key, entry->value);
  if (least <= value && value <= most) return value;
  throw InputError(entry->value.place, fmt::format("\"{}\" must be {} .. {} (it is {})", key, least, most, value));
}

Noise::Kind noise_kind_in(const Value::Table& root) {
  const Entry* entry = find(root, "noise_kind");
  const Words names(kNoiseKindNames.begin(), kNoiseKindNames.end());
  return entry ? thing_in("noise_kind", entry->value, noise_kind_named, names) : Noise::Kind::uniform;
}

constexpr std::int64_t kMostSeeds = 10'000;

void refuse_sampled(const Value::Table& root) {
  if (const Entry* sampled = find(root, "sampled"))
    throw InputError(
        sampled->place,
        "\"sampled\": a sweep's controllers are continuous; portrait simulate --sampled runs one at the "
        "sampling time");
}

/// What belongs to noise means nothing without it.
void refuse_without_noise(const Value::Table& root) {
  for (const char* key : {"noise_kind", "seed", "seeds"})
    if (const Entry* entry = find(root, key))
      throw InputError(entry->place,
                       fmt::format("\"{}\" needs the key \"noise\", the amplitude of the noise", key));
}

/// So much is drawn once for all settings, and so many samples are held for those in hand.
void check_size(const NoiseTrials& trials, Horizon horizon, const Place& place) {
  const std::size_t samples = samples_up_to(horizon.dead_times, trials.noise.sampling);
  if (samples > kernel::kMostNoiseSamples)
    throw InputError(
        place, fmt::format("\"noise\": horizon over sampling gives {} samples: a sweep takes at most {}", samples,
                           kernel::kMostNoiseSamples));
  if (samples * static_cast<std::size_t>(trials.seeds) > kernel::kMostNoiseValues)
    throw InputError(place, fmt::format("\"noise\": {} samples for {} seeds: a sweep draws at most {} values",
                                        samples, trials.seeds, kernel::kMostNoiseValues));
}

std::optional<NoiseTrials> noise_in(const Value::Table& root, const Grid& grid) {
  const Entry* entry = find(root, "noise");
  if (!entry) return refuse_without_noise(root), std::nullopt;
  NoiseTrials trials;
  trials.noise.amplitude = number_in("noise", entry->value);
  if (!std::isfinite(trials.noise.amplitude) || trials.noise.amplitude <= 0)
    throw InputError(entry->value.place, fmt::format("\"noise\" must be finite and above 0 (it is {})",
                                                     number_text(trials.noise.amplitude)));
  if (!grid.sampling)
    throw InputError(entry->place,
                     "\"noise\" needs the key \"sampling\": over how many dead times a value is held, as "
                     "in sampling = 0.1");
  if (grid.horizon.automatic)
    throw InputError(entry->place, "\"noise\" needs a fixed horizon: TV of a noisy signal grows with it");
  trials.noise.sampling = *grid.sampling;
  trials.noise.kind = noise_kind_in(root);
  trials.noise.seed = static_cast<std::uint64_t>(
      whole_number_at_least(0, std::numeric_limits<std::int64_t>::max(), 1, "seed", root));
  trials.seeds = static_cast<int>(whole_number_at_least(1, kMostSeeds, 1, "seeds", root));
  check_size(trials, grid.horizon, entry->place);
  return trials;
}

/// An ideal derivative makes an impulse of every value: neither the kernel nor the reference has a response to that.
void check_noise_passes(const Value::Table& root, const Grid& grid) {
  if (!grid.noise || grid.family.n > 0) return;
  const auto is_derivative = [](Parameter p) { return p == Parameter::delta || p == Parameter::tau_d; };
  const bool on_axis =
      std::any_of(grid.axes.begin(), grid.axes.end(), [&](const Axis& a) { return is_derivative(a.parameter()); });
  const bool fixed = std::any_of(grid.fixed.begin(), grid.fixed.end(), [&](const FixedParameter& f) {
    return is_derivative(f.parameter) && f.value != 0;
  });
  if (on_axis || fixed)
    throw InputError(
        find(root, "noise")->place,
        "\"noise\": the ideal derivative of n = 0 makes an impulse of every value; give the controller a "
        "filter, n = 1 or more");
}

}  // namespace

Grid parse_grid(std::string text, std::string source_name) {
  const Value root = parse_toml(text, source_name);
  const auto& table = std::get<Value::Table>(root.content);
  refuse_sampled(table);
  allow_only(table, {"title", "plant", "j", "n", "prefilter", "horizon", "sampling", "noise", "noise_kind", "seed",
                     "seeds", "precision", "measures", "parameters"});
  Grid grid;
  grid.title = title_in(table);
  grid.family = family_in(root);
  grid.horizon = horizon_in(root);
  grid.precision = precision_in(table);
  grid.sampling = sampling_in(table);
  grid.noise = noise_in(table, grid);
  grid.measures = measures_in(table, grid);
  read_parameters(need(root, "parameters", "the table of fixed values and axes").value, grid);
  check_noise_passes(table, grid);
  grid.text = std::move(text);
  return grid;
}

Grid read_grid(const std::filesystem::path& path) { return parse_grid(read_text(path), path.string()); }

}  // namespace portrait
