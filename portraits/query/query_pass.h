/// The one pass of a query over a portrait: block by block, everything that the answer needs is tallied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "portraits/query/parameter_columns.h"
#include "portraits/query/query.h"
#include "portraits/query/ranking.h"

namespace portrait {

/// What is known after the settings seen so far.
struct Tally {
  struct Nearest {
    Candidate candidate;
    double worst;  ///< largest relative violation
    std::vector<Violation> violations;
  };

  Tally(std::size_t top, std::size_t constraints);

  Ranking best;                       ///< of the admissible ones
  std::vector<Ranking> best_without;  ///< by constraint, one place each: of those that fail this constraint alone
  std::uint64_t admissible = 0;
  std::uint64_t total = 0;
  LeftOut left_out;
  std::vector<std::uint64_t> excluded;  ///< by constraint
  std::optional<Nearest> nearest;       ///< kept up to date as long as nothing is admissible
};

class QueryPass {
 public:
  /// `tau_1`: ask only the settings with this value on the axis tau_1.
  /// REQUIRES: the question fits the source's grid; both outlive the pass.
  QueryPass(const ColumnSource& source, const Question& question, std::optional<double> tau_1);

  /// Once. REQUIRES: not called before.
  Tally run();

 private:
  struct Sides {
    std::vector<double> left, right;
  };

  void block();
  void choose_candidates();
  bool has_right_status(Status status);
  void read_columns();
  void evaluate();
  void judge(std::size_t i);
  void consider_near_miss(std::size_t i, const Candidate& candidate);
  bool is_violated(std::size_t constraint, std::size_t i) const;

  const ColumnSource& source_;
  const Question& question_;
  std::optional<double> tau_1_;
  ParameterColumns parameters_;
  std::vector<Quantity> used_;
  Tally tally_;

  // Of the current block:
  std::uint64_t first_ = 0;
  Columns columns_;
  std::vector<Status> statuses_;
  std::vector<std::size_t> candidates_;  ///< positions in the block
  std::vector<double> objective_;
  std::vector<Sides> sides_;           ///< by constraint
  std::vector<std::size_t> violated_;  ///< constraints that the current setting fails
  ColumnStack stack_;
};

}  // namespace portrait
