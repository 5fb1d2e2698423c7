#include "engine/rules/rule.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"

namespace portrait::rules {

RulePlant dipdt(double K, double Td) {
  RulePlant plant;
  plant.integrators = 2, plant.K = K, plant.Td = Td, plant.name = "dipdt";
  return plant;
}

RulePlant ipdt(double K, double Td) {
  RulePlant plant;
  plant.integrators = 1, plant.K = K, plant.Td = Td, plant.name = "ipdt";
  return plant;
}

RulePlant jotd(double K, double Td, double Tj, int j) {
  RulePlant plant;
  plant.K = K, plant.Td = Td, plant.name = j == 1 ? "fotd" : "jotd";
  plant.poles.assign(static_cast<std::size_t>(j), {1, Tj});
  return plant;
}

Areas areas_of(const RulePlant& plant, std::size_t count) {
  if (plant.measured) {
    if (plant.measured->size() < count)
      throw InputError(fmt::format("the record gives {} areas, the rule needs {}", plant.measured->size(), count));
    return {plant.measured->begin(), plant.measured->begin() + static_cast<std::ptrdiff_t>(count)};
  }
  Polynomial denominator{1}, numerator = plant.zeros;
  for (const Polynomial& p : plant.poles) denominator = product(denominator, p);
  for (double& a : numerator) a *= plant.K;
  return areas_of(numerator, denominator, plant.Td, count);
}

std::optional<std::vector<double>> real_lags(const RulePlant& plant) {
  if (plant.zeros.size() > 1) return std::nullopt;
  std::vector<double> lags;
  for (const Polynomial& p : plant.poles) {
    if (p.size() == 2) {
      lags.push_back(p[1]);
      continue;
    }
    for (const std::complex<double>& root : complex_roots(p)) {
      // A double lag leaves the eigenvalues as a pair whose distance is the square root of rounding.
      if (std::abs(root.imag()) > 1e-3 * std::abs(root)) return std::nullopt;
      lags.push_back(-1 / root.real());
    }
  }
  if (std::any_of(lags.begin(), lags.end(), [](double T) { return !(T > 0); })) return std::nullopt;
  std::sort(lags.begin(), lags.end(), std::greater<>());
  return lags;
}

Choices::Choices(std::string_view rule, std::vector<OptionInfo> known, std::map<std::string, std::string> given)
    : rule_(rule), known_(std::move(known)), given_(std::move(given)) {
  std::vector<std::string_view> names;
  for (const OptionInfo& option : known_) names.push_back(option.name);
  for (const auto& [name, value] : given_)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(
          fmt::format("--{} has no place here: {} {}", name, rule_,
                      names.empty() ? "has no options" : "takes --" + fmt::format("{}", fmt::join(names, ", --"))));
}

std::optional<std::string> Choices::text(std::string_view name) const {
  if (const auto given = given_.find(std::string(name)); given != given_.end()) return given->second;
  for (const OptionInfo& option : known_)
    if (option.name == name && !option.usually.empty()) return std::string(option.usually);
  return std::nullopt;
}

bool Choices::has(std::string_view name) const { return text(name).has_value(); }

double Choices::number(std::string_view name) const {
  const auto given = text(name);
  if (!given) throw InputError(fmt::format("--{} is missing: {} needs it", name, rule_));
  const auto value = parse_number(*given);
  if (!value || !std::isfinite(*value)) throw InputError(fmt::format("--{}: \"{}\" is not a number", name, *given));
  return *value;
}

double Choices::positive(std::string_view name) const {
  const double value = number(name);
  if (!(value > 0)) throw InputError(fmt::format("--{} must be above 0 (it is {})", name, value));
  return value;
}

double Choices::within(std::string_view name, double least, double most) const {
  const double value = number(name);
  if (!(value >= least && value <= most))
    throw InputError(fmt::format("--{} must be {} .. {} (it is {})", name, least, most, value));
  return value;
}

int Choices::whole(std::string_view name, int least, int most) const {
  const double value = within(name, least, most);
  if (value != std::floor(value))
    throw InputError(fmt::format("--{} must be a whole number (it is {})", name, value));
  return static_cast<int>(value);
}

std::string Choices::word(std::string_view name, const std::vector<std::string_view>& words) const {
  const auto given = text(name);
  if (!given) throw InputError(fmt::format("--{} is missing: {} needs it ({})", name, rule_, joined(words)));
  if (std::find(words.begin(), words.end(), *given) == words.end())
    throw InputError(fmt::format("--{}: unknown \"{}\"{}", name, *given, suggestion(*given, words)));
  return *given;
}

Tuned tuned(const StandardForm& pid) {
  const ParallelForm p = parallel(pid);
  Tuned t;
  t.controller = p.Ki == 0 ? Quotient{{p.Kp, p.Kd}, {1}} : Quotient{{p.Ki, p.Kp, p.Kd}, {0, 1}};
  t.pid = pid;
  return t;
}

Tuned tuned(const std::vector<double>& gains, int n, double Tf) {
  Tuned t;
  t.controller = {gains, {0, 1}};
  if (gains.size() <= 3) t.pid = standard(ParallelForm{gains[1], gains[0], gains.size() == 3 ? gains[2] : 0});
  t.n = n, t.Tf = Tf;
  return t;
}

void fail_precondition(std::string_view rule, const std::string& what) {
  throw InputError(fmt::format("{}: {}", rule, what));
}

}  // namespace portrait::rules
