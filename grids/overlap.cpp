#include "grids/overlap.h"

#include <algorithm>

namespace portrait {
namespace {

/// Index of the value on the axis. Grids have no -0, so that equal numbers are the same bits.
std::optional<std::uint64_t> index_of(const Axis& axis, double value) {
  std::uint64_t low = 0, high = axis.size();
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (axis[middle] < value)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == axis.size() || axis[low] != value) return std::nullopt;
  return low;
}

/// A parameter of a grid, an axis or not: its values, and how far apart neighbours along it are in number.
struct Along {
  Axis axis;
  std::uint64_t stride;
};

std::optional<Along> along(const Grid& grid, Parameter parameter) {
  std::uint64_t stride = 1;
  for (std::size_t k = grid.axes.size(); k-- > 0;) {
    if (grid.axes[k].parameter() == parameter) return Along{grid.axes[k], stride};
    stride *= grid.axes[k].size();
  }
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter == parameter) return Along{Axis::list(parameter, {fixed.value}), 0};
  return std::nullopt;
}

}  // namespace

Overlap::Overlap(const Grid& grid, const Grid& other) {
  for (const FixedParameter& fixed : grid.fixed) {
    const std::optional<Along> there = along(other, fixed.parameter);
    const auto index = there ? index_of(there->axis, fixed.value) : std::nullopt;
    if (index)
      fixed_part_ += *index * there->stride;
    else if (!apart_)
      apart_ = fixed.parameter;
  }
  for (const Axis& axis : grid.axes) {
    std::vector<Match> matches;
    if (const std::optional<Along> there = along(other, axis.parameter()))
      for (std::uint64_t i = 0; i < there->axis.size(); ++i)
        if (const auto here = index_of(axis, there->axis[i])) matches.push_back({*here, i * there->stride});
    if (matches.empty() && !apart_) apart_ = axis.parameter();
    along_.push_back(std::move(matches));
  }
}

std::uint64_t Overlap::size() const {
  std::uint64_t count = apart_ ? 0 : 1;
  for (const std::vector<Match>& matches : along_) count *= matches.size();
  return count;
}

/// Those of an axis that lie in the box.
std::span<const Overlap::Match> Overlap::within(const Box& box, std::size_t axis) const {
  const auto before = [](const Match& match, std::uint64_t here) { return match.here < here; };
  const std::vector<Match>& all = along_[axis];
  const auto first = std::lower_bound(all.begin(), all.end(), box.start[axis], before);
  return {first, std::lower_bound(first, all.end(), box.start[axis] + box.extent[axis], before)};
}

std::uint64_t Overlap::size_in(const Box& box) const {
  std::uint64_t count = apart_ ? 0 : 1;
  for (std::size_t k = 0; k < along_.size(); ++k) count *= within(box, k).size();
  return count;
}

/// Axis by axis, the last one last: every number so far becomes one for each value of the next axis.
std::vector<std::uint64_t> Overlap::numbers_in(const Box& box) const {
  std::vector<std::uint64_t> numbers = {apart_ ? kNone : fixed_part_};
  for (std::size_t k = 0; k < along_.size(); ++k) {
    std::vector<std::uint64_t> parts(box.extent[k], kNone), next;
    for (const Match& match : within(box, k)) parts[match.here - box.start[k]] = match.there;
    next.reserve(numbers.size() * parts.size());
    for (const std::uint64_t number : numbers)
      for (const std::uint64_t part : parts) next.push_back(number == kNone || part == kNone ? kNone : number + part);
    numbers = std::move(next);
  }
  return numbers;
}

}  // namespace portrait
