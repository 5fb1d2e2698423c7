/// The families of rules, each in a file of its own: huba2022.cpp, dalen2018.cpp, ... To add a rule: one function and one
/// row in its family's list; to add a family: one file, one line here and one in catalogue.cpp.
#pragma once

#include <vector>

#include "engine/rules/rule.h"

namespace portrait::rules {

std::vector<Rule> huba2022_rules();
std::vector<Rule> dalen2018_rules();
std::vector<Rule> huba2021_rules();
std::vector<Rule> ho_pid_rules();
std::vector<Rule> kos2021_rules();
std::vector<Rule> field_rules();

}  // namespace portrait::rules
