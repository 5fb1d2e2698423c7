#include "engine/rules/half_rule.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "engine/base/check.h"

namespace portrait::rules {

FewLags half_rule(std::vector<double> lags, double dead_time, std::size_t kept) {
  PORTRAIT_CHECK(kept >= 1 && kept <= lags.size());
  std::sort(lags.begin(), lags.end(), std::greater<>());
  if (kept < lags.size()) {
    const double half = lags[kept] / 2;
    lags[kept - 1] += half;
    dead_time = std::accumulate(lags.begin() + static_cast<std::ptrdiff_t>(kept) + 1, lags.end(), dead_time + half);
    lags.resize(kept);
    std::sort(lags.begin(), lags.end(), std::greater<>());
  }
  return {lags, dead_time};
}

FewLags modified_half_rule(std::vector<double> lags, double dead_time, std::size_t kept) {
  PORTRAIT_CHECK(kept >= 1 && kept <= lags.size());
  std::sort(lags.begin(), lags.end(), std::greater<>());
  const auto border = lags.begin() + static_cast<std::ptrdiff_t>(kept);
  const double half = std::accumulate(border, lags.end(), 0.0) / 2;
  const double sum = std::accumulate(lags.begin(), border, half);
  return {std::vector<double>(kept, sum / static_cast<double>(kept)), dead_time + half};
}

}  // namespace portrait::rules
