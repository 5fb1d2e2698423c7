/// The settings that two grids have in common, found by the exact values of their parameters: bit for bit, whether a
/// value is an axis's or fixed, and whatever the order of the axes.
///
/// cost      memory: two numbers for each common value of an axis, however many values the axes have
/// REQUIRES: both grids are of one family; whoever asks has compared what else decides the results.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grids/grid.h"
#include "grids/tiling.h"

namespace portrait {

class Overlap {
 public:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  Overlap(const Grid& grid, const Grid& other);

  /// Settings that both have.
  std::uint64_t size() const;
  /// Those in a box of `grid`.
  std::uint64_t size_in(const Box& box) const;
  /// For each setting of a box of `grid`, row-major: its number in the other grid, or kNone.
  std::vector<std::uint64_t> numbers_in(const Box& box) const;
  /// A parameter that has no value in common, or that the other grid does not give (tau_d in place of delta); there when
  /// size() is 0.
  std::optional<Parameter> apart() const { return apart_; }

 private:
  /// Value `here` of an axis, and what it adds to a setting's number in the other grid.
  struct Match {
    std::uint64_t here, there;
  };
  std::span<const Match> within(const Box& box, std::size_t axis) const;

  std::vector<std::vector<Match>> along_;  ///< of each axis of `grid`, by `here`
  std::uint64_t fixed_part_ = 0;           ///< of the number, from parameters that are fixed in `grid`
  std::optional<Parameter> apart_;
};

}  // namespace portrait
