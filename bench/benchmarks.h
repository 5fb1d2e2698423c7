/// The benchmarks by name, for Google Benchmark to run in random order, one repetition of each at a time.
///
///     peak/ISA                        multiplications and additions in registers, every instruction set
///     CASE/engine, CASE/responses, CASE/margins, CASE/batched, CASE/scalar
///                                     settings per second of one core, by CPU time: bench/cases.h, bench/codes.h
///     scaling/one, scaling/all        a sweep on one thread and on all, by the clock; nothing is stored
///     store/nowhere, store/file       a sweep on all threads without and with its portrait file, by the clock
#pragma once

#include <filesystem>
#include <vector>

#include "bench/cases.h"

namespace portrait::bench {

struct Effort {
  int repetitions;
  double seconds;                   ///< a repetition takes at least so long; 0: each code runs once
  std::uint64_t sweep_settings;     ///< 0: as many as one thread measures in about half a second
  std::filesystem::path directory;  ///< where a sweep stores its file for a while
};

void register_peaks(const Effort& effort);

/// REQUIRES: the case outlives the run.
void register_rates(const Case& of, const Effort& effort);

void register_sweeps(const Effort& effort);

}  // namespace portrait::bench
