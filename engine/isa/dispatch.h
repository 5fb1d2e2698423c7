/// Which instruction set the kernel runs on: the best that this machine has, or the one that PORTRAIT_ISA names.
#pragma once

#include <vector>

#include "engine/kernel/pack.h"

namespace portrait {

/// Those this machine can run, the slowest first: base, avx2, avx512.
std::vector<const kernel::Implementation*> available_implementations();

/// The last of these, or the one that the environment variable PORTRAIT_ISA names.
/// Throws InputError when it names none that is known, or one that this machine lacks. Looked up at each call.
const kernel::Implementation& chosen_implementation();

}  // namespace portrait
