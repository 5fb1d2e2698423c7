/// portrait characteristic: speed against effort and wobbling as one parameter runs.
#pragma once

#include "tools/verbs.h"

namespace portrait::tools {

void add_characteristic(CLI::App& app, Invocation& invocation);

}  // namespace portrait::tools
