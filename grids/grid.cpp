#include "grids/grid.h"

#include <optional>

#include "engine/base/check.h"

namespace portrait {

std::uint64_t setting_count(const Grid& grid) {
  std::uint64_t count = 1;
  for (const Axis& axis : grid.axes) count *= axis.size();
  return count;
}

std::vector<std::uint64_t> coordinates(const Grid& grid, std::uint64_t number) {
  PORTRAIT_ASSERT(number < setting_count(grid));
  std::vector<std::uint64_t> at(grid.axes.size());
  for (std::size_t k = grid.axes.size(); k-- > 0;) {
    at[k] = number % grid.axes[k].size();
    number /= grid.axes[k].size();
  }
  return at;
}

Setting setting_with(const Grid& grid, const std::vector<double>& values) {
  PORTRAIT_CHECK_EQ(values.size(), grid.axes.size());
  Setting setting;
  std::optional<double> tau_d;
  const auto assign = [&](Parameter parameter, double value) {
    if (parameter == Parameter::tau_d)
      tau_d = value;
    else
      set(setting, parameter, value);
  };
  for (const FixedParameter& fixed : grid.fixed) assign(fixed.parameter, fixed.value);
  for (std::size_t k = 0; k < values.size(); ++k) assign(grid.axes[k].parameter(), values[k]);
  if (tau_d) set(setting, Parameter::tau_d, *tau_d);
  return setting;
}

Setting setting_at(const Grid& grid, const std::vector<std::uint64_t>& coordinates) {
  PORTRAIT_CHECK_EQ(coordinates.size(), grid.axes.size());
  std::vector<double> values(coordinates.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = grid.axes[k][coordinates[k]];
  return setting_with(grid, values);
}

Setting setting_at(const Grid& grid, std::uint64_t number) { return setting_at(grid, coordinates(grid, number)); }

}  // namespace portrait
