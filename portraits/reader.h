/// Reads a portrait: its grid, where it comes from, and ranges of its columns.
///
/// Whatever is read was held against the digest of its tile, so a value that comes back is the value that was
/// written.
///
/// shape     settings are numbered row-major, as in Grid; a range is `count` settings from `first` on
/// errors    InputError: no such file, no portrait, or one of a newer format. IntegrityError: a portrait that
/// is not
///           what was written. StoreError: the disk. Each names the file, and the dataset or attribute
/// cost      opening reads attributes and axes; reading decodes each tile once, and holds one tile per column
/// REQUIRES: one thread at a time; `for_another_thread` gives another one its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/base/status.h"
#include "grids/grid.h"
#include "portraits/column_source.h"
#include "portraits/facts.h"

namespace portrait {

class PortraitReader final : public ColumnSource {
 public:
  explicit PortraitReader(const std::filesystem::path& path);
  ~PortraitReader() override;
  PortraitReader(PortraitReader&&) noexcept;
  PortraitReader& operator=(PortraitReader&&) noexcept;

  const std::filesystem::path& path() const;
  const Grid& grid() const override;  ///< with the measures the portrait has
  const Facts& facts() const;

  bool has(Measure measure) const;
  std::uint64_t settings() const { return setting_count(grid()); }
  Setting setting(std::uint64_t number) const { return setting_at(grid(), number); }

  /// `values` is resized to `count`. REQUIRES: has(measure), first + count <= settings().
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override;
  /// The same of outcomes.
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override;

  std::vector<TileRange> tile_ranges(Measure measure) const override;
  std::vector<StatusCounts> tile_status_counts() const override;
  std::unique_ptr<ColumnSource> for_another_thread() const override;

 private:
  class File;
  explicit PortraitReader(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

}  // namespace portrait
