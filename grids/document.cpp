#include "grids/document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {
namespace {

/// Up to here every integer is a double.
constexpr std::int64_t kLargestInteger = std::int64_t{1} << 53;

struct KindOf {
  std::string_view operator()(double) const { return "a number"; }
  std::string_view operator()(std::int64_t) const { return "a number"; }
  std::string_view operator()(const std::string&) const { return "a string"; }
  std::string_view operator()(const Value::List&) const { return "a list"; }
  std::string_view operator()(const Value::Table&) const { return "a table"; }
  std::string_view operator()(const Value::Other& other) const { return other.kind; }
};

template <typename T>
const T& content_as(std::string_view name, const Value& value, std::string_view wanted) {
  if (const T* content = std::get_if<T>(&value.content)) return *content;
  throw_wrong_kind(name, value, wanted);
}

[[noreturn]] void throw_too_large(std::string_view name, const Value& value, const std::string& integer) {
  throw InputError(value.place, fmt::format("{} is too large an integer ({}): it must lie within 2^53",
                                            in_quotes(name), integer));
}

double exact_double(std::string_view name, const Value& value, std::int64_t integer) {
  if (-kLargestInteger <= integer && integer <= kLargestInteger) return static_cast<double>(integer);
  throw_too_large(name, value, fmt::format("{}", integer));
}

}  // namespace

const Entry* find(const Value::Table& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

void allow_only(const Value::Table& table, const std::vector<std::string_view>& known) {
  for (const Entry& entry : table)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      throw InputError(entry.place,
                       fmt::format("unknown key {}{}", in_quotes(entry.key), suggestion(entry.key, known)));
}

const Entry& need(const Value& table, std::string_view key, std::string_view why) {
  if (const Entry* entry = find(std::get<Value::Table>(table.content), key)) return *entry;
  throw InputError(table.place, fmt::format("missing key {}{}{}", in_quotes(key), why.empty() ? "" : ": ", why));
}

void throw_wrong_kind(std::string_view name, const Value& value, std::string_view wanted) {
  throw InputError(value.place, fmt::format("{} must be {}, not {}", in_quotes(name), wanted,
                                            std::visit(KindOf(), value.content)));
}

bool is_number(const Value& value) {
  return std::holds_alternative<double>(value.content) || std::holds_alternative<std::int64_t>(value.content);
}

double number_in(std::string_view name, const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.content)) return exact_double(name, value, *integer);
  const double number = content_as<double>(name, value, "a number");
  if (std::isnan(number))
    throw InputError(value.place, fmt::format("{} must be a number, not nan", in_quotes(name)));
  return number + 0.0;  // no -0
}

std::int64_t whole_number_in(std::string_view name, const Value& value) {
  const double number = number_in(name, value);
  if (number != std::trunc(number))
    throw InputError(value.place,
                     fmt::format("{} must be a whole number, not {}", in_quotes(name), number_text(number)));
  if (std::abs(number) > static_cast<double>(kLargestInteger)) throw_too_large(name, value, number_text(number));
  return static_cast<std::int64_t>(number);
}

const std::string& text_in(std::string_view name, const Value& value) {
  return content_as<std::string>(name, value, "a string");
}

const Value::List& list_in(std::string_view name, const Value& value) {
  return content_as<Value::List>(name, value, "a list");
}

const Value::Table& table_in(std::string_view name, const Value& value) {
  return content_as<Value::Table>(name, value, "a table");
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return fmt::format("{:?}", text);
  return fmt::format("{:?}...", text.substr(0, kLongest));
}

}  // namespace portrait
