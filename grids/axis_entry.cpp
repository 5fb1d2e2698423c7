#include "grids/axis_entry.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {
namespace {

/// What the two ways of writing a table have in common.
struct Range {
  Parameter parameter;
  double from, to;
  Place place;  ///< of the table
};

Axis list_axis(Parameter parameter, const Value& value) {
  const std::string_view name = to_string(parameter);
  std::vector<double> values;
  for (const Value& item : list_in(name, value)) {
    const double next = number_in(name, item);
    if (!values.empty() && next <= values.back())
      throw InputError(item.place, fmt::format("unordered axis \"{}\": {} after {} (its values must increase)",
                                               name, number_text(next), number_text(values.back())));
    values.push_back(next);
  }
  if (values.empty()) throw InputError(value.place, fmt::format("axis \"{}\" has no values", name));
  return Axis::list(parameter, std::move(values));
}

double finite_number_in(const Entry& entry) {
  const double number = number_in(entry.key, entry.value);
  if (std::isfinite(number)) return number;
  throw InputError(entry.value.place, fmt::format("\"{}\" must be finite, not {}", entry.key, number_text(number)));
}

Range range_in(Parameter parameter, const Value& value) {
  const Entry& from = need(value, "from");
  const Entry& to = need(value, "to");
  const Range range{parameter, finite_number_in(from), finite_number_in(to), value.place};
  if (range.from < range.to) return range;
  throw InputError(from.value.place, fmt::format("\"from\" must be below \"to\" ({} is not below {})",
                                                 number_text(range.from), number_text(range.to)));
}

bool is_logarithmic(const Value::Table& table) {
  const Entry* scale = find(table, "scale");
  if (!scale) return false;
  const std::string& word = text_in("scale", scale->value);
  if (word != "linear" && word != "log")
    throw InputError(scale->value.place,
                     fmt::format("unknown scale {}{}", in_quotes(word), suggestion(word, {"linear", "log"})));
  return word == "log";
}

void refuse_too_fine(const Range& range, double count, double most) {
  if (count <= most) return;
  throw InputError(range.place,
                   fmt::format("axis \"{}\" would have {:.0f} values, of which {:.0f} differ in 15 digits",
                               to_string(range.parameter), count, most));
}

std::uint64_t count_in(const Entry& entry) {
  const std::int64_t count = whole_number_in("count", entry.value);
  if (count >= 2) return static_cast<std::uint64_t>(count);
  throw InputError(entry.value.place, fmt::format("\"count\" must be at least 2 (it is {})", count));
}

Axis counted_axis(const Range& range, const Entry& entry) {
  const std::uint64_t count = count_in(entry);
  refuse_too_fine(range, static_cast<double>(count), Axis::most_linear(range.from, range.to));
  return Axis::linear(range.parameter, range.from, range.to, count);
}

/// The two steps next to the wanted one that lead from end to end, the coarser first.
std::string steps_that_divide(const Range& range, double steps) {
  const auto choice = [&](double n) {
    return fmt::format("{:.15g} (count = {:.0f})", (range.to - range.from) / n, n + 1);
  };
  const double fewer = std::floor(steps);
  if (fewer < 1) return choice(1);
  return choice(fewer) + " or " + choice(fewer + 1);
}

Axis stepped_axis(const Range& range, const Entry& entry) {
  const double step = finite_number_in(entry);
  if (step <= 0)
    throw InputError(entry.value.place, fmt::format("\"step\" must be above 0 (it is {})", number_text(step)));
  const double steps = (range.to - range.from) / step;
  refuse_too_fine(range, steps + 1, Axis::most_linear(range.from, range.to));
  const double whole = std::round(steps);
  const double slack = std::max(1e-6, 1e-15 * steps);  // of a step; the second is rounding of the division
  if (whole < 1 || std::abs(steps - whole) > slack)
    throw InputError(entry.value.place,
                     fmt::format("step {} does not lead from {} to {}: use {}", number_text(step),
                                 number_text(range.from), number_text(range.to), steps_that_divide(range, steps)));
  return Axis::linear(range.parameter, range.from, range.to, static_cast<std::uint64_t>(whole) + 1);
}

Axis logarithmic_axis(const Range& range, const Value& value) {
  const auto& table = std::get<Value::Table>(value.content);
  if (range.from <= 0)
    throw InputError(
        need(value, "from").value.place,
        fmt::format("\"from\" must be above 0 on a logarithmic axis (it is {})", number_text(range.from)));
  if (const Entry* step = find(table, "step"))
    throw InputError(step->place, "a logarithmic axis takes \"count\", not \"step\"");
  const std::uint64_t count = count_in(need(value, "count", "a logarithmic axis needs it"));
  refuse_too_fine(range, static_cast<double>(count), Axis::most_logarithmic(range.from, range.to));
  return Axis::logarithmic(range.parameter, range.from, range.to, count);
}

Axis linear_axis(const Range& range, const Value& value) {
  const auto& table = std::get<Value::Table>(value.content);
  const Entry* step = find(table, "step");
  const Entry* count = find(table, "count");
  if (step && count) throw InputError(count->place, "\"step\" and \"count\" say the same: give one of the two");
  if (step) return stepped_axis(range, *step);
  return counted_axis(range, need(value, "count", "an axis needs \"step\" or \"count\""));
}

}  // namespace

Axis axis_in(Parameter parameter, const Value& value) {
  if (std::holds_alternative<Value::List>(value.content)) return list_axis(parameter, value);
  const Value::Table& table = table_in(to_string(parameter), value);
  allow_only(table, {"from", "to", "step", "count", "scale"});
  const Range range = range_in(parameter, value);
  return is_logarithmic(table) ? logarithmic_axis(range, value) : linear_axis(range, value);
}

}  // namespace portrait
