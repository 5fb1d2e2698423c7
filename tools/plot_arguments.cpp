#include "tools/plot_arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/version.h"
#include "engine/base/words.h"
#include "tools/arguments.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

/// "kappa=0.2 tau_i=8, delta=0.7" -> words without the space and commas between them.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(" ,", begin)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(" ,", begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

struct NameAndValue {
  std::string name, value;
};

NameAndValue assignment(const std::string& option, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos)
    throw InputError(fmt::format("{}: \"{}\" is not of the form NAME=VALUE", option, word));
  return {word.substr(0, equals), word.substr(equals + 1)};
}

void set_all(const std::string& option, const std::vector<std::string>& words, Setting& setting) {
  std::optional<double> tau_d;  // means delta = kappa tau_d, so it comes last
  for (const std::string& word : words) {
    const auto [name, value] = assignment(option, word);
    const Parameter parameter = parameter_argument(option, name);
    const double number = number_argument(option, value);
    if (parameter == Parameter::tau_d)
      tau_d = number;
    else
      set(setting, parameter, number);
  }
  if (tau_d) set(setting, Parameter::tau_d, *tau_d);
}

}  // namespace

void add_output(CLI::App& kind, PlotArguments& a) {
  kind.add_option("-o,--output", a.output, "the picture: a name that ends in .svg, .pdf or .png")->required();
  kind.add_option("--title", a.title, "what stands above the picture");
}

void add_question(CLI::App& kind, PlotArguments& a) {
  kind.add_option("--minimize", a.minimize, "what the optimum minimizes: an expression");
  add_many(kind, "--where", a.where, "a constraint, EXPR <= X (or <, >=, >, ==); any number of times");
  kind.add_flag("--include-not-settled", a.include_not_settled,
                "also settings whose responses had not settled at the horizon");
}

void add_loops(CLI::App& kind, PlotArguments& a, const char* settings_text) {
  kind.add_option("--plant", a.plant,
                  "dipdt, ipdt or fotd; K=..,Td=..[,T1=..] draws in real units; \"dipdt,K=2,Td=0.5\" says both");
  kind.add_option("--n", a.n, "filter order; 0: ideal derivative of the output")->check(CLI::NonNegativeNumber);
  kind.add_option("--prefilter", a.prefilter, "full, pi or none (default: pi with n = 0, else full)");
  add_many(kind, "--setting", a.settings, settings_text);
}

void add_log(CLI::App& kind, PlotArguments& a, const char* text) {
  kind.add_option("--log", a.log, text)->delimiter(',');
}

PlantArgument plant_argument(const std::string& text, std::optional<Plant> of_portrait) {
  std::string numbers = text;
  std::optional<Plant> family = of_portrait;
  const std::string first = text.substr(0, text.find(','));
  if (!text.empty() && first.find('=') == std::string::npos) {
    family = plant_family_argument("--plant", first);
    if (of_portrait && family != of_portrait)
      throw InputError(fmt::format("--plant: the portrait's plant is {}, not {}", to_string(*of_portrait), first));
    numbers = first.size() < text.size() ? text.substr(first.size() + 1) : "";
  }
  if (!family) throw InputError("--plant is missing: dipdt, ipdt or fotd, unless a portrait says it");
  if (numbers.empty()) return {*family, std::nullopt};
  return {*family, real_plant_argument("--plant", numbers, *family)};
}

pictures::NamedLoop named_loop(const std::string& text, const LoopFamily& family, const Setting& fixed) {
  const std::size_t colon = text.find(':');
  const std::string values = colon == std::string::npos ? text : text.substr(colon + 1);
  pictures::NamedLoop named{"", {family, fixed}};
  set_all("--setting", words_of(values), named.loop.setting);
  if (const auto reason = why_invalid(named.loop))
    throw InputError(fmt::format("--setting \"{}\": {}", text, *reason));
  named.label = colon == std::string::npos ? setting_text(named.loop) : trimmed(text.substr(0, colon));
  return named;
}

LoopFamily family_argument(const PlotArguments& a, Plant plant) {
  LoopFamily family{plant, std::max(a.n, 0), {}};
  family.prefilter =
      a.prefilter.empty() ? usual_prefilter(family.n) : prefilter_argument("--prefilter", a.prefilter);
  return family;
}

Question question_argument(const PlotArguments& a, const Grid& grid) {
  Question question{.minimize = parse_expression({"--minimize", a.minimize}),
                    .conditions = {.where = {},
                                   .units = {.plant = plant_argument(a.plant, grid.family.plant).real, .steps = {}},
                                   .include_not_settled = a.include_not_settled}};
  for (const std::string& text : a.where) question.conditions.where.push_back(parse_constraint({"--where", text}));
  return question;
}

Setting fixed_setting(const Grid& grid) {
  Setting setting;
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter != Parameter::tau_d) set(setting, fixed.parameter, fixed.value);
  return setting;
}

bool is_log(const PlotArguments& a, const std::string& what) {
  return std::find(a.log.begin(), a.log.end(), what) != a.log.end();
}

Parameter parameter_argument(const std::string& option, const std::string& text) {
  const auto parameter = parameter_named(text);
  if (parameter) return *parameter;
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < kParameterCount; ++i) known.push_back(to_string(static_cast<Parameter>(i)));
  throw InputError(fmt::format("{}: unknown parameter \"{}\"{}", option, text, suggestion(text, known)));
}

ParameterRange range_argument(const std::string& option, const std::string& text) {
  const auto [name, value] = assignment(option, text);
  const std::size_t dots = value.find("..");
  const Parameter parameter = parameter_argument(option, name);
  if (dots == std::string::npos) {
    const double number = number_argument(option, value);
    return {parameter, number, number};
  }
  const double from = number_argument(option, value.substr(0, dots));
  const double to = number_argument(option, value.substr(dots + 2));
  if (!(from < to) || !std::isfinite(from) || !std::isfinite(to))
    throw InputError(fmt::format("{}: \"{}\" is not a range FROM..TO of two finite numbers", option, value));
  return {parameter, from, to};
}

pictures::About about(const std::string& title, const std::string& command_line) {
  return {title, command_line, program_version()};
}

}  // namespace portrait::tools
