/// A number that a user typed against the values of an axis: found within a tolerance, or the nearest named.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace portrait {

/// Two numbers that are meant to be the same differ by at most this, relative to the larger.
inline constexpr double kSameWithin = 1e-9;

/// Within kSameWithin; infinities are the same only when equal, NaN never.
bool same_number(double a, double b);

/// Index of the value nearest to `wanted` among those that are the same number.
/// REQUIRES: not empty, strictly increasing.
std::optional<std::size_t> index_of_value(const std::vector<double>& values, double wanted);

/// The neighbours of a number that is not among the values: "0.35 and 0.36", at an end only "0.05".
/// REQUIRES: not empty, strictly increasing.
std::string nearest_values(const std::vector<double>& values, double wanted);

}  // namespace portrait
