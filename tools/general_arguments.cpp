#include "tools/general_arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "tools/arguments.h"

namespace portrait::tools {
namespace {

constexpr std::string_view kTransferFunction = "tf:";

[[noreturn]] void fail(std::string_view option, const std::string& message) {
  throw InputError(fmt::format("{}: {}", option, message));
}

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    parts.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  return parts;
}

double finite_number(std::string_view option, std::string_view text) {
  const double number = number_argument(option, text);
  if (!std::isfinite(number)) fail(option, fmt::format("\"{}\" is not finite", text));
  return number;
}

/// Highest power first in the text, lowest first in the polynomial.
Polynomial coefficients(std::string_view option, std::string_view text) {
  Polynomial p = numbers_argument(option, text);
  std::reverse(p.begin(), p.end());
  return trimmed(std::move(p));
}

}  // namespace

bool is_transfer_function(std::string_view text) { return text.starts_with(kTransferFunction); }

TransferFunction transfer_function_argument(std::string_view option, std::string_view text) {
  const std::string_view fraction = text.substr(std::min(kTransferFunction.size(), text.size()));
  const auto slash = fraction.find('/');
  if (!is_transfer_function(text) || slash == std::string_view::npos)
    fail(option, fmt::format("\"{}\" is not of the form tf:NUM/DEN, as tf:34/13.5,54.25,55,1", text));
  const Polynomial N = coefficients(option, fraction.substr(0, slash)),
                   D = coefficients(option, fraction.substr(slash + 1));
  if (D.empty()) fail(option, "the denominator is 0");
  return transfer_function(N, D);
}

std::vector<double> numbers_argument(std::string_view option, std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view part : parts_of(text)) numbers.push_back(finite_number(option, part));
  return numbers;
}

std::vector<double> named_numbers_argument(std::string_view option, std::string_view text,
                                           const std::vector<std::string_view>& names, double otherwise) {
  std::vector<double> values(names.size(), otherwise);
  if (text.empty()) return values;
  for (const std::string_view part : parts_of(text)) {
    const auto equals = part.find('=');
    if (equals == std::string_view::npos) fail(option, fmt::format("\"{}\" is not of the form NAME=NUMBER", part));
    const std::string_view name = part.substr(0, equals);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) fail(option, fmt::format("unknown name \"{}\"{}", name, suggestion(name, names)));
    values[static_cast<std::size_t>(found - names.begin())] = number_argument(option, part.substr(equals + 1));
  }
  return values;
}

ParallelForm pid_argument(std::string_view option, std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view form = text.substr(0, colon), rest = text.substr(std::min(colon + 1, text.size()));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (form == "parallel") {
    const std::vector<double> k = named_numbers_argument(option, rest, {"Kp", "Ki", "Kd"}, 0);
    return {.Kp = k[0], .Ki = k[1], .Kd = k[2]};
  }
  if (form != "standard" && form != "series")
    fail(option, fmt::format("unknown form \"{}\"{}", form, suggestion(form, {"standard", "series", "parallel"})));
  const std::vector<double> k = named_numbers_argument(option, rest, {"Kc", "Ti", "TD"}, kNone);
  if (std::isnan(k[0])) fail(option, "Kc is missing");
  const double Ti = std::isnan(k[1]) ? kInf : k[1], TD = std::isnan(k[2]) ? 0 : k[2];
  if (!(Ti > 0)) fail(option, fmt::format("Ti must be above 0 (it is {})", number_text(Ti)));
  return parallel(form == "series" ? standard(SeriesForm{k[0], Ti, TD}) : StandardForm{k[0], Ti, TD});
}

}  // namespace portrait::tools
