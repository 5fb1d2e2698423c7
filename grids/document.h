/// A text of keys and values as a tree, every node with its place: what a grid file is before it is understood.
///
/// The functions below take a node as what it should be, or say where and why it is not.
///
/// throws    InputError with the place of the offending key or value
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/error.h"

namespace portrait {

struct Entry;

struct Value {
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;  ///< in the order of the file, keys unique
  struct Other {                     ///< a kind that no grid file has a use for
    std::string_view kind;           ///< "a date"
  };

  Place place;
  std::variant<double, std::int64_t, std::string, List, Table, Other> content;
};

struct Entry {
  std::string key;
  Place place;  ///< of the key
  Value value;
};

/// The entry of that key, or nullptr.
const Entry* find(const Value::Table& table, std::string_view key);

/// An entry whose key is none of these is an error that names the nearest of them.
void allow_only(const Value::Table& table, const std::vector<std::string_view>& known);

/// The entry of that key; without one "missing key" at the table's place, `why` behind it when there is more to
/// say. REQUIRES: value is a table.
const Entry& need(const Value& table, std::string_view key, std::string_view why = {});

/// ""plant" must be a string, not a list"
[[noreturn]] void throw_wrong_kind(std::string_view name, const Value& value, std::string_view wanted);

/// Whether it is written as an integer or a float.
bool is_number(const Value& value);

/// A number, written as integer or float; inf is one, nan is not, nor is an integer that a double cannot hold.
double number_in(std::string_view name, const Value& value);

/// A whole number, written as integer or as a float without fraction, within +-2^53.
std::int64_t whole_number_in(std::string_view name, const Value& value);

const std::string& text_in(std::string_view name, const Value& value);
const Value::List& list_in(std::string_view name, const Value& value);
const Value::Table& table_in(std::string_view name, const Value& value);

/// The user's own text for a message: in double quotes, control characters escaped, shortened when it is long.
std::string in_quotes(std::string_view text);

}  // namespace portrait
