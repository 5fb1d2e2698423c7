/// Every tuning rule Portrait knows, by name.
#pragma once

#include <map>
#include <string>

#include "engine/rules/rule.h"

namespace portrait::rules {

const std::vector<Rule>& catalogue();

/// Throws InputError with the nearest name.
const Rule& rule_named(std::string_view name);

/// The rule's answer for this plant. Throws InputError where a precondition or an option fails.
Tuned tune(const Rule& rule, const RulePlant& plant, const std::map<std::string, std::string>& options);

/// Every option any rule takes, each once.
std::vector<OptionInfo> all_options();

}  // namespace portrait::rules
