#include "portraits/query/ranking.h"

#include <algorithm>
#include <limits>

namespace portrait {

void Ranking::offer(const Candidate& candidate) {
  if (heap_.size() == size_) {
    if (!is_better(candidate, heap_.front())) return;
    std::pop_heap(heap_.begin(), heap_.end(), is_better);
    heap_.pop_back();
  }
  heap_.push_back(candidate);
  std::push_heap(heap_.begin(), heap_.end(), is_better);
}

double Ranking::worst_that_enters() const {
  return heap_.size() < size_ ? std::numeric_limits<double>::infinity() : heap_.front().objective;
}

std::vector<Candidate> Ranking::sorted() const {
  std::vector<Candidate> best = heap_;
  std::sort_heap(best.begin(), best.end(), is_better);
  return best;
}

}  // namespace portrait
