/// portrait info: what a portrait holds and where it comes from.

#include <fmt/format.h>

#include "engine/base/words.h"
#include "engine/loop/parameters.h"
#include "portraits/reader.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/run_state.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait info huba.h5

Shows what a portrait holds: plant, controller, axes, measures, how it was made. Of a sweep that
still runs or was stopped it shows state, progress and health of every shard.)";

Json json_axes(const Grid& grid) {
  Json axes = Json::array();
  for (const Axis& axis : grid.axes) {
    Json values = Json::array();
    for (const double value : axis.values()) values.push_back(json_number(value));
    axes.push_back({{"name", axis.name()}, {"count", axis.size()}, {"values", values}});
  }
  return axes;
}

Json json_fixed(const Grid& grid) {
  Json fixed = Json::object();
  for (const FixedParameter& p : grid.fixed) fixed[std::string(to_string(p.parameter))] = json_number(p.value);
  return fixed;
}

Json json_measure_names(const Grid& grid) {
  Json names = Json::array();
  for (const Measure m : grid.measures) names.push_back(to_string(m));
  return names;
}

Json json_horizon(const Horizon& horizon) { return horizon.automatic ? Json("auto") : Json(horizon.dead_times); }

Json json_noise(const Grid& grid) {
  if (!grid.noise) return nullptr;
  const Noise& noise = grid.noise->noise;
  return {{"kind", to_string(noise.kind)},
          {"amplitude", noise.amplitude},
          {"seed", noise.seed},
          {"seeds", grid.noise->seeds}};
}

void print_as_json(const Grid& grid, const Facts& facts) {
  print_json({{"settings", setting_count(grid)},
              {"axes", json_axes(grid)},
              {"fixed", json_fixed(grid)},
              {"measures", json_measure_names(grid)},
              {"plant", to_string(grid.family.plant)},
              {"n", grid.family.n},
              {"prefilter", to_string(grid.family.prefilter)},
              {"horizon", json_horizon(grid.horizon)},
              {"sampling", grid.sampling ? Json(*grid.sampling) : Json(nullptr)},
              {"noise", json_noise(grid)},
              {"precision", grid.precision == Precision::real64 ? "double" : "single"},
              {"title", grid.title},
              {"state", facts.state},
              {"schema_version", facts.schema_version},
              {"program", facts.program},
              {"method", facts.method},
              {"history", facts.history},
              {"date_created", facts.date_created},
              {"seconds", facts.wall_seconds},
              {"threads", facts.threads}});
}

std::string axis_text(const Axis& axis) {
  return fmt::format("  {:<7} {:>6} values, {} .. {}\n", axis.name(), grouped(axis.size()), number_text(axis[0]),
                     number_text(axis[axis.size() - 1]));
}

std::string measures_text(const Grid& grid) {
  std::vector<std::string_view> names;
  for (const Measure m : grid.measures) names.push_back(to_string(m));
  return joined(names);
}

std::string noise_text(const Grid& grid) {
  const std::string held = fmt::format("noise held over {} dead times\n", number_text(*grid.sampling));
  if (!grid.noise) return held;
  const Noise& noise = grid.noise->noise;
  return fmt::format("{} noise of {}, {} seeds from {}; {}", to_string(noise.kind), number_text(noise.amplitude),
                     grid.noise->seeds, noise.seed, held);
}

void print_as_text(const Grid& grid, const Facts& facts) {
  std::string text = grid.title.empty() ? "" : grid.title + "\n";
  text += fmt::format("{}, n = {}, prefilter {}, horizon {}\n", to_string(grid.family.plant), grid.family.n,
                      to_string(grid.family.prefilter),
                      grid.horizon.automatic ? "auto" : number_text(grid.horizon.dead_times) + " dead times");
  if (grid.sampling) text += noise_text(grid);
  text += fmt::format("{} settings\n", grouped(setting_count(grid)));
  for (const Axis& axis : grid.axes) text += axis_text(axis);
  for (const FixedParameter& p : grid.fixed)
    text += fmt::format("  {:<7} fixed at {}\n", to_string(p.parameter), number_text(p.value));
  text += fmt::format("measures  {}\n", measures_text(grid));
  text += fmt::format("made by   {}, method {}, {} on {} threads\n", facts.program, facts.method,
                      duration_text(facts.wall_seconds), facts.threads);
  text += fmt::format("history   {}\nstate     {}, format {}\n", facts.history, facts.state, facts.schema_version);
  print_text(text);
}

}  // namespace

void add_info(CLI::App& app, Invocation& invocation) {
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* verb = add_verb(app, "info", "what a portrait holds and where it comes from", kHelp);
  verb->add_option("file", *file, "portrait file")->required();
  verb->add_flag("--json", *json, "one JSON object instead of text");
  verb->callback([file, json, &invocation] {
    if (const auto folder = run_folder_meant(*file)) {
      invocation.exit_code = print_run_state(*folder, *json);
      return;
    }
    const PortraitReader portrait(*file);
    if (*json)
      print_as_json(portrait.grid(), portrait.facts());
    else
      print_as_text(portrait.grid(), portrait.facts());
    invocation.exit_code = kDone;
  });
}

}  // namespace portrait::tools
