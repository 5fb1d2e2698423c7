/// The parameters of a run of settings as columns, without making each setting.
///
/// The numbers are those of `get(setting_at(grid, number), parameter)`, save that an axis tau_d gives its own
/// values and not delta/kappa, which may differ in the last digit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grids/grid.h"
#include "portraits/query/interval.h"

namespace portrait {

class ParameterColumns {
 public:
  /// Keeps the values of every axis.
  explicit ParameterColumns(const Grid& grid);

  /// Settings first .. first + count - 1; `values` is resized. REQUIRES: the grid's family has the parameter.
  void read(Parameter parameter, std::uint64_t first, std::size_t count, std::vector<double>& values) const;

  /// Encloses them. REQUIRES: as read, count >= 1.
  Interval bound(Parameter parameter, std::uint64_t first, std::size_t count) const;

 private:
  struct Source {
    std::vector<double> values;  ///< of an axis; of a fixed parameter the one
    std::uint64_t stride = 1;    ///< settings in a row that share a value
  };
  static Interval spanned(const Source& source, std::uint64_t first, std::size_t count);
  static void repeat(const Source& source, std::uint64_t first, std::size_t count, std::vector<double>& values);

  std::vector<std::optional<Source>> sources_;  ///< by parameter; nothing for what is computed
};

}  // namespace portrait
