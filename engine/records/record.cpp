#include "engine/records/record.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/records/line_fit.h"

namespace portrait::records {
namespace {

bool parts(char c) { return c == ',' || c == ';' || c == '\t' || c == ' '; }

/// Cells of a line; two separators with nothing between them but commas have an empty cell.
std::vector<std::string_view> cells(std::string_view line) {
  const bool blanks_part = line.find_first_of(",;\t") == std::string_view::npos;
  std::vector<std::string_view> found;
  std::size_t from = 0;
  const auto add = [&](std::size_t to) {
    std::string_view cell = line.substr(from, to - from);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\r'))
      cell.remove_suffix(1);
    if (!cell.empty() || !blanks_part) found.push_back(cell);
  };
  for (std::size_t i = 0; i < line.size(); ++i)
    if (parts(line[i]) && (blanks_part || line[i] != ' ')) add(i), from = i + 1;
  add(line.size());
  return found;
}

struct Columns {
  std::size_t t = 0, u = 1, y = 2, count = 3;
};

/// By name when the first line has no number.
Columns columns_of(const std::vector<std::string_view>& header, const Place& place) {
  std::map<std::string_view, std::size_t> at;
  for (std::size_t i = 0; i < header.size(); ++i) at[header[i]] = i;
  for (const std::string_view name : {"t", "u", "y"})
    if (!at.contains(name))
      throw InputError(place, fmt::format("no column \"{}\": the header must name t, u and y (it has {})", name,
                                          joined(header)));
  return {at["t"], at["u"], at["y"], header.size()};
}

double cell_number(const std::vector<std::string_view>& line, std::size_t column, const char* name,
                   const Place& place) {
  if (line[column].empty()) throw InputError(place, fmt::format("{} is missing", name));
  const auto value = parse_number(line[column]);
  if (!value || !std::isfinite(*value))
    throw InputError(place, fmt::format("{} = \"{}\" is not a number", name, line[column]));
  return *value;
}

void add_row(Record& r, const std::vector<std::string_view>& line, const Columns& c, const Place& place) {
  if (line.size() != c.count)
    throw InputError(place, fmt::format("{} columns, expected {} (t, u, y)", line.size(), c.count));
  const double t = cell_number(line, c.t, "t", place);
  if (!r.t.empty() && !(t > r.t.back()))
    throw InputError(place, fmt::format("t = {} does not come after {}", number_text(t), number_text(r.t.back())));
  r.t.push_back(t), r.u.push_back(cell_number(line, c.u, "u", place)),
      r.y.push_back(cell_number(line, c.y, "y", place));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Second differences of a smooth signal are small; those of white noise have six times its variance.
double noise_of(const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 2; i < y.size(); ++i) sum += std::pow(y[i] - 2 * y[i - 1] + y[i - 2], 2);
  return std::sqrt(sum / (6 * static_cast<double>(y.size() - 2)));
}

/// First sample at which u is off its first value by more than a hundredth of all it ever is.
std::size_t first_change(const Record& r) {
  double largest = 0;
  for (const double u : r.u) largest = std::max(largest, std::abs(u - r.u[0]));
  if (largest == 0) throw InputError("u never changes: a record needs a step, or any other change of u");
  std::size_t i = 0;
  while (std::abs(r.u[i] - r.u[0]) <= 0.01 * largest) ++i;
  return i;
}

}  // namespace

Record read_record(std::string_view text, const std::string& source) {
  Record record;
  Columns columns;
  bool first = true;
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string_view line = text.substr(from, end - from);
    from = end + 1, ++number;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with("#")) continue;
    const auto found = cells(line);
    const Place place{source, number, 0};
    const bool header = first && (found.empty() || !parse_number(found.front()));
    first = false;
    if (header)
      columns = columns_of(found, place);
    else
      add_row(record, found, columns, place);
  }
  constexpr std::size_t kFewest = 10;
  if (record.size() < kFewest)
    throw InputError(fmt::format("{}: {} samples are too few for a response", source, record.size()));
  return record;
}

Quality quality(const Record& r) {
  const std::size_t at = first_change(r);
  Quality q{r.t[at], r.u[0], r.y[0], 0, noise_of(r.y), 0, 0, {}};
  if (at >= 1) {
    const LineFit before = line_fit(r, 0, at);
    q.before_y = at >= 3 ? before.level_at(0.5 * (r.t[0] + r.t[at - 1])) : r.y[0];
    q.drift = at >= 3 ? before.slope : 0;
  }
  std::vector<double> gaps;
  for (std::size_t i = 1; i < r.size(); ++i) gaps.push_back(r.t[i] - r.t[i - 1]);
  q.longest_gap = *std::max_element(gaps.begin(), gaps.end()), q.usual_gap = median(gaps);
  if (q.longest_gap > 3.5 * q.usual_gap) {
    const auto where = static_cast<std::size_t>(std::max_element(gaps.begin(), gaps.end()) - gaps.begin());
    q.remarks.push_back(fmt::format(
        "about {:.0f} samples are missing after t = {:.6g}: y is taken as a straight line, u as held there",
        q.longest_gap / q.usual_gap - 1, r.t[where]));
  }
  if (at < 3)
    q.remarks.push_back(
        "fewer than three samples before the change: the initial level has the noise of one sample, drift is taken "
        "as 0");
  return q;
}

}  // namespace portrait::records
