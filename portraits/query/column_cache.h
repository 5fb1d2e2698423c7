/// A portrait for many questions in a row: columns stay in memory once they were read, the least used ones leave first.
///
/// memory    at most `limit` bytes of columns, that of the statuses among them, for which there is always room; where they and
///           one measure do not fit, all is read from the file each time
/// threads   any number at a time
/// accuracy  the same bits as the source: tests/portraits/query/planes_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "portraits/column_source.h"

namespace portrait {

class ColumnCache final : public ColumnSource {
 public:
  /// REQUIRES: the source outlives this, and nobody else reads from it.
  ColumnCache(const ColumnSource& source, std::size_t limit);

  const Grid& grid() const override { return source_.grid(); }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override;
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override;

  std::vector<TileRange> tile_ranges(Measure measure) const override;
  std::vector<StatusCounts> tile_status_counts() const override;
  /// One that reads through this one, which has to outlive it.
  std::unique_ptr<ColumnSource> for_another_thread() const override;

  /// Bytes of columns held.
  std::size_t held() const;

 private:
  using Column = std::shared_ptr<const std::vector<double>>;
  using Statuses = std::shared_ptr<const std::vector<Status>>;

  Column column(Measure measure) const;
  Statuses statuses() const;
  /// Whether so many measures and the statuses stay within the limit.
  bool fit(std::size_t columns) const;
  /// For one more.
  void make_room() const;

  const ColumnSource& source_;
  const std::size_t limit_;
  const std::uint64_t settings_;
  mutable std::mutex mutex_;
  mutable std::list<Measure> recent_;  ///< the one used last in front
  mutable std::map<Measure, Column> columns_;
  mutable Statuses statuses_;
  mutable std::map<Measure, std::vector<TileRange>> ranges_;
  mutable std::optional<std::vector<StatusCounts>> counts_;
};

}  // namespace portrait
