/// portrait plot responses, nyquist, bars: single loops side by side.

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/stability.h"
#include "engine/sweep/method.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/pictures/text.h"
#include "tools/plot_arguments.h"
#include "tools/plot_verb.h"

namespace portrait::tools {
namespace {

using pictures::NamedLoop;

constexpr const char* kResponsesHelp =
    R"(Example:
  portrait plot responses --plant dipdt --setting 'PPM (47): kappa=0.24 tau_i=8 delta=0.7' \
      --setting 'QRDP (22): kappa=0.1248 tau_i=10.324 delta=0.5045' --horizon 60 -o responses.svg
  portrait plot responses huba.h5 --minimize IAE_d --where 'Ms <= 2' --plant K=2,Td=0.5 -o responses.pdf

y and u of several settings after a unit step of the setpoint and of the input disturbance.
With a portrait its plant, filter and prefilter are used, and --minimize adds its optimum.)";

constexpr const char* kNyquistHelp =
    R"(Example:
  portrait plot nyquist --plant dipdt --setting 'PPM (47): kappa=0.24 tau_i=8 delta=0.7' -o nyquist.svg

The open loop L(j omega) of several settings, each with the circle of radius 1/Ms about -1
that it touches; --Ms draws the circle of one bound instead.)";

constexpr const char* kBarsHelp =
    R"(Example:
  portrait plot bars --plant dipdt --setting 'PPM: kappa=0.24 tau_i=8 delta=0.7' \
      --setting 'QRDP: kappa=0.1248 tau_i=10.324 delta=0.5045' --measures IAE_w,IAE_d,TV2_uw,Ms -o bars.svg

Measures of several settings, a panel a measure and a bar a setting.)";

struct LoopsArguments : PlotArguments {
  std::vector<std::string> measures = {"IAE_w", "IAE_d", "TV2_uw", "TV2_ud", "TV0_yw", "Ms"};
  double Ms = 0;
};

struct Loops {
  std::vector<NamedLoop> named;
  std::optional<RealPlant> plant;
};

NamedLoop optimum_of(const PlotArguments& a, const PortraitReader& portrait) {
  const Answer answer = ask(portrait, question_argument(a, portrait.grid()));
  if (answer.top.empty())
    throw InputError("no admissible setting: loosen a constraint (portrait query says which)");
  return {"optimum: " + setting_text({portrait.grid().family, answer.top.front().setting}),
          {portrait.grid().family, answer.top.front().setting}};
}

void add_from_portrait(const PlotArguments& a, Loops& loops) {
  const PortraitReader portrait(a.file);
  const Grid& grid = portrait.grid();
  if (a.n >= 0 || !a.prefilter.empty())
    throw InputError("--n and --prefilter have no place here: the portrait says them");
  loops.plant = plant_argument(a.plant, grid.family.plant).real;
  for (const std::string& text : a.settings)
    loops.named.push_back(named_loop(text, grid.family, fixed_setting(grid)));
  if (!a.minimize.empty()) loops.named.insert(loops.named.begin(), optimum_of(a, portrait));
}

Loops loops_from(const PlotArguments& a) {
  Loops loops;
  if (!a.file.empty()) {
    add_from_portrait(a, loops);
  } else {
    if (!a.minimize.empty() || !a.where.empty()) throw InputError("--minimize and --where need a portrait file");
    const PlantArgument plant = plant_argument(a.plant, std::nullopt);
    loops.plant = plant.real;
    for (const std::string& text : a.settings)
      loops.named.push_back(named_loop(text, family_argument(a, plant.family), {}));
  }
  if (loops.named.empty()) throw InputError("nothing to draw: give --setting, or a portrait and --minimize");
  return loops;
}

std::string title_of(const PlotArguments& a, const char* usual, const Loops& loops) {
  if (!a.title.empty()) return a.title;
  const std::string plant = loops.plant
                                ? plant_text(*loops.plant)
                                : std::string(to_string(loops.named.front().loop.family.plant)) + ", normalised";
  return fmt::format("{}, {}", usual, plant);
}

int done(const PlotArguments& a, const Invocation& invocation, const std::string& title,
         const pictures::Script& script) {
  pictures::draw(script, a.output, about(title, invocation.command_line));
  return kDone;
}

int responses(const LoopsArguments& a, const Invocation& invocation) {
  const Loops loops = loops_from(a);
  const Horizon horizon = horizon_argument("--horizon", a.horizon);
  for (const NamedLoop& named : loops.named)
    if (horizon.automatic && !is_stable(open_loop(named.loop)))
      throw InputError(fmt::format("\"{}\" is unstable and never settles: give --horizon", named.label));
  const std::string title = title_of(a, "Responses", loops);
  return done(a, invocation, title, pictures::responses(title, loops.named, horizon, loops.plant));
}

int nyquist(const LoopsArguments& a, const Invocation& invocation) {
  const Loops loops = loops_from(a);
  const std::string title = a.title.empty() ? "Open loop L(j omega)" : a.title;
  return done(a, invocation, title, pictures::nyquist(title, loops.named, a.Ms));
}

std::vector<MeasureRow> measured(const Loops& loops, const Horizon& horizon) {
  std::vector<MeasureRow> rows;
  for (const NamedLoop& named : loops.named) {
    SettingMeasured result;
    measure_settings(Method::kernel, named.loop.family, horizon, {}, {&named.loop.setting, 1}, {&result, 1});
    rows.push_back(result.measures);
  }
  return rows;
}

int bars(const LoopsArguments& a, const Invocation& invocation) {
  const Loops loops = loops_from(a);
  const std::vector<MeasureRow> rows = measured(loops, horizon_argument("--horizon", a.horizon));
  std::vector<std::string> labels;
  for (const NamedLoop& named : loops.named) labels.push_back(named.label);
  std::vector<pictures::Bars> panels;
  for (const std::string& name : a.measures) {
    const Measure measure = measure_argument("--measures", name);
    pictures::Bars& panel = panels.emplace_back();
    panel.label = pictures::short_label(measure, loops.plant.has_value());
    for (const MeasureRow& row : rows)
      panel.values.push_back(row[measure] * (loops.plant ? scale(measure, *loops.plant) : 1));
  }
  const std::string title = title_of(a, "Measures", loops);
  return done(a, invocation, title, pictures::bars(title, labels, panels));
}

using Run = int (*)(const LoopsArguments&, const Invocation&);

CLI::App* add_kind(CLI::App& plot, Invocation& invocation, const char* name, const char* line, const char* help,
                   const std::shared_ptr<LoopsArguments>& a, Run run) {
  CLI::App* kind = add_verb(plot, name, line, help);
  kind->add_option("file", a->file, "portrait file, for its plant, filter, prefilter and optimum");
  add_output(*kind, *a);
  add_loops(*kind, *a, "LABEL: kappa=.. tau_i=.. delta=..; any number of times");
  add_question(*kind, *a);
  kind->callback([a, run, &invocation] { invocation.exit_code = run(*a, invocation); });
  return kind;
}

}  // namespace

void add_plot_responses(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<LoopsArguments>();
  CLI::App* kind = add_kind(plot, invocation, "responses", "y and u of several settings after both steps",
                            kResponsesHelp, a, responses);
  kind->add_option("--horizon", a->horizon, "dead times to draw, or auto")->capture_default_str();
}

void add_plot_nyquist(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<LoopsArguments>();
  CLI::App* kind = add_kind(plot, invocation, "nyquist", "open loops in the complex plane, with Ms circles",
                            kNyquistHelp, a, nyquist);
  kind->add_option("--Ms", a->Ms, "draw the circle of this bound")->check(CLI::Range(1.0, 1e6));
}

void add_plot_bars(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<LoopsArguments>();
  CLI::App* kind = add_kind(plot, invocation, "bars", "measures of several settings as bars", kBarsHelp, a, bars);
  kind->add_option("--measures", a->measures, "which, with commas between them")
      ->delimiter(',')
      ->capture_default_str();
  kind->add_option("--horizon", a->horizon, "dead times to simulate, or auto")->capture_default_str();
}

}  // namespace portrait::tools
