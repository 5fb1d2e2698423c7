/// A recorded response on a command line: --response FILE.csv, what to make of it, and what is said about it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/rules/rule.h"
#include "tools/output.h"

namespace portrait::tools {

struct ResponseArguments {
  std::string file, settled_from;
  bool drift = false;
};

void add_response_options(CLI::App& verb, ResponseArguments& arguments);

/// A plant from a record, with what was found on the way.
struct RecordedPlant {
  rules::RulePlant plant;
  std::vector<rules::Finding> found;  ///< levels, noise, residual, areas
  std::vector<std::string> remarks;
};

/// `family`: dipdt, ipdt or fotd for a fitted plant; self-regulating or integrating for areas alone; reaction-curve for the
/// integrator of its steepest tangent. Throws InputError.
RecordedPlant recorded_plant(const ResponseArguments& arguments, const std::string& family);

}  // namespace portrait::tools
