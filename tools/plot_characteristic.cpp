/// portrait plot characteristic: speed against effort and wobbling, a curve a family of loops.

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "tools/arguments.h"
#include "tools/characteristic.h"
#include "tools/exit_codes.h"
#include "tools/pictures/characteristic.h"
#include "tools/pictures/text.h"
#include "tools/plot_arguments.h"
#include "tools/plot_verb.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait plot characteristic --plant tf:1/1,4,6,4,1 --curve 'SIMC: --pid standard:Kc={},Ti=1.5 --vary 0.3,0.35,0.4' \
      --curve 'model-based: --pid standard:Kc={},Ti=2.5 --vary 0.6,0.7,0.8' -o curves.svg
  portrait plot characteristic --plant ipdt --kappa {} --tau-i 8 --vary 0.2:0.6:9 -o one.svg

Draws what portrait characteristic prints: the deviations of u (left) and y (right) from their
ideal shapes, and the integral of the error. --curve takes options of a loop, which add to those
on the line or take their place; a curve each, its first and last value of {} beside it.)";

struct PlotCharacteristicArguments : PlotArguments {
  CharacteristicArguments common;
  std::vector<std::string> curves;
};

struct NamedLine {
  std::string label, options;
};

/// "SIMC: --pid ..." A label ends before the first option.
NamedLine named_line(const std::string& text) {
  const std::size_t colon = text.find(':'), dashes = text.find("--");
  if (colon == std::string::npos || colon > dashes) return {text, text};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

/// The option names of a curve, for the nearest one to a wrong word.
std::string nearest_option(const CLI::App& line, const std::string& options) {
  std::vector<std::string> known;
  for (const CLI::Option* option : line.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (std::size_t at = 0; (at = options.find("--", at)) != std::string::npos;) {
    const std::size_t end = std::min(options.find_first_of(" =", at), options.size());
    const std::string word = options.substr(at, end - at);
    if (std::find(known.begin(), known.end(), word) == known.end())
      return fmt::format("unknown option \"{}\"{}", word, suggestion(word, {known.begin(), known.end()}));
    at = end;
  }
  return "";
}

CharacteristicArguments with_options(CharacteristicArguments a, const std::string& text,
                                     const std::string& options) {
  CLI::App line;
  line.set_help_flag();
  add_characteristic_options(line, a);
  for (const char* name : {"--plant", "--vary"}) line.get_option(name)->required(false);
  try {
    line.parse(options);
  } catch (const CLI::ParseError& error) {
    const std::string nearest = nearest_option(line, options);
    throw InputError(fmt::format("--curve \"{}\": {}", text, nearest.empty() ? error.what() : nearest));
  }
  return a;
}

pictures::CharacteristicCurve curve_of(const std::string& label, const CharacteristicArguments& a) {
  if (a.loop.plant.empty()) throw InputError("--plant is missing, on the line or in --curve");
  if (a.vary.empty()) throw InputError("--vary is missing, on the line or in --curve");
  pictures::CharacteristicCurve curve{label, {}};
  for (const CharacteristicPoint& p : points_of(a))
    curve.points.push_back({p.speed, p.effort, p.wobbling, fmt::format("{:.4g}", *parse_number(p.value))});
  return curve;
}

/// The axes have the names of the common measures: a curve with others would be read wrongly.
void require_same_measures(const std::string& text, const CharacteristicArguments& curve,
                           const CharacteristicArguments& common) {
  if (curve.speed != common.speed || curve.effort != common.effort || curve.wobbling != common.wobbling)
    throw InputError(fmt::format("--curve \"{}\": --speed, --effort and --wobbling belong on the line", text));
}

std::string axis_label(const char* option, const std::string& name) {
  const Measure measure = measure_argument(option, name);
  return fmt::format("{} [{}]", name, pictures::unit_text(info(measure).unit, true));
}

int plot(const PlotCharacteristicArguments& a, const Invocation& invocation) {
  pictures::Characteristics picture;
  picture.title = a.title.empty() ? "Speed over effort (left) and wobbling (right)" : a.title;
  picture.speed_label = axis_label("--speed", a.common.speed);
  picture.effort_label = axis_label("--effort", a.common.effort);
  picture.wobbling_label = axis_label("--wobbling", a.common.wobbling);
  for (const std::string& text : a.curves) {
    const NamedLine line = named_line(text);
    const CharacteristicArguments curve = with_options(a.common, text, line.options);
    require_same_measures(text, curve, a.common);
    picture.curves.push_back(curve_of(line.label, curve));
  }
  if (a.curves.empty()) picture.curves.push_back(curve_of(a.common.vary, a.common));
  pictures::draw(script(picture), a.output, about(picture.title, invocation.command_line));
  return kDone;
}

}  // namespace

void add_plot_characteristic(CLI::App& plot_verb, Invocation& invocation) {
  auto a = std::make_shared<PlotCharacteristicArguments>();
  CLI::App* kind = add_verb(plot_verb, "characteristic", "speed over effort and wobbling, as a number runs", kHelp);
  add_output(*kind, *a);
  add_characteristic_options(*kind, a->common);
  for (const char* name : {"--plant", "--vary"}) kind->get_option(name)->required(false);
  add_many(*kind, "--curve", a->curves, "LABEL: --pid .. --vary ..: a curve; any number of times");
  kind->callback([a, &invocation] { invocation.exit_code = plot(*a, invocation); });
}

}  // namespace portrait::tools
