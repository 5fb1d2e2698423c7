#include "engine/rules/catalogue.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/rules/families.h"

namespace portrait::rules {
namespace {

std::vector<Rule> joined_families() {
  std::vector<Rule> all;
  for (auto* family : {huba2022_rules, dalen2018_rules, huba2021_rules, ho_pid_rules, kos2021_rules, field_rules})
    for (Rule& rule : family()) all.push_back(std::move(rule));
  return all;
}

void check_plant(const Rule& rule, const RulePlant& plant) {
  if (plant.K == 0 || !std::isfinite(plant.K)) fail_precondition(rule.name, "K must be finite and not 0");
  if (!(plant.Td >= 0) || !std::isfinite(plant.Td))
    fail_precondition(rule.name, "Td must be finite and not below 0");
}

/// A formula beyond its domain shows in a number that is none.
void check_finite(const Rule& rule, const Tuned& tuned) {
  for (const Polynomial& p : {tuned.controller.numerator, tuned.controller.denominator})
    for (const double a : p)
      if (!std::isfinite(a))
        fail_precondition(rule.name, "the plant lies outside its domain: a gain comes out infinite");
}

}  // namespace

const std::vector<Rule>& catalogue() {
  static const std::vector<Rule> all = joined_families();
  return all;
}

const Rule& rule_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Rule& rule : catalogue()) {
    if (rule.name == name) return rule;
    names.push_back(rule.name);
  }
  const auto nearest = nearest_word(name, names);
  throw InputError(nearest ? fmt::format("unknown rule \"{}\" (did you mean \"{}\"?)", name, *nearest)
                           : fmt::format("unknown rule \"{}\": portrait tune --list shows them all", name));
}

Tuned tune(const Rule& rule, const RulePlant& plant, const std::map<std::string, std::string>& options) {
  check_plant(rule, plant);
  Tuned tuned = rule.tune(plant, Choices(rule.name, rule.options, options));
  check_finite(rule, tuned);
  return tuned;
}

std::vector<OptionInfo> all_options() {
  std::vector<OptionInfo> all;
  for (const Rule& rule : catalogue())
    for (const OptionInfo& option : rule.options)
      if (std::none_of(all.begin(), all.end(), [&](const OptionInfo& o) { return o.name == option.name; }))
        all.push_back(option);
  return all;
}

}  // namespace portrait::rules
