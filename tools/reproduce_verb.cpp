/// portrait reproduce: the published tables beside ours.

#include <fmt/format.h>

#include "engine/base/error.h"
#include "reproduce/report.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

using reproduce::Compared;
using reproduce::Reproduction;

constexpr const char* kHelp =
    R"(Example:
  portrait reproduce huba2022/table3
  portrait reproduce dalen2018 --json
  portrait reproduce --list

Recomputes the tables and the numbers in the text of five papers, and says of each published
number whether it agrees, agrees after a stated correction, or does not, and why. All tables
take some minutes at most; without a name all are made.)";

struct ReproduceArguments {
  std::string table;
  bool list = false, json = false, markdown = false;
};

Json json_cell(const Reproduction& made, std::size_t r, std::size_t c) {
  const Compared& cell = *made.cells[r][c];
  Json json{{"row", made.table->rows[r].label},
            {"column", made.table->columns[c]},
            {"published", cell.published},
            {"ours", json_number(cell.ours)},
            {"difference", json_number(cell.difference)},
            {"verdict", to_string(cell.verdict)}};
  if (cell.last_digit) json["last_digit"] = true;
  if (!cell.why.empty()) json["why"] = cell.why;
  return json;
}

Json json_table(const Reproduction& made) {
  const auto counts = made.counts();
  Json numbers = Json::array();
  for (std::size_t r = 0; r < made.cells.size(); ++r)
    for (std::size_t c = 0; c < made.cells[r].size(); ++c)
      if (made.cells[r][c]) numbers.push_back(json_cell(made, r, c));
  return {{"table", made.table->key}, {"title", made.table->title},
          {"page", made.table->page}, {"conditions", made.table->conditions},
          {"agree", counts[0]},       {"corrected", counts[1]},
          {"differ", counts[2]},      {"numbers", numbers}};
}

std::string table_text(const Reproduction& made) {
  const auto counts = made.counts();
  std::string text = fmt::format("{}: {}\n", made.table->key, made.table->title);
  if (!made.table->conditions.empty()) text += fmt::format("  {}\n", made.table->conditions);
  text += fmt::format("  {:<32} {:<14} {:>12} {:>16} {:>11}   {}\n", "", "", "published", "ours", "difference",
                      "verdict");
  for (std::size_t r = 0; r < made.cells.size(); ++r)
    for (std::size_t c = 0; c < made.cells[r].size(); ++c) {
      if (!made.cells[r][c]) continue;
      const Compared& cell = *made.cells[r][c];
      text += fmt::format(
          "  {:<32} {:<14} {:>12} {:>16} {:>11.2g}   {}{}{}\n", made.table->rows[r].label, made.table->columns[c],
          cell.published, reproduce::beside(cell.published, cell.ours), cell.difference, to_string(cell.verdict),
          cell.last_digit ? " (last digit, or as allowed)" : "", cell.why.empty() ? "" : ": " + cell.why);
    }
  return text +
         fmt::format("  {} agree, {} after a correction, {} do not agree\n\n", counts[0], counts[1], counts[2]);
}

int list(const ReproduceArguments& a) {
  std::string text;
  Json json = Json::array();
  for (const reproduce::PublishedTable* t : reproduce::tables_named(a.table)) {
    text += fmt::format("{:<26} {}\n", t->key, t->title);
    json.push_back({{"table", t->key}, {"title", t->title}, {"page", t->page}});
  }
  a.json ? print_json(json) : print_text(text);
  return kDone;
}

int reproduce_tables(const ReproduceArguments& a) {
  if (a.list) return list(a);
  if (a.json && a.markdown) throw InputError("--json and --markdown: give one of the two");
  std::vector<Reproduction> all;
  Json json = Json::array();
  for (const reproduce::PublishedTable* t : reproduce::tables_named(a.table)) {
    const Reproduction made = reproduce::reproduce(*t);
    if (a.json)
      json.push_back(json_table(made));
    else if (!a.markdown)
      print_text(table_text(made));
    all.push_back(made);
  }
  if (a.json) print_json(json);
  if (a.markdown) print_text(reproduce::markdown(all));
  return kDone;
}

}  // namespace

void add_reproduce(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<ReproduceArguments>();
  CLI::App* verb = add_verb(app, "reproduce", "the published tables of five papers beside ours", kHelp);
  verb->add_option("table", a->table, "PAPER or PAPER/TABLE; all without it");
  verb->add_flag("--list", a->list, "the names of the tables");
  verb->add_flag("--json", a->json, "a list of tables as JSON");
  verb->add_flag("--markdown", a->markdown, "as docs/reproductions.md has them");
  verb->callback([a, &invocation] { invocation.exit_code = reproduce_tables(*a); });
}

}  // namespace portrait::tools
