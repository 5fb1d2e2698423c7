/// What a run has measured: for every benchmark its rate in each repetition.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace portrait::bench {

class Results {
 public:
  /// Items (settings, floating-point operations) per second of one repetition.
  void add(const std::string& name, double rate) { rates_[name].push_back(rate); }

  bool has(const std::string& name) const { return rates_.contains(name); }
  /// REQUIRES: has(name).
  double median(const std::string& name) const;
  /// (largest - smallest)/median over the repetitions. REQUIRES: has(name).
  double spread(const std::string& name) const;
  /// Ratio of the medians; nothing unless both were run.
  std::optional<double> ratio(const std::string& name, const std::string& to) const;

 private:
  std::map<std::string, std::vector<double>> rates_;
};

/// Takes the repetitions from Google Benchmark, which itself prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(Results& results) : results_(results) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  Results& results_;
};

}  // namespace portrait::bench
