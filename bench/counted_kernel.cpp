// The kernel with bench/counted_lanes.inl in place of engine/kernel/lanes.inl: that one has been included by the
// time the kernel asks for it, under a name that nobody uses. Includes no library templates, as engine/isa/.
#define PORTRAIT_ISA_NAME not_counted
#include "engine/kernel/lanes.inl"
#undef PORTRAIT_ISA_NAME
#define PORTRAIT_ISA_NAME counted
#include "bench/counted_lanes.inl"
#include "engine/kernel/cascade_margins.inl"
#include "engine/kernel/margins.inl"
#include "engine/kernel/noise.inl"
#include "engine/kernel/run_pack.inl"

namespace portrait::counted {

extern const kernel::Implementation kImplementation;
const kernel::Implementation kImplementation = {"counted", kLanes, run, find_margins, find_cascade_margins,
                                                run_noise};

long operations_so_far() { return operations; }

}  // namespace portrait::counted
