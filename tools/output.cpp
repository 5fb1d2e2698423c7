#include "tools/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/words.h"
#include "engine/loop/parameters.h"

namespace portrait::tools {
namespace {

/// The rows of the table: what is measured of y or u under the steps w, d and o.
struct TableRow {
  std::string_view title, stem;
};

constexpr TableRow kRows[] = {{"IAE", "IAE_"},           {"ISE", "ISE_"},           {"ITAE", "ITAE_"},
                              {"ITSE", "ITSE_"},         {"TV of y", "TV_y"},       {"TV of u", "TV_u"},
                              {"largest |y|", "y_max_"}, {"largest |u|", "u_max_"}, {"class of y", "DC_y"},
                              {"class of u", "DC_u"}};

/// With the rows of TV0 .. TV8 behind those of TV, and those under noise at the end.
std::vector<std::pair<std::string, std::string>> table_rows() {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const auto& [title, stem] : kRows) {
    rows.emplace_back(title, stem);
    for (int m = 0; m <= 8 && stem.starts_with("TV_"); ++m)
      rows.emplace_back(fmt::format("TV{}{}", m, title.substr(2)), fmt::format("TV{}{}", m, stem.substr(2)));
  }
  for (const char* signal : {"y", "u"})
    for (const char* shape : {"TV", "TV0", "TV1", "TV2"}) {
      rows.emplace_back(fmt::format("noisy {} of {}", shape, signal), fmt::format("noisy_{}_{}", shape, signal));
      rows.emplace_back("  its spread", fmt::format("spread_{}_{}", shape, signal));
    }
  return rows;
}

int title_width(const std::vector<Measure>& measures) {
  return std::any_of(measures.begin(), measures.end(), is_noisy) ? 20 : 12;
}

bool contains(const std::vector<Measure>& measures, Measure wanted) {
  for (const Measure m : measures)
    if (m == wanted) return true;
  return false;
}

std::string cell(const MeasureRow& row, const std::vector<Measure>& measures, Measure measure) {
  if (!contains(measures, measure)) return "not stored";
  return std::isnan(row[measure]) ? "none" : short_number(row[measure]);
}

Json json_form(std::string_view formula, std::initializer_list<std::pair<const char*, double>> values) {
  Json form{{"formula", formula}};
  for (const auto& [name, value] : values) form[name] = json_number(value);
  return form;
}

constexpr std::string_view kParallel = "Kp + Ki/s + Kd s";
constexpr std::string_view kStandard = "Kc (1 + 1/(Ti s) + TD s)";
constexpr std::string_view kSeries = "Kc (1 + 1/(Ti s)) (1 + TD s)";

std::string filter_text(const LoopFamily& family) {
  if (family.n == 0) return "none, the derivative acts on the measured output alone";
  return family.n == 1 ? "1/(Tf s + 1)" : fmt::format("1/(Tf s + 1)^{}", family.n);
}

std::string prefilter_text(const RealController& controller, const LoopFamily& family) {
  const bool integral = std::isfinite(controller.standard.Ti);
  switch (family.prefilter) {
    case Prefilter::none:
      return "1";
    case Prefilter::pi:
      return integral ? "(1 + b Ti s)/(1 + Ti s)" : "1";
    case Prefilter::full:
      return integral ? "(1 + b s + c s^2)/(1 + Ti s + Ti TD s^2)" : "(1 + b s)/(1 + TD s)";
  }
  return {};
}

/// A terminal that is not told otherwise: https://no-color.org
bool takes_colours(int file) {
  const char *no_color = std::getenv("NO_COLOR"), *term = std::getenv("TERM");
  return isatty(file) == 1 && (no_color == nullptr || *no_color == '\0') && term != nullptr &&
         std::string_view(term) != "dumb";
}

}  // namespace

Json json_number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

Json json_settings(const Loop& loop) {
  Json json = Json::object();
  for (const Parameter p : parameters_of(loop.family))
    json[std::string(to_string(p))] = json_number(get(loop.setting, p));
  return json;
}

Json json_measures(const MeasureRow& row, const std::vector<Measure>& measures) {
  Json json = Json::object();
  for (const Measure m : measures) json[std::string(to_string(m))] = json_number(row[m]);
  return json;
}

Json json_controller(const RealController& controller, const LoopFamily& family) {
  const StandardForm& s = controller.standard;
  const ParallelForm p = parallel(s);
  Json json;
  json["parallel"] = json_form(kParallel, {{"Kp", p.Kp}, {"Ki", p.Ki}, {"Kd", p.Kd}});
  json["standard"] = json_form(kStandard, {{"Kc", s.Kc}, {"Ti", s.Ti}, {"TD", s.TD}});
  json["series"] = nullptr;
  if (const auto form = series(s))
    json["series"] = json_form(kSeries, {{"Kc", form->Kc}, {"Ti", form->Ti}, {"TD", form->TD}});
  json["filter"] = {{"formula", filter_text(family)}, {"n", family.n}};
  if (family.n >= 1) json["filter"]["Tf"] = json_number(controller.Tf);
  json["prefilter"] = {{"formula", prefilter_text(controller, family)},
                       {"b", json_number(controller.b)},
                       {"c", json_number(controller.c)}};
  return json;
}

void print_json(const Json& json) { print_text(json.dump(2) + "\n"); }

void print_text(const std::string& text) { std::fputs(text.c_str(), stdout); }

void print_message(const std::string& text) {
  const bool bold = takes_colours(STDERR_FILENO);
  std::fputs(fmt::format("{}portrait:{} {}\n", bold ? "\033[1m" : "", bold ? "\033[0m" : "", text).c_str(), stderr);
}

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

std::vector<Measure> measures_of_one_run() {
  std::vector<Measure> measures;
  for (const Measure m : all_measures())
    if (!is_noisy(m)) measures.push_back(m);
  return measures;
}

std::string measures_table(const MeasureRow& row, const std::vector<Measure>& measures,
                           const std::string& unit_note) {
  const bool with_output = contains(measures, Measure::IAE_o);
  const int width = title_width(measures);
  std::string text = fmt::format("  {:<{}} {:>14} {:>14}{}   {}\n", "", width, "setpoint", "disturbance",
                                 with_output ? fmt::format(" {:>14}", "output") : "", unit_note);
  for (const auto& [title, stem] : table_rows()) {
    std::string line = fmt::format("  {:<{}}", title, width);
    bool any = false;
    for (const char* step : {"w", "d", "o"}) {
      if (*step == 'o' && !with_output) continue;
      const std::optional<Measure> m = measure_named(stem + step);
      any = any || (m && contains(measures, *m));
      line += fmt::format(" {:>14}", m ? cell(row, measures, *m) : "");
    }
    if (any) text += line + "\n";
  }
  for (const Measure m : measures)
    if (info(m).step == '-') text += fmt::format("  {:<{}} {:>14}\n", to_string(m), width, cell(row, measures, m));
  return text;
}

std::string controller_text(const RealController& controller, const LoopFamily& family) {
  const StandardForm& s = controller.standard;
  const ParallelForm p = parallel(s);
  std::string text = fmt::format("  {:<10} {:<30} Kp = {}, Ki = {}, Kd = {}\n", "parallel", kParallel,
                                 short_number(p.Kp), short_number(p.Ki), short_number(p.Kd));
  text += fmt::format("  {:<10} {:<30} Kc = {}, Ti = {}, TD = {}\n", "standard", kStandard, short_number(s.Kc),
                      short_number(s.Ti), short_number(s.TD));
  if (const auto form = series(s))
    text += fmt::format("  {:<10} {:<30} Kc = {}, Ti = {}, TD = {}\n", "series", kSeries, short_number(form->Kc),
                        short_number(form->Ti), short_number(form->TD));
  else
    text += fmt::format("  {:<10} none: Ti < 4 TD, the zeros are complex\n", "series");
  text += fmt::format("  {:<10} {}{}\n", "filter", filter_text(family),
                      family.n >= 1 ? fmt::format(", Tf = {}", short_number(controller.Tf)) : "");
  text += fmt::format("  {:<10} {}, b = {}, c = {}\n", "prefilter", prefilter_text(controller, family),
                      short_number(controller.b), short_number(controller.c));
  return text;
}

std::string plant_text(const RealPlant& plant) {
  const std::string numbers = fmt::format("K = {}, Td = {}", short_number(plant.K), short_number(plant.Td));
  switch (plant.family) {
    case Plant::dipdt:
      return "K e^(-Td s)/s^2, " + numbers;
    case Plant::ipdt:
      return "K e^(-Td s)/s, " + numbers;
    case Plant::fotd:
      return "K e^(-Td s)/(T1 s + 1), " + numbers + fmt::format(", T1 = {}", short_number(plant.T1));
    case Plant::jotd:
      return "K e^(-Td s)/(Tj s + 1)^j, " + numbers + fmt::format(", Tj = {}", short_number(plant.T1));
  }
  return {};
}

}  // namespace portrait::tools
