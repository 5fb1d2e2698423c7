/// What portrait_bench says: a table for people, one JSON object for programs. Medians of the repetitions.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/proof.h"
#include "bench/results.h"

namespace portrait::bench {

struct ProvedCase {
  std::string name;
  Proof proof;
  double flops;  ///< of the responses of one setting
};

struct Report {
  std::string program, instruction_set;
  std::string sweep_method;  ///< how the sweeps compute their measures
  int repetitions, threads;
  std::vector<std::string> peaks;  ///< instruction sets whose peak was measured
  std::vector<ProvedCase> cases;
};

/// What was not run is left out.
std::string table(const Report& report, const Results& results);
nlohmann::ordered_json json(const Report& report, const Results& results);

}  // namespace portrait::bench
