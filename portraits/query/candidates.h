/// The settings of a tile that a question asks about, and which of them meet constraints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "portraits/query/sheet.h"

namespace portrait {

/// Settings that no constraint was asked about, by reason.
struct LeftOut {
  std::uint64_t unstable = 0;
  std::uint64_t not_settled = 0;
  std::uint64_t not_computed = 0;
  std::uint64_t objective_missing = 0;  ///< met every constraint, but the objective is NaN

  void add(Status status, std::uint64_t settings);
  LeftOut& operator+=(const LeftOut& other);
};

/// How many settings of the portrait were asked, and how many of them were left out by their status.
struct Counted {
  std::uint64_t total = 0;
  LeftOut left_out;
  void merge(const Counted& other) {
    total += other.total;
    left_out += other.left_out;
  }
};

/// Counts a tile by what is known of it; false when its statuses have to be read.
bool count_unread(const Sheet& sheet, std::uint64_t tile, Counted& counted);

/// Positions in the tile that are in the slice and of the right status; the others are counted when `counted` is given.
void choose(const Sheet& sheet, TilePage& page, std::vector<std::size_t>& chosen, Counted* counted = nullptr);

/// Keeps those that meet the constraint.
class Filter {
 public:
  void keep(const Constraint& constraint, TilePage& page, std::vector<std::size_t>& chosen);

 private:
  std::vector<double> left_, right_;
};

}  // namespace portrait
