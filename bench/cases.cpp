#include "bench/cases.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "grids/grid_file.h"

namespace portrait::bench {
namespace {

constexpr const char* kHead = R"(plant = "{}"
n = 1
prefilter = "full"
horizon = 51
[parameters]
b = 0
c = 0
)";

Case case_of(std::string name, const char* plant, const std::string& parameters) {
  Grid grid = parse_grid(fmt::format(kHead, plant) + parameters, "case " + name);
  std::vector<Setting> settings;
  for (std::uint64_t i = 0; i < setting_count(grid); ++i) settings.push_back(setting_at(grid, i));
  return {std::move(name), std::move(grid), std::move(settings)};
}

std::string around_qrdp(double tau_f, int gains, std::uint64_t times) {
  return fmt::format(R"(kappa = {{ from = 0.1123, to = 0.1373, count = {0} }}
delta = {{ from = 0.454, to = 0.555, count = {0} }}
tau_i = {{ from = 8.26, to = 12.39, count = {1} }}
tau_f = {2}
)",
                     gains, times, tau_f);
}

constexpr const char* kIpdtPi = R"(kappa = { from = 0.4, to = 0.6, count = 50 }
tau_i = { from = 6, to = 10, count = 64 }
delta = 0
tau_f = 0.1
)";

constexpr const char* kIpdtPid = R"(kappa = { from = 0.4, to = 0.6, count = 10 }
delta = { from = 0.16, to = 0.24, count = 10 }
tau_i = { from = 6, to = 10, count = 32 }
tau_f = 0.1
)";

constexpr const char* kFotdPi = R"(tau_1 = { from = 1.6, to = 2.4, count = 10 }
kappa = { from = 0.8, to = 1.2, count = 10 }
tau_i = { from = 1.6, to = 2.4, count = 32 }
delta = 0
tau_f = 0.1
)";

}  // namespace

std::vector<Case> cases() {
  std::vector<Case> all = {case_of("dipdt-pid", "dipdt", around_qrdp(0.1, 10, 32)),
                           case_of("dipdt-pid-fast", "dipdt", around_qrdp(0.01, 10, 32)),
                           case_of("ipdt-pi", "ipdt", kIpdtPi), case_of("ipdt-pid", "ipdt", kIpdtPid),
                           case_of("fotd-pi", "fotd", kFotdPi)};
  all[1].batched_tolerance = 5e-3;
  return all;
}

std::vector<Case> few_of_each(const std::vector<Case>& all) {
  std::vector<Case> few = all;
  for (Case& c : few) {
    std::vector<Setting> kept;
    for (std::size_t i = 0; i < c.settings.size(); i += 97) kept.push_back(c.settings[i]);
    c.settings = std::move(kept);
  }
  return few;
}

Grid sweep_grid(std::uint64_t count) {
  constexpr std::uint64_t kTimes = 32;  // as in the boxes above
  const auto gains = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(count / kTimes))));
  return parse_grid(fmt::format(kHead, "dipdt") + around_qrdp(0.1, gains, kTimes), "sweep");
}

std::vector<Measure> timed_measures() {
  std::vector<Measure> timed;
  for (const Measure m : standard_measures())
    if (m != Measure::noise_gain) timed.push_back(m);
  return timed;
}

}  // namespace portrait::bench
