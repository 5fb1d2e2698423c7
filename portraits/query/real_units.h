/// A portrait as a real plant sees it: its measures in real units, and of fotd the slice with its T1.
#pragma once

#include <array>
#include <optional>

#include "engine/loop/real_plant.h"
#include "portraits/column_source.h"

namespace portrait {

/// The same settings with every measure times scale(measure, plant).
class RealUnits final : public ColumnSource {
 public:
  /// REQUIRES: `source` outlives this.
  RealUnits(const ColumnSource& source, const RealPlant& plant);

  const Grid& grid() const override { return source_.grid(); }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override;
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    source_.read_statuses(first, count, statuses);
  }

 private:
  const ColumnSource& source_;
  std::array<double, kMeasureCount> scales_;
};

/// Throws InputError when the plant cannot be, is of another family than the portrait's, or has a T1/Td that
/// the portrait does not hold.
void require_fits(const RealPlant& plant, const Grid& grid);

/// The value on the axis tau_1 that is T1/Td within 1e-9; nothing when tau_1 is no axis.
/// REQUIRES: require_fits.
std::optional<double> slice_of(const RealPlant& plant, const Grid& grid);

}  // namespace portrait
