/// The baselines for one instruction set. Included once by each of base.cpp, avx2.cpp and avx512.cpp, with
/// PORTRAIT_ISA_NAME defined; their -m flags are those of the engine's files of the same names.
#pragma once

#include "bench/isa/fma_peak.inl"
#include "bench/isa/step_loop.inl"

#define PORTRAIT_TEXT_OF(name) #name
#define PORTRAIT_TEXT(name) PORTRAIT_TEXT_OF(name)

namespace portrait::bench::PORTRAIT_ISA_NAME {

extern const Baseline kBaseline;
const Baseline kBaseline = {PORTRAIT_TEXT(PORTRAIT_ISA_NAME), Lanes::kCount, run_step_loop<One>,
                            run_step_loop<Lanes>, multiply_and_add};

}  // namespace portrait::bench::PORTRAIT_ISA_NAME
