#include "tools/plant_arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/rules/tuned_loop.h"
#include "tools/arguments.h"
#include "tools/output.h"

namespace portrait::tools {
namespace {

using rules::RulePlant;

constexpr std::string_view kTransferFunction = "tf:";

double positive(std::string_view option, const std::string& text) {
  const double value = number_argument(option, text);
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("{} must be finite and above 0 (it is {})", option, text));
  return value;
}

/// Options that the plant has no use for are errors, not silence.
void allow_only(const PlantArguments& a, std::string_view plant, const std::vector<std::string_view>& known) {
  const std::pair<std::string_view, const std::string&> given[] = {
      {"--K", a.K}, {"--T1", a.T1}, {"--j", a.j}, {"--Tj", a.Tj}};
  for (const auto& [option, text] : given)
    if (!text.empty() && std::find(known.begin(), known.end(), option) == known.end())
      throw InputError(fmt::format("{} has no place here: {} has none", option, plant));
}

void need(std::string_view option, const std::string& text, std::string_view plant) {
  if (text.empty()) throw InputError(fmt::format("{} is missing: {} has one", option, plant));
}

/// "1,2.5,0" -> 0, 2.5, 1: from the highest power down to the lowest up.
Polynomial coefficients(std::string_view option, std::string_view text) {
  Polynomial p;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string_view part = text.substr(from, comma - from);
    const auto number = parse_number(part);
    if (!number || !std::isfinite(*number))
      throw InputError(fmt::format("{}: \"{}\" is not a number", option, part));
    p.insert(p.begin(), *number);
    from = comma + 1;
  }
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

/// Takes s^k out of p and what is then its constant term, and returns both; p(0) is 1 afterwards.
std::pair<int, double> lowest_term(Polynomial& p) {
  const auto first = std::find_if(p.begin(), p.end(), [](double a) { return a != 0; });
  const int power = static_cast<int>(first - p.begin());
  const double lowest = *first;
  p.erase(p.begin(), first);
  for (double& a : p) a /= lowest;
  return {power, lowest};
}

}  // namespace

void add_plant_options(CLI::App& verb, PlantArguments& a) {
  verb.add_option("--plant", a.plant, "dipdt, ipdt, fotd, jotd, or tf:NUM/DEN (coefficients, highest power first)");
  verb.add_option("--K", a.K, "plant gain (default 1)");
  verb.add_option("--Td", a.Td, "dead time (default 1; tf: 0)");
  verb.add_option("--T1", a.T1, "time constant (fotd)");
  verb.add_option("--j", a.j, "number of equal lags, 1 .. 8 (jotd)");
  verb.add_option("--Tj", a.Tj, "their time constant (jotd)");
}

RulePlant transfer_function_argument(std::string_view option, std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos)
    throw InputError(
        fmt::format("{}: \"{}\" is not of the form tf:NUM/DEN, as tf:34/13.5,54.25,55,1", option, text));
  Polynomial N = coefficients(option, text.substr(0, slash)), D = coefficients(option, text.substr(slash + 1));
  if (N.empty() || D.empty()) throw InputError(fmt::format("{}: numerator and denominator must not be 0", option));
  if (N.size() > D.size())
    throw InputError(fmt::format("{}: more zeros than poles: the plant is improper", option));
  RulePlant plant;
  const auto [zeros_at_0, numerator] = lowest_term(N);
  const auto [poles_at_0, denominator] = lowest_term(D);
  if (zeros_at_0 > 0)
    throw InputError(
        fmt::format("{}: the plant has a zero at s = 0: no controller brings it to a setpoint", option));
  plant.integrators = poles_at_0, plant.K = numerator / denominator, plant.zeros = N;
  if (D.size() > 1) plant.poles.push_back(D);
  return plant;
}

RulePlant plant_argument(const PlantArguments& a) {
  if (a.plant.empty()) throw InputError("--plant is missing: dipdt, ipdt, fotd, jotd or tf:NUM/DEN");
  const double K = a.K.empty() ? 1 : number_argument("--K", a.K);
  if (K == 0 || !std::isfinite(K)) throw InputError(fmt::format("--K must be finite and not 0 (it is {})", a.K));
  const bool is_tf = a.plant.starts_with(kTransferFunction);
  const double Td = a.Td.empty() ? (is_tf ? 0 : 1) : number_argument("--Td", a.Td);
  if (!(Td >= 0) || !std::isfinite(Td))
    throw InputError(fmt::format("--Td must be finite and not below 0 (it is {})", a.Td));
  if (is_tf) {
    allow_only(a, "a plant tf:", {"--K"});
    RulePlant plant =
        transfer_function_argument("--plant", std::string_view(a.plant).substr(kTransferFunction.size()));
    plant.K *= K, plant.Td = Td, plant.name = a.plant;
    return plant;
  }
  if (a.plant == "dipdt" || a.plant == "ipdt") {
    allow_only(a, a.plant, {"--K"});
    return a.plant == "dipdt" ? rules::dipdt(K, Td) : rules::ipdt(K, Td);
  }
  if (a.plant == "fotd") {
    allow_only(a, a.plant, {"--K", "--T1"});
    need("--T1", a.T1, a.plant);
    return rules::jotd(K, Td, positive("--T1", a.T1), 1);
  }
  if (a.plant == "jotd") {
    allow_only(a, a.plant, {"--K", "--j", "--Tj"});
    need("--j", a.j, a.plant), need("--Tj", a.Tj, a.plant);
    const double j = number_argument("--j", a.j);
    if (!(j >= 1 && j <= 8 && j == std::floor(j)))
      throw InputError(fmt::format("--j must be a whole number, 1 .. 8 (it is {})", a.j));
    return rules::jotd(K, Td, positive("--Tj", a.Tj), static_cast<int>(j));
  }
  throw InputError(fmt::format("--plant: unknown plant \"{}\"{}", a.plant,
                               suggestion(a.plant, {"dipdt", "ipdt", "fotd", "jotd", "tf:"})));
}

std::string rule_plant_text(const RulePlant& plant) {
  if (const auto real = rules::family_plant(plant)) return plant_text(*real);
  return fmt::format("{}, K = {}, Td = {}", plant.name, short_number(plant.K), short_number(plant.Td));
}

}  // namespace portrait::tools
