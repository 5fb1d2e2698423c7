#include "portraits/stored_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/kernel/noise.h"
#include "portraits/digest.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

template <typename Items, typename Name>
std::string names_of(const Items& items, Name name) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(name(item));
  return schema::names_text(names);
}

void write_noise(const h5::File& file, const NoiseTrials& trials) {
  file.set_real("noise", trials.noise.amplitude);
  file.set_text("noise_kind", std::string(to_string(trials.noise.kind)));
  file.set_integer("noise_seed", static_cast<std::int64_t>(trials.noise.seed));
  file.set_integer("noise_seeds", trials.seeds);
}

void write_family(const h5::File& file, const Grid& grid) {
  file.set_text("plant", std::string(to_string(grid.family.plant)));
  file.set_integer("n", grid.family.n);
  if (grid.family.plant == Plant::jotd) file.set_integer("j", grid.family.j);
  if (has_gains(grid.family)) file.set_integer("m", grid.family.m);
  file.set_text("prefilter", std::string(to_string(grid.family.prefilter)));
  file.set_text("horizon", schema::horizon_text(grid.horizon));
  if (grid.sampling) file.set_real("sampling", *grid.sampling);
  if (grid.noise) write_noise(file, *grid.noise);
  file.set_text("precision", schema::precision_text(grid.precision));
}

void write_parameter(const h5::Dataset& dataset, Parameter parameter, const Grid& grid,
                     const std::vector<double>& values) {
  write_plain(dataset, values);
  dataset.set_text("units", "1");
  dataset.set_text("long_name", std::string(info(parameter).long_name));
  dataset.set_text("normalisation", normalisation(parameter, grid.family.plant));
}

[[noreturn]] void broken(const h5::File& file, const std::string& what) {
  throw IntegrityError(fmt::format("{}: {}", file.origin().file, what));
}

/// The word an attribute holds, as what `named` makes of it.
template <typename Named>
auto read_word(const h5::File& file, const char* attribute, Named named) {
  const std::string word = file.text(attribute);
  const auto found = named(word);
  if (!found) broken(file, fmt::format("attribute {} says \"{}\"", attribute, word));
  return *found;
}

std::optional<Precision> precision_named(std::string_view word) {
  if (word == "double") return Precision::real64;
  if (word == "single") return Precision::real32;
  return std::nullopt;
}

std::optional<Horizon> horizon_named(std::string_view word) {
  if (word == "auto") return Horizon::until_settled();
  const std::optional<double> number = parse_number(word);
  if (!number || !std::isfinite(*number) || *number <= 0) return std::nullopt;
  return Horizon::fixed(*number);
}

/// Files of format 1.0 have none.
std::optional<double> read_sampling(const h5::File& file) {
  if (!file.has("sampling")) return std::nullopt;
  const double dead_times = file.real("sampling");
  if (!std::isfinite(dead_times) || dead_times <= 0)
    broken(file, fmt::format("attribute sampling is {}", number_text(dead_times)));
  return dead_times;
}

/// Only portraits of a grid with noise have it.
std::optional<NoiseTrials> read_noise(const h5::File& file, const std::optional<double>& sampling) {
  if (!file.has("noise")) return std::nullopt;
  NoiseTrials trials;
  trials.noise.amplitude = file.real("noise");
  trials.noise.kind = read_word(file, "noise_kind", noise_kind_named);
  const std::int64_t seed = file.integer("noise_seed"), seeds = file.integer("noise_seeds");
  if (!sampling) broken(file, "noise without sampling");
  if (!std::isfinite(trials.noise.amplitude) || trials.noise.amplitude <= 0 || seed < 0 || seeds < 1 ||
      seeds > static_cast<std::int64_t>(kernel::kMostNoiseValues))
    broken(file, fmt::format("attributes noise, noise_seed, noise_seeds are {}, {}, {}",
                             number_text(trials.noise.amplitude), seed, seeds));
  trials.noise.sampling = *sampling;
  trials.noise.seed = static_cast<std::uint64_t>(seed), trials.seeds = static_cast<int>(seeds);
  return trials;
}

/// A reader may ask for the noisy measures again.
void check_noise(const h5::File& file, const Grid& grid) {
  if (!grid.noise) return;
  const bool fits =
      !grid.horizon.automatic &&
      grid.horizon.dead_times / grid.noise->noise.sampling < static_cast<double>(kernel::kMostNoiseSamples) &&
      samples_up_to(grid.horizon.dead_times, grid.noise->noise.sampling) *
              static_cast<std::size_t>(grid.noise->seeds) <=
          kernel::kMostNoiseValues;
  if (!fits) broken(file, "its noise asks for more values than a sweep draws");
}

int order_in(const h5::File& file, const char* attribute) {
  const std::int64_t order = file.integer(attribute);
  if (order < 0 || order > kMaxFilterOrder) broken(file, fmt::format("attribute {} is {}", attribute, order));
  return static_cast<int>(order);
}

LoopFamily read_family(const h5::File& file) {
  const std::int64_t n = file.integer("n");
  if (n < 0 || n > kMaxFilterOrder) broken(file, fmt::format("attribute n is {}", n));
  const LoopFamily family{.plant = read_word(file, "plant", plant_named),
                          .n = static_cast<int>(n),
                          .prefilter = read_word(file, "prefilter", prefilter_named),
                          .j = file.has("j") ? order_in(file, "j") : 0,
                          .m = file.has("m") ? order_in(file, "m") : -1};
  if (const auto why = why_invalid(family)) broken(file, *why);
  return family;
}

Parameter read_parameter_name(const h5::File& file, const LoopFamily& family, const std::string& name) {
  const std::optional<Parameter> parameter = parameter_named(name);
  if (!parameter || !applies(*parameter, family)) broken(file, fmt::format("{} is no parameter of its loop", name));
  return *parameter;
}

Axis read_axis(const h5::File& file, const LoopFamily& family, const std::string& name) {
  const Parameter parameter = read_parameter_name(file, family, name);
  std::vector<double> values = read_reals(file, name, 1);
  // Not "greater or equal": nothing holds of a NaN.
  const auto not_below = std::not_fn(std::less<>());
  const bool increasing = std::adjacent_find(values.begin(), values.end(), not_below) == values.end();
  if (values.empty() || std::isnan(values.front()) || !increasing)
    broken(file, fmt::format("the values of axis {} do not increase", name));
  return Axis::list(parameter, std::move(values));
}

Measure read_measure_name(const h5::File& file, const std::string& name) {
  const std::optional<Measure> measure = measure_named(name);
  if (!measure)
    throw InputError(fmt::format("{}: this portrait has a measure {}, which this program does not know",
                                 file.origin().file, name));
  return *measure;
}

std::vector<Measure> read_measures(const h5::File& file) {
  std::vector<Measure> measures;
  for (const std::string& name : schema::names_in(file.text("measures")))
    measures.push_back(read_measure_name(file, name));
  if (std::adjacent_find(measures.begin(), measures.end(), std::greater_equal<>()) != measures.end())
    broken(file, "attribute measures does not name each measure once, in their order");
  return measures;
}

void check_count(const h5::File& file, const Grid& grid) {
  std::uint64_t count = 1;
  for (const Axis& axis : grid.axes) {
    if (axis.size() > std::numeric_limits<std::int64_t>::max() / count) broken(file, "the grid is too large");
    count *= axis.size();
  }
  if (file.integer("settings") != static_cast<std::int64_t>(count))
    broken(file, fmt::format("attribute settings is not {}, the product of the axes", count));
}

std::string read_text(const h5::File& file) {
  std::string text = file.text("grid_toml");
  if (digest_text(digest_of(text)) != file.text("grid_xxh3_64"))
    broken(file, "attribute grid_toml is not what was written (its digest differs)");
  return text;
}

}  // namespace

void write_grid(const h5::File& file, const Grid& grid) {
  write_family(file, grid);
  file.set_integer("settings", static_cast<std::int64_t>(setting_count(grid)));
  file.set_text("grid_axes", names_of(grid.axes, [](const Axis& a) { return a.name(); }));
  file.set_text("grid_fixed", names_of(grid.fixed, [](const FixedParameter& f) { return to_string(f.parameter); }));
  file.set_text("measures", names_of(grid.measures, [](Measure m) { return to_string(m); }));
  file.set_text("grid_toml", grid.text);
  file.set_text("grid_xxh3_64", digest_text(digest_of(grid.text)));
  for (const Axis& axis : grid.axes) {
    const h5::Dataset dataset = file.create_dataset(std::string(axis.name()), schema::axis_layout(axis.size()));
    write_parameter(dataset, axis.parameter(), grid, axis.values());
    dataset.make_scale(std::string(axis.name()));
  }
  for (const FixedParameter& fixed : grid.fixed)
    write_parameter(file.create_dataset(std::string(to_string(fixed.parameter)), schema::fixed_layout()),
                    fixed.parameter, grid, {fixed.value});
}

Grid read_grid(const h5::File& file) {
  Grid grid{.title = file.text("title"),
            .family = read_family(file),
            .horizon = read_word(file, "horizon", horizon_named),
            .sampling = read_sampling(file),
            .noise = {},
            .precision = read_word(file, "precision", precision_named),
            .measures = read_measures(file),
            .axes = {},
            .fixed = {},
            .text = read_text(file)};
  for (const std::string& name : schema::names_in(file.text("grid_axes")))
    grid.axes.push_back(read_axis(file, grid.family, name));
  for (const std::string& name : schema::names_in(file.text("grid_fixed")))
    grid.fixed.push_back({read_parameter_name(file, grid.family, name), read_reals(file, name, 0).front()});
  grid.noise = read_noise(file, grid.sampling);
  check_noise(file, grid);
  check_count(file, grid);
  return grid;
}

void attach_axes(const h5::File& file, const h5::Dataset& column, const Grid& grid) {
  for (std::uint32_t k = 0; k < grid.axes.size(); ++k) {
    const std::string name(grid.axes[k].name());
    column.attach_scale(k, file.dataset(name), name);
  }
}

}  // namespace portrait
