/// The options that describe a loop, which several verbs have.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/simulate_arguments.h"

namespace portrait::tools {

void add_loop_options(CLI::App& verb, SimulateArguments& a);

}  // namespace portrait::tools
