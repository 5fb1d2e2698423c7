/// A general loop from the line of `portrait simulate`, in the units in which it is typed.
#pragma once

#include "engine/loop/general_loop.h"
#include "tools/simulate_arguments.h"

namespace portrait::tools {

/// Throws InputError with the option's name, or with why the loop cannot be.
GeneralLoop general_loop_argument(const SimulateArguments& a);

}  // namespace portrait::tools
