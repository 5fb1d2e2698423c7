#include "grids/toml.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace portrait {
namespace {

Place place_of(const toml::source_region& region, const std::string& source_name) {
  return {source_name, region.begin.line, region.begin.column};
}

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time";
    case toml::node_type::date_time:
      return "a date and time";
    default:
      return "a value of unknown kind";
  }
}

/// Copies the library's tree, no deeper than the limit.
class Converter {
 public:
  explicit Converter(const std::string& source_name) : source_name_(source_name) {}

  /// The library sorts by key; the places bring back the order of the file.
  Value::Table table_of(const toml::table& source, int depth) const {
    Value::Table table;
    for (const auto& [key, node] : source) {
      Value value = value_of(node, depth);  // not among the braces: gcc 12 frees twice what they hold at a throw
      table.push_back({std::string(key.str()), place_of(key.source(), source_name_), std::move(value)});
    }
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    return table;
  }

 private:
  Value::List list_of(const toml::array& array, int depth) const {
    Value::List list;
    list.reserve(array.size());
    for (const toml::node& node : array) list.push_back(value_of(node, depth));
    return list;
  }

  Value value_of(const toml::node& node, int depth) const {
    Value value{place_of(node.source(), source_name_), Value::Other{kind_of(node)}};
    if (depth >= kMaxDepth) throw InputError(value.place, fmt::format("nested deeper than {} levels", kMaxDepth));
    if (const auto* number = node.as_floating_point()) value.content = number->get();
    if (const auto* integer = node.as_integer()) value.content = integer->get();
    if (const auto* text = node.as_string()) value.content = text->get();
    if (const auto* array = node.as_array()) value.content = list_of(*array, depth + 1);
    if (const auto* table = node.as_table()) value.content = table_of(*table, depth + 1);
    return value;
  }

  const std::string& source_name_;
};

/// Walks over the text outside comments and strings, which it recognises as the library does.
class DotCounter {
 public:
  explicit DotCounter(std::string_view text) : text_(text) {}

  /// Position of the first dot too many within one key, or npos.
  std::size_t first_dot_too_many() {
    int dots = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#') skip_comment();
      if (c == '"' || c == '\'') skip_string(c);
      if (std::string_view(",={}[]#\n").find(c) != std::string_view::npos) dots = 0;
      if (c == '.' && ++dots >= kMaxDepth) return at_;
    }
    return std::string_view::npos;
  }

 private:
  bool looking_at(std::string_view token) const { return text_.substr(at_, token.size()) == token; }

  void skip_comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  /// Ends on the last quote. A long string may hold line ends, and up to two quotes just before its own three.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = looking_at(three);
    for (at_ += is_long ? 3 : 1; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"')
        ++at_;
      else if (!is_long && (text_[at_] == quote || text_[at_] == '\n'))
        return;
      else if (is_long && looking_at(three))
        break;
    }
    if (is_long) at_ = std::min(text_.find_first_not_of(quote, at_), at_ + 5) - 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Lines and columns count from 1; columns count characters, so the later bytes of one (10xxxxxx) do not.
Place place_at(std::string_view text, std::size_t position, const std::string& source_name) {
  const std::string_view before = text.substr(0, position);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const auto column = static_cast<std::size_t>(
                          std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start), before.end(),
                                        [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; })) +
                      1;
  return {source_name, line, column};
}

void refuse_deep_keys(std::string_view text, const std::string& source_name) {
  const std::size_t position = DotCounter(text).first_dot_too_many();
  if (position == std::string_view::npos) return;
  throw InputError(place_at(text, position, source_name), fmt::format("a key has more than {} parts", kMaxDepth));
}

}  // namespace

Value parse_toml(std::string_view text, const std::string& source_name) {
  refuse_deep_keys(text, source_name);
  try {
    const toml::table root = toml::parse(text, std::string_view(source_name));
    Value value{{source_name, 1, 1}, {}};  // the content apart, for the same reason
    value.content = Converter(source_name).table_of(root, 0);
    return value;
  } catch (const toml::parse_error& error) {
    throw InputError(place_of(error.source(), source_name), std::string(error.description()));
  }
}

}  // namespace portrait
