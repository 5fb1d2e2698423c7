#include "reproduce/report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace portrait::reproduce {
namespace {

constexpr std::string_view kHead =
    R"(# Published tables beside ours

Written by `portrait reproduce --markdown`; a test keeps it current. Every table of numbers in the five papers behind Portrait,
recomputed by its own rules and simulations. A published number *agrees* when ours rounds to its printed digits or lies within one
unit of the last (or within what the table's note allows, and why); it *agrees after a correction* when the paper's
conditions have to be changed for it to come out; otherwise it *does not agree*, and the reason stands beside it.
Bibliography: [engine/REFERENCES.md](../engine/REFERENCES.md).

)";

/// What must not be on the page: tests/reproduce/reproductions_test.py.
constexpr std::string_view kNoReason = "NO REASON GIVEN";

std::string paper_of(const std::string& key) { return key.substr(0, key.find('/')); }

std::string counts_text(const std::array<int, 3>& counts) {
  return fmt::format("{} agree, {} after a correction, {} do not agree", counts[0], counts[1], counts[2]);
}

std::string cell_text(const Compared& c) {
  const std::string ours = beside(c.published, c.ours);
  switch (c.verdict) {
    case Verdict::agrees:
      return fmt::format("{} / {}", c.published, ours);
    case Verdict::corrected:
      return fmt::format("{} / {} *corrected*", c.published, ours);
    case Verdict::differs:
      break;
  }
  return fmt::format("**{} / {}** ({:+.2g})", c.published, ours, c.difference);
}

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, "; ")); }

/// The reasons of the cells, each once, with the cells it is for.
std::string reasons(const Reproduction& made, Verdict verdict, std::string_view lead) {
  std::vector<std::pair<std::string, std::vector<std::string>>> found;
  for (std::size_t r = 0; r < made.cells.size(); ++r)
    for (std::size_t c = 0; c < made.cells[r].size(); ++c) {
      const auto& cell = made.cells[r][c];
      if (!cell || cell->verdict != verdict || (verdict == Verdict::agrees && cell->why.empty())) continue;
      const std::string why = cell->why.empty() ? std::string(kNoReason) : cell->why;
      auto at = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == why; });
      if (at == found.end()) at = found.insert(found.end(), {why, {}});
      at->second.push_back(fmt::format("{}: {}", made.table->rows[r].label, made.table->columns[c]));
    }
  std::string text;
  for (const auto& [why, cells] : found)
    text += fmt::format("- {}: {}. ({})\n", lead, why,
                        cells.size() <= 6 ? list(cells) : fmt::format("{} numbers", cells.size()));
  return text;
}

std::string grid(const Reproduction& made) {
  std::string text = fmt::format("| published / ours | {} |\n|---|", fmt::join(made.table->columns, " | "));
  for (std::size_t c = 0; c < made.table->columns.size(); ++c) text += "---|";
  text += "\n";
  for (std::size_t r = 0; r < made.cells.size(); ++r) {
    text += fmt::format("| {} |", made.table->rows[r].label);
    for (const auto& cell : made.cells[r]) text += fmt::format(" {} |", cell ? cell_text(*cell) : "");
    text += "\n";
  }
  return text;
}

}  // namespace

std::string beside(const std::string& published, double ours) {
  if (!std::isfinite(ours)) return "none";
  if (published.find_first_of("eE") != std::string::npos) {
    const std::size_t point = published.find('.'), e = published.find_first_of("eE");
    return fmt::format("{:.{}e}", ours, (point < e ? e - point - 1 : 0) + 2);
  }
  const std::size_t point = published.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : published.size() - point - 1;
  return fmt::format("{:.{}f}", ours, decimals + 2);
}

std::string markdown(const Reproduction& made) {
  const PublishedTable& t = *made.table;
  std::string text =
      fmt::format("### {}: {}\n\n{}{}{}. {}.\n\n", t.key, t.title,
                  t.page.find_first_not_of("0123456789, ") == std::string::npos ? "Page " : "", t.page,
                  t.conditions.empty() ? "" : "; " + t.conditions, counts_text(made.counts()));
  text += grid(made) + "\n";
  const std::string why = reasons(made, Verdict::corrected, "correction") +
                          reasons(made, Verdict::differs, "does not agree") +
                          reasons(made, Verdict::agrees, "allowance");
  return text + why + (why.empty() ? "" : "\n");
}

std::string markdown(const std::vector<Reproduction>& all) {
  std::map<std::string, std::array<int, 3>> papers;
  std::array<int, 3> total{};
  std::string tables, last;
  for (const Reproduction& made : all) {
    const std::string paper = paper_of(made.table->key);
    const auto counts = made.counts();
    for (std::size_t i = 0; i < 3; ++i) papers[paper][i] += counts[i], total[i] += counts[i];
    if (paper != last) tables += fmt::format("## {}\n\n", paper), last = paper;
    tables += markdown(made);
  }
  std::string text(kHead);
  text += "| paper | agree | after a correction | do not agree |\n|---|---|---|---|\n";
  for (const auto& [paper, counts] : papers)
    text += fmt::format("| {} | {} | {} | {} |\n", paper, counts[0], counts[1], counts[2]);
  text += fmt::format("| all | {} | {} | {} |\n\n", total[0], total[1], total[2]);
  tables.pop_back();  // one newline at the end
  return text + tables;
}

}  // namespace portrait::reproduce
