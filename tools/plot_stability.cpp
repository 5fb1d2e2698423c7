/// portrait plot stability: where a loop is stable, over a plane of two parameters.

#include <fmt/format.h>

#include "engine/base/error.h"
#include "tools/exit_codes.h"
#include "tools/pictures/stability_limit.h"
#include "tools/pictures/text.h"
#include "tools/plot_arguments.h"
#include "tools/plot_verb.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait plot stability --plant dipdt --x kappa=0.001..0.6 --y delta=0.01..1.6 --at tau_i=8 -o limit.svg

The limit of stability over a plane of two parameters: roots of the characteristic
quasi-polynomial are counted exactly, and the limit between two points is found by halving.)";

struct StabilityArguments : PlotArguments {
  std::string x, y;
  int nodes = 161;
};

pictures::Plane plane_from(const StabilityArguments& a, const LoopFamily& family, Parameter x, Parameter y) {
  if (x == y) throw InputError("--x and --y name the same parameter");
  pictures::Plane plane{{family, {}}, x, y};
  for (const std::string& text : a.at) {
    const ParameterRange value = range_argument("--at", text);
    if (value.from != value.to) throw InputError("--at takes one value, NAME=VALUE");
    set(plane.base.setting, value.parameter, value.from);
  }
  for (const Parameter p : {x, y})
    if (!applies(p, family)) throw InputError(fmt::format("this loop has no {}", to_string(p)));
  return plane;
}

std::string held_text(const StabilityArguments& a) {
  std::string text;
  for (const std::string& value : a.at) text += ", " + value;
  return text;
}

int stability(const StabilityArguments& a, const Invocation& invocation) {
  const PlantArgument plant = plant_argument(a.plant, std::nullopt);
  const ParameterRange x = range_argument("--x", a.x), y = range_argument("--y", a.y);
  if (x.from == x.to || y.from == y.to) throw InputError("--x and --y take ranges, NAME=FROM..TO");
  const pictures::Plane plane = plane_from(a, family_argument(a, plant.family), x.parameter, y.parameter);
  const auto nodes = static_cast<std::size_t>(a.nodes);
  const pictures::Field field = pictures::stability(plane, pictures::spread(x.from, x.to, nodes, false),
                                                    pictures::spread(y.from, y.to, nodes, false));
  pictures::StabilityPicture picture;
  picture.title = a.title.empty() ? fmt::format("Stable settings, {}, n = {}{}", to_string(plant.family),
                                                plane.base.family.n, held_text(a))
                                  : a.title;
  picture.x_label = pictures::label(x.parameter, plant.family);
  picture.y_label = pictures::label(y.parameter, plant.family);
  for (const std::string& text : a.settings) {
    const auto named = named_loop(text, plane.base.family, plane.base.setting);
    picture.marks.push_back(
        {{get(named.loop.setting, x.parameter), get(named.loop.setting, y.parameter)}, named.label});
  }
  pictures::draw(pictures::script(picture, plane, field), a.output, about(picture.title, invocation.command_line));
  return kDone;
}

}  // namespace

void add_plot_stability(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<StabilityArguments>();
  CLI::App* kind = add_verb(plot, "stability", "where a loop is stable, over a plane of two parameters", kHelp);
  add_output(*kind, *a);
  add_loops(*kind, *a, "LABEL: kappa=.. delta=..: a point to mark; any number of times");
  kind->add_option("--x", a->x, "NAME=FROM..TO")->required();
  kind->add_option("--y", a->y, "NAME=FROM..TO")->required();
  add_many(*kind, "--at", a->at, "NAME=VALUE of another parameter; any number of times");
  kind->add_option("--nodes", a->nodes, "along each axis")->check(CLI::Range(2, 2000))->capture_default_str();
  kind->callback([a, &invocation] { invocation.exit_code = stability(*a, invocation); });
}

}  // namespace portrait::tools
