#include "bench/results.h"

#include <algorithm>
#include <stdexcept>

namespace portrait::bench {

double Results::median(const std::string& name) const {
  std::vector<double> sorted = rates_.at(name);
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

double Results::spread(const std::string& name) const {
  const auto [low, high] = std::minmax_element(rates_.at(name).begin(), rates_.at(name).end());
  return (*high - *low) / median(name);
}

std::optional<double> Results::ratio(const std::string& name, const std::string& to) const {
  if (!has(name) || !has(to)) return std::nullopt;
  return median(name) / median(to);
}

void Collector::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred) throw std::runtime_error(run.benchmark_name() + ": " + run.error_message);
    if (run.run_type == Run::RT_Iteration)
      results_.add(run.run_name.function_name, run.counters.at("items_per_second").value);
  }
}

}  // namespace portrait::bench
