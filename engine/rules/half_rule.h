/// Fewer lags for a plant with many: the half rule and its modification for equal lags.
///
///     half rule           the largest lag left out goes half to the smallest lag kept, half to the dead time; all smaller
///                         ones go to the dead time, and so do inverse zeros                     [Skogestad2003, Huba2021 2.7]
///     modified half rule  half of the sum of what is left out goes to the lags kept, shared evenly among them as one lag j
///                         times, the other half to the dead time                                     [Huba2021 (36)]
///
/// Both keep the sum of lags and dead time.
/// unit      time
/// REQUIRES: lags above 0; 1 <= kept <= lags.size(), all kept lags of the modified rule equal in sum only.
#pragma once

#include <vector>

namespace portrait::rules {

struct FewLags {
  std::vector<double> lags;  ///< longest first
  double dead_time;
};

FewLags half_rule(std::vector<double> lags, double dead_time, std::size_t kept);
FewLags modified_half_rule(std::vector<double> lags, double dead_time, std::size_t kept);

}  // namespace portrait::rules
