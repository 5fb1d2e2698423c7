/// Two rows of measures that keep the promise of engine/reference/response.h: integrals of the error to 1e-9,
/// all else to 1e-7.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "engine/measures/catalogue.h"

namespace portrait::reference {

inline constexpr double kIae = 1e-9, kTv = 1e-7;

/// The TV a measure of the family TV, TV0, TV1, TV2 is judged by; itself for all others.
inline Measure scale_of(Measure measure) {
  const std::string name(to_string(measure));
  return name.starts_with("TV") ? *measure_named("TV_" + name.substr(name.size() - 2)) : measure;
}

/// IAE, ISE, ITAE and ITSE are integrals of the error.
inline double tolerance_of(Measure measure) {
  const std::string_view name = to_string(measure);
  return name.starts_with("I") ? kIae : kTv;
}

inline void expect_same_measures(const MeasureRow& found, const MeasureRow& expected) {
  for (const Measure m : all_measures()) {
    EXPECT_EQ(std::isnan(found[m]), std::isnan(expected[m])) << to_string(m);
    if (std::isnan(expected[m]) || found[m] == expected[m]) continue;
    EXPECT_NEAR(found[m], expected[m], tolerance_of(m) * expected[scale_of(m)]) << to_string(m);
  }
}

}  // namespace portrait::reference
