/// A portrait that a larger grid has settings of: their measures are taken from it instead of being computed again.
///
/// The same program with the same instruction set must have made it, of the same loops over the same horizon, with at
/// least the measures and the precision that are wanted now; then what it stores is, bit for bit, what would be computed.
/// What it lacks is not fetched measure by measure: the engine computes all measures of a setting together, so nothing
/// would be saved.
///
/// It is only read. Every tile of it is held against its digest; settings of a damaged one are measured after all, and
/// told.
///
/// errors    InputError: no portrait, or one that cannot be extended to this grid (what differs); StoreError: the disk
/// cost      memory: for each thread a tile of each column. Each tile of it is decoded about once by each thread when
///           both grids have their axes in the same order
/// threads   any number may call `completed`
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "grids/overlap.h"
#include "portraits/reader.h"
#include "portraits/tile_rows.h"

namespace portrait {

class EarlierPortrait {
 public:
  /// `method`: that of the sweep of `grid`.
  EarlierPortrait(const std::filesystem::path& path, const Grid& grid, const std::string& method);

  std::uint64_t settings() const { return reader_.settings(); }
  /// Settings of the grid, or of a box of it, that it has.
  std::uint64_t reused() const { return overlap_.size(); }
  std::uint64_t reused_in(const Box& box) const { return overlap_.size_in(box); }

  /// Settings of a box of the grid that it lacks, in their order: what is to measure.
  std::vector<Setting> missing_in(const Box& box) const;
  /// The columns of the whole box, from those of what was missing.
  MeasureColumns completed(const Box& box, const MeasureColumns& missing);

  /// What was damaged, a line each, and how many settings were measured for it.
  std::vector<std::string> damage() const;
  std::uint64_t measured_again() const;

 private:
  struct Wanted {
    std::uint64_t number;  ///< in the portrait
    std::size_t place;     ///< in the box
  };
  using Run = std::span<const Wanted>;  ///< by number, all in one tile

  std::unique_ptr<ColumnSource> take_reader();
  void give_back(std::unique_ptr<ColumnSource> reader);
  void take_over(const ColumnSource& reader, Run run, const Box& box, MeasureColumns& columns);
  void copy(const ColumnSource& reader, Run run, MeasureColumns& columns) const;
  void measure(Run run, const Box& box, MeasureColumns& columns) const;

  Grid grid_;
  PortraitReader reader_;
  TileRows rows_;
  Overlap overlap_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<ColumnSource>> free_;
  std::vector<std::string> damage_;
  std::uint64_t measured_again_ = 0;
};

}  // namespace portrait
