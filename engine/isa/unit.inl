/// The kernel for one instruction set. Included once by each file of this folder, with PORTRAIT_ISA_NAME defined; the
/// -m flags of these files stand in engine/CMakeLists.txt and nowhere else.
#pragma once

#include "engine/kernel/cascade_margins.inl"
#include "engine/kernel/margins.inl"
#include "engine/kernel/noise.inl"
#include "engine/kernel/run_pack.inl"

#define PORTRAIT_TEXT_OF(name) #name
#define PORTRAIT_TEXT(name) PORTRAIT_TEXT_OF(name)

namespace portrait::PORTRAIT_ISA_NAME {

extern const kernel::Implementation kImplementation;
const kernel::Implementation kImplementation = {PORTRAIT_TEXT(PORTRAIT_ISA_NAME), kLanes, run, find_margins,
                                               find_cascade_margins, run_noise};

}  // namespace portrait::PORTRAIT_ISA_NAME
