/// The best few of many settings: the smallest objective first, of equals the lower number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/status.h"

namespace portrait {

struct Candidate {
  std::uint64_t number;  ///< of the setting
  double objective;      ///< not NaN
  Status status;
};

inline bool is_better(const Candidate& a, const Candidate& b) {
  return a.objective != b.objective ? a.objective < b.objective : a.number < b.number;
}

/// memory    at most `size` candidates, whatever is offered
class Ranking {
 public:
  /// REQUIRES: size >= 1.
  explicit Ranking(std::size_t size) : size_(size) {}

  void offer(const Candidate& candidate);
  /// An objective above this does not enter any more; inf as long as there is room.
  double worst_that_enters() const;
  /// Best first.
  std::vector<Candidate> sorted() const;

 private:
  std::size_t size_;
  std::vector<Candidate> heap_;  ///< the worst one in front
};

}  // namespace portrait
