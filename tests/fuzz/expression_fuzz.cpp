/// Expressions and constraints from any bytes.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/query/constraint.h"

namespace portrait {
namespace {

constexpr std::size_t kSettings = 4;

double some_value(std::mt19937& random) {
  static constexpr double kSome[] = {0, 1, -1, 0.5, 2, 1e-300, -1e300, 1e300, kInf, -kInf, kNaN, 3.25};
  return random() % 2 == 0 ? kSome[random() % std::size(kSome)] : std::uniform_real_distribution<>(-10, 10)(random);
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Encloses a column.
Interval around(const std::vector<double>& values) {
  Interval interval = Interval::none();
  interval.may_be_nan = false;
  for (const double value : values) {
    if (std::isnan(value)) interval.may_be_nan = true;
    if (value < interval.low) interval.low = value;
    if (value > interval.high) interval.high = value;
  }
  return interval;
}

void check(const Expression& expression) {
  std::mt19937 random(static_cast<unsigned>(expression.text().size()));
  thread_local Columns columns;
  thread_local ColumnStack stack;
  thread_local std::vector<Interval> intervals;
  columns.count = kSettings;
  for (const Expression::Use& use : expression.uses()) {
    std::vector<double>& column = columns[use.quantity];
    column.resize(kSettings);
    for (double& value : column) value = some_value(random);
  }
  std::vector<double> values, again;
  expression.evaluate(columns, stack, values);
  parse_expression({"again", expression.text()}).evaluate(columns, stack, again);
  const Interval bound = expression.bound([&](Quantity quantity) { return around(columns[quantity]); }, intervals);
  for (std::size_t i = 0; i < kSettings; ++i) {
    PORTRAIT_CHECK(same(values[i], again[i]));
    PORTRAIT_CHECK(std::isnan(values[i]) ? bound.may_be_nan : bound.low <= values[i] && values[i] <= bound.high);
  }
  if (const auto constant = expression.constant()) PORTRAIT_CHECK(same(*constant, values[0]));
}

/// A message shows the place, and stays readable whatever was typed.
void check(const InputError& error) {
  const std::string message = error.what();
  PORTRAIT_CHECK(message.rfind("fuzz:", 0) == 0);
  for (const char c : message) PORTRAIT_CHECK(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  const QueryText text{"fuzz", std::string(reinterpret_cast<const char*>(bytes), size)};
  const bool has_relation = text.text.find_first_of("<>=") != std::string::npos;
  try {
    if (has_relation && size % 8 != 0) {
      const Constraint constraint = parse_constraint(text);
      check(constraint.left);
      check(constraint.right);
    } else {
      check(parse_expression(text));
    }
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}
