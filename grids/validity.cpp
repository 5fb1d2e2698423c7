#include "grids/validity.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace portrait {
namespace {

struct PlainValue {
  Parameter parameter;
  double value;
};

/// Values that suit every loop. b and c first: a reason against them speaks of other parameters, never the reverse.
constexpr std::array<PlainValue, 16> kPlainValues = {{{Parameter::c, 0},
                                                      {Parameter::b, 0},
                                                      {Parameter::kappa, 1},
                                                      {Parameter::tau_i, 1},
                                                      {Parameter::delta, 1},
                                                      {Parameter::tau_1, 1},
                                                      {Parameter::tau_f, 1},
                                                      {Parameter::tau_j, 1},
                                                      {Parameter::K_m1, 1},
                                                      {Parameter::K_0, 1},
                                                      {Parameter::K_1, 0},
                                                      {Parameter::K_2, 0},
                                                      {Parameter::K_3, 0},
                                                      {Parameter::K_4, 0},
                                                      {Parameter::K_5, 0},
                                                      {Parameter::K_6, 0}}};

/// The parameter that takes the reason away when it is made plain; the gain, when several do only together.
Parameter culprit(const Loop& loop, const std::string& reason) {
  const auto found = std::find_if(kPlainValues.begin(), kPlainValues.end(), [&](const PlainValue& plain) {
    if (!applies(plain.parameter, loop.family)) return false;
    Loop changed = loop;
    set(changed.setting, plain.parameter, plain.value);
    return why_invalid(changed) != reason;
  });
  if (found != kPlainValues.end()) return found->parameter;
  return has_gains(loop.family) ? Parameter::K_0 : Parameter::kappa;
}

bool gives(const Grid& grid, Parameter parameter) {
  return std::any_of(grid.axes.begin(), grid.axes.end(),
                     [&](const Axis& axis) { return axis.parameter() == parameter; }) ||
         std::any_of(grid.fixed.begin(), grid.fixed.end(),
                     [&](const FixedParameter& fixed) { return fixed.parameter == parameter; });
}

InvalidSetting explained(const Grid& grid, const Loop& loop, const std::string& reason) {
  const Parameter found = culprit(loop, reason);
  if (found == Parameter::b || found == Parameter::c)
    return {found, fmt::format("{}, as in the setting {}", reason, setting_text(loop))};
  if (found == Parameter::delta && gives(grid, Parameter::tau_d))
    return {Parameter::tau_d, "with delta = kappa tau_d, " + reason};
  return {found, reason};
}

}  // namespace

std::optional<InvalidSetting> find_invalid(const Grid& grid) {
  PORTRAIT_CHECK(grid.axes.size() <= kParameterCount);
  std::vector<double> values(grid.axes.size());
  for (std::uint64_t corner = 0; corner < std::uint64_t{1} << values.size(); ++corner) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Axis& axis = grid.axes[k];
      values[k] = axis[(corner >> k & 1) != 0 ? axis.size() - 1 : 0];
    }
    const Loop loop{grid.family, setting_with(grid, values)};
    if (const auto reason = why_invalid(loop)) return explained(grid, loop, *reason);
  }
  return std::nullopt;
}

}  // namespace portrait
