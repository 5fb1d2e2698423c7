/// Outcome of one setting, stored beside its measures. The numbers are written to files: never renumber.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace portrait {

enum class Status : std::uint8_t {
  not_computed = 0,  ///< the default: no work was done for this setting
  settled = 1,       ///< stable, and within the settling band at the horizon
  not_settled = 2,   ///< stable, yet outside the settling band at the horizon, or still moving at the cap of an
                     ///< automatic one: the integrals are truncated
  unstable = 3,      ///< at least one closed-loop root in the closed right half-plane: measures are NaN
};

inline constexpr std::array<std::string_view, 4> kStatusNames = {"not_computed", "settled", "not_settled",
                                                                 "unstable"};

constexpr std::string_view to_string(Status status) { return kStatusNames[static_cast<std::size_t>(status)]; }

}  // namespace portrait
