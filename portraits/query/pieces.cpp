#include "portraits/query/pieces.h"

#include <algorithm>
#include <numeric>

namespace portrait {
namespace {

/// Sets that are joined two by two.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The lower root stays.
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins runs that lie beside each other, `stride` settings apart, along an axis of `size` values. One walk: both partners
/// come in the order of their numbers.
void join_along(const std::vector<SettingRange>& runs, std::uint64_t stride, std::uint64_t size, Joined& joined) {
  for (std::size_t i = 0, below = 0; i < runs.size(); ++i) {
    if (runs[i].first / stride % size == 0) continue;
    const std::uint64_t first = runs[i].first - stride, end = runs[i].end() - stride;
    while (runs[below].end() <= first) ++below;
    for (std::size_t j = below; j < runs.size() && runs[j].first < end; ++j) joined.join(i, j);
  }
}

void extend(Piece& piece, const Grid& grid, const SettingRange& run) {
  const std::vector<std::uint64_t> at = coordinates(grid, run.first);
  std::vector<std::uint64_t> to = at;
  if (!to.empty()) to.back() += run.count - 1;
  if (piece.settings == 0) piece = {0, run.first, at, to};
  piece.settings += run.count;
  for (std::size_t k = 0; k < at.size(); ++k) {
    piece.first[k] = std::min(piece.first[k], at[k]);
    piece.last[k] = std::max(piece.last[k], to[k]);
  }
}

}  // namespace

std::vector<Piece> pieces_of(const Grid& grid, std::vector<SettingRange> runs) {
  std::sort(runs.begin(), runs.end(),
            [](const SettingRange& a, const SettingRange& b) { return a.first < b.first; });
  Joined joined(runs.size());
  std::uint64_t stride = 1;
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    join_along(runs, stride, axis->size(), joined);
    stride *= axis->size();
  }
  std::vector<Piece> by_root(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) extend(by_root[joined.root(i)], grid, runs[i]);
  std::erase_if(by_root, [](const Piece& piece) { return piece.settings == 0; });
  std::sort(by_root.begin(), by_root.end(), [](const Piece& a, const Piece& b) {
    return a.settings != b.settings ? a.settings > b.settings : a.lowest < b.lowest;
  });
  return by_root;
}

}  // namespace portrait
