#include "portraits/table_format.h"

#include <cstring>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/status.h"
#include "engine/base/words.h"

namespace portrait {
namespace {

constexpr std::size_t kLongestNumber = 20;  ///< digits of 2^64
constexpr std::size_t kAlignment = 64;
constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);

Status status_of(double code) { return static_cast<Status>(static_cast<std::uint8_t>(code)); }

void append(std::string& bytes, const void* from, std::size_t count) {
  bytes.append(static_cast<const char*>(from), count);
}

}  // namespace

std::string csv_head(const std::vector<TableColumn>& columns) {
  std::string text;
  for (const TableColumn& column : columns) text += (text.empty() ? "" : ",") + column.name;
  return text + "\n";
}

std::string csv_rows(const std::vector<TableColumn>& columns, const TableRows& rows) {
  std::string text;
  for (std::size_t row = 0; row < rows.count; ++row)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = rows.values[c][row];
      if (columns[c].is_status)
        text += to_string(status_of(value));
      else
        text += number_text(value);
      text += c + 1 < columns.size() ? ',' : '\n';
    }
  return text;
}

// A dictionary as Python prints it, blanks up to a whole multiple of 64 bytes, the last byte a newline.
std::string npy_head(const std::vector<TableColumn>& columns, const std::vector<std::uint64_t>& shape) {
  std::string fields, sizes;
  for (const TableColumn& column : columns)
    fields += fmt::format("('{}', '{}'), ", column.name, column.is_status ? "|u1" : "<f8");
  for (const std::uint64_t size : shape) sizes += fmt::format("{}, ", size);
  std::string text = fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({}), }}", fields, sizes);
  const std::size_t room = fields.size() + 64 + shape.size() * (kLongestNumber + 2);
  const std::size_t before = kMagic.size() + sizeof(std::uint16_t);
  const std::size_t whole = (before + room + kAlignment) / kAlignment * kAlignment;
  text.resize(whole - before, ' ');
  text.back() = '\n';
  PORTRAIT_CHECK(text.size() <= 0xffff);
  const auto length = static_cast<std::uint16_t>(text.size());
  std::string head(kMagic);
  append(head, &length, sizeof length);
  return head + text;
}

std::string npy_rows(const std::vector<TableColumn>& columns, const TableRows& rows) {
  std::string bytes;
  bytes.reserve(rows.count * columns.size() * sizeof(double));
  for (std::size_t row = 0; row < rows.count; ++row)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = rows.values[c][row];
      if (columns[c].is_status)
        bytes.push_back(static_cast<char>(status_of(value)));
      else
        append(bytes, &value, sizeof value);
    }
  return bytes;
}

}  // namespace portrait
