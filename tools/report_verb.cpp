/// portrait report: a question, its answer and its pictures as one HTML file that needs nothing else.

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/version.h"
#include "engine/base/words.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/pictures/loops.h"
#include "tools/pictures/text.h"
#include "tools/portrait_pictures.h"
#include "tools/query_output.h"
#include "tools/shown_portrait.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait report huba.h5 --minimize 'IAE_w + IAE_d' --where 'Ms <= 2' --plant K=2,Td=0.5 -o report.html

Writes the answer to a question as one HTML file that can be read anywhere, offline: the
optimum with its controller and measures, the next best, the map, the responses, the open
loop and the trade-off, the commands that give them, and where the portrait comes from.)";

struct ReportArguments : PlotArguments {
  std::size_t top = 10;
};

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="{}">
<title>{}</title>
<style>
body {{ font: 15px/1.5 sans-serif; max-width: 980px; margin: 24px auto; padding: 0 16px; color: #1b1b1f; }}
h2 {{ margin-top: 1.6em; border-bottom: 1px solid #ccc; }}
pre {{ background: #f4f4f8; padding: 10px; overflow-x: auto; font-size: 13px; }}
img {{ max-width: 100%; height: auto; display: block; margin: 8px 0; }}
.scroll {{ overflow-x: auto; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
td, th {{ text-align: right; padding: 2px 14px 2px 0; border-bottom: 1px solid #eee; white-space: nowrap; }}
th {{ font-weight: 600; }}
</style>
</head>
<body>
)";

using pictures::xml_text;

std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U; };
    const unsigned three = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) <= bytes.size() ? kLetters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string image(const pictures::Script& script, const std::string& what) {
  const std::string svg = pictures::drawn(script, pictures::Format::svg);
  return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">\n", xml_text(what), base64(svg));
}

std::string section(const std::string& head, const std::string& body) {
  return fmt::format("<h2>{}</h2>\n{}", head, body);
}

std::string pre(const std::string& text) { return fmt::format("<pre>{}</pre>\n", xml_text(text)); }

std::string top_table(const Grid& grid, const Answer& answer) {
  std::string text = "<div class=\"scroll\"><table>\n<tr><th></th><th>objective</th>";
  for (const Axis& axis : grid.axes) text += fmt::format("<th>{}</th>", axis.name());
  text += "</tr>\n";
  for (std::size_t i = 0; i < answer.top.size(); ++i) {
    text += fmt::format("<tr><td>{}</td><td>{}</td>", i + 1, short_number(answer.top[i].objective));
    for (const Axis& axis : grid.axes)
      text += fmt::format("<td>{}</td>", short_number(get(answer.top[i].setting, axis.parameter())));
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string answer_section(const Grid& grid, const Question& question, const Answer& answer) {
  const Found& best = answer.top.front();
  std::string text =
      fmt::format("<p><strong>{} = {}</strong> at {}</p>\n<p>{} of {} settings are admissible.</p>\n",
                  xml_text(question.minimize.text()), short_number(best.objective),
                  xml_text(setting_text(grid, best)), answer.admissible, answer.total);
  for (const ActiveConstraint& active : answer.active)
    text += fmt::format("<p>Active: {}; without it {} at {}</p>\n",
                        xml_text(question.conditions.where[active.constraint].text()),
                        short_number(active.optimum.objective), xml_text(setting_text(grid, active.optimum)));
  return text + pre(found_text(grid, question.conditions.units, best)) + top_table(grid, answer);
}

std::string provenance(const PortraitReader& portrait) {
  const Facts& facts = portrait.facts();
  return pre(
      fmt::format("file      {}\nmade by   {}, method {}\ndate      {}\nhistory   {}\nstate     {}, format {}",
                  portrait.path().string(), facts.program, facts.method, facts.date_created, facts.history,
                  facts.state, facts.schema_version));
}

/// The options that ask the same question with another verb.
std::string question_options(const ReportArguments& a) {
  std::string text = fmt::format(" --minimize '{}'", a.minimize);
  for (const std::string& where : a.where) text += fmt::format(" --where '{}'", where);
  if (!a.plant.empty()) text += " --plant " + a.plant;
  return text + (a.include_not_settled ? " --include-not-settled" : "");
}

std::string pictures_section(const ReportArguments& a, const ShownPortrait& shown, const Found& best) {
  MapArguments map;
  static_cast<PlotArguments&>(map) = a;
  std::string text;
  if (shown.grid().axes.size() >= 2) text += image(map_picture(map).script, "map of " + a.minimize);
  const std::vector<pictures::NamedLoop> loops = {
      {"optimum, " + setting_text(shown.grid(), best), {shown.grid().family, best.setting}}};
  const Horizon horizon = shown.grid().horizon;
  text += image(pictures::responses("Responses of the optimum", loops, horizon, shown.units.plant), "responses");
  text += image(pictures::nyquist("Open loop of the optimum", loops, 0), "Nyquist curve");
  const auto& kept = shown.grid().measures;
  if (std::find(kept.begin(), kept.end(), Measure::Ms) != kept.end()) {
    FrontArguments front;
    static_cast<PlotArguments&>(front) = a;
    front.x = "Ms";
    front.y = a.minimize;
    text += image(front_picture(front).script, "trade-off of " + a.minimize + " and Ms");
  }
  return text;
}

int report(const ReportArguments& a, const Invocation& invocation) {
  const ShownPortrait shown(a.file, a.plant);
  const Grid& grid = shown.grid();
  Question question = question_argument(a, grid);
  question.top = a.top;
  const Answer answer = ask(shown.portrait, question);
  if (answer.top.empty()) {
    print_message("no admissible setting, so no report: loosen a constraint (portrait query says which)");
    return kNoneAdmissible;
  }
  const std::string title = a.title.empty() ? (grid.title.empty() ? a.file : grid.title) : a.title;
  std::string html = fmt::format(fmt::runtime(kHead), xml_text(program_version()), xml_text(title));
  html += fmt::format("<h1>{}</h1>\n<p>Units: {}.</p>\n", xml_text(title),
                      xml_text(unit_note(question.conditions.units)));
  std::string asked = "minimize " + a.minimize + "\n";
  for (const std::string& where : a.where) asked += "where    " + where + "\n";
  html += section("Question", pre(asked)) + section("Answer", answer_section(grid, question, answer));
  html += section("Pictures", pictures_section(a, shown, answer.top.front()));
  html += section("Commands", pre(invocation.command_line + "\nportrait query " + a.file + question_options(a) +
                                  "\nportrait plot map " + a.file + question_options(a) + " -o map.svg"));
  html += section("Where the portrait comes from", provenance(shown.portrait)) + "</body>\n</html>\n";
  pictures::write_file(a.output, html);
  return kDone;
}

}  // namespace

void add_report(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<ReportArguments>();
  CLI::App* verb = add_verb(app, "report", "a question's answer as one HTML file", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("-o,--output", a->output, "the HTML file")->required();
  verb->add_option("--title", a->title, "what stands above it");
  add_question(*verb, *a);
  verb->get_option("--minimize")->required();
  verb->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: the answer in the units of this plant");
  verb->add_option("--top", a->top, "how many of the best settings to list")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->callback([a, &invocation] { invocation.exit_code = report(*a, invocation); });
}

}  // namespace portrait::tools
