#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

Grid catalog_grid(const std::string& name) {
  return read_grid(std::filesystem::path(PORTRAIT_SOURCE_DIR) / "grids/catalog" / (name + ".toml"));
}

std::vector<double> values(const Grid& grid, Parameter parameter) {
  for (const Axis& axis : grid.axes)
    if (axis.parameter() == parameter) return axis.values();
  return {};
}

bool contains(const std::vector<double>& all, double value) {
  return std::find(all.begin(), all.end(), value) != all.end();
}

/// Any parameter within this part of itself of the value: for numbers that a rule gives, rounded to 15 digits.
bool nearly_contains(const std::vector<double>& all, double value) {
  return std::any_of(all.begin(), all.end(), [&](double x) { return std::abs(x - value) <= 1e-14 * value; });
}

TEST(Catalog, EveryFileIsAGridWithTheSizeThatItsCommentSays) {
  const std::map<std::string, std::uint64_t> sizes = {
      {"dipdt-pid-noise", 2205}, {"fotd-pi", 11050}, {"fotd-pid", 12150}, {"huba2022-43", 4185}, {"ipdt-pi", 8320}, {"ipdt-pid", 7216}, {"jotd-pid", 6600}};
  const auto files = toml_files("grids/catalog");
  EXPECT_EQ(files.size(), sizes.size());
  for (const auto& file : files) {
    const Grid grid = read_grid(file);
    EXPECT_EQ(setting_count(grid), sizes.at(file.stem().string())) << file;
    EXPECT_NE(grid.text.find(" = " + std::to_string(setting_count(grid)) + " settings."), std::string::npos)
        << file;
    EXPECT_FALSE(grid.title.empty()) << file;
  }
}

TEST(Catalog, Huba2022HoldsThePublishedOptimaExactly) {
  const Grid grid = catalog_grid("huba2022-43");
  EXPECT_EQ(setting_count(grid), 4185u);
  EXPECT_EQ(grid.family.plant, Plant::dipdt);
  EXPECT_EQ(grid.family.n, 0);
  EXPECT_EQ(grid.family.prefilter, Prefilter::pi);
  EXPECT_EQ(grid.horizon.dead_times, 80);
  int found = 0;
  for (std::uint64_t number = 0; number < setting_count(grid); ++number) {
    const Setting s = setting_at(grid, number);
    const bool is_47 = s.kappa == 0.24 && s.delta == 0.70 && s.tau_i == 8;
    const bool is_48 = s.kappa == 0.08 && s.delta == 0.35 && s.tau_i == 14;
    if (is_47 || is_48) ++found;
    EXPECT_EQ(s.b, 0);
  }
  EXPECT_EQ(found, 2);
}

TEST(Catalog, IpdtPiHoldsSimcAndPassesTheStabilityLimit) {
  const Grid grid = catalog_grid("ipdt-pi");
  const auto kappa = values(grid, Parameter::kappa);
  const auto tau_i = values(grid, Parameter::tau_i);
  EXPECT_TRUE(contains(kappa, 0.5) && contains(tau_i, 8));
  EXPECT_TRUE(kappa.back() > std::acos(-1.0) / 2 && tau_i.back() == kInf);
}

TEST(Catalog, IpdtPidHoldsPiAndPdToo) {
  const Grid grid = catalog_grid("ipdt-pid");
  EXPECT_EQ(grid.family.n, 1);
  EXPECT_TRUE(contains(values(grid, Parameter::delta), 0));
  EXPECT_TRUE(contains(values(grid, Parameter::tau_i), kInf));
}

TEST(Catalog, FotdPiHoldsPoleCancellation) {
  const Grid grid = catalog_grid("fotd-pi");
  for (const double tau_1 : values(grid, Parameter::tau_1)) {
    if (tau_1 > 10) continue;
    EXPECT_TRUE(nearly_contains(values(grid, Parameter::kappa), tau_1 / 2)) << tau_1;
    EXPECT_TRUE(contains(values(grid, Parameter::tau_i), tau_1)) << tau_1;
  }
}

TEST(Catalog, FotdPidSpansTheRuleOfItsComment) {
  const Grid grid = catalog_grid("fotd-pid");
  const auto kappa = values(grid, Parameter::kappa), tau_i = values(grid, Parameter::tau_i),
             tau_d = values(grid, Parameter::tau_d);
  for (const double tau_1 : values(grid, Parameter::tau_1)) {
    EXPECT_TRUE(kappa.front() <= (tau_1 + 0.5) / 2 && (tau_1 + 0.5) / 2 <= kappa.back());
    EXPECT_TRUE(tau_i.front() <= tau_1 + 0.5 && tau_1 + 0.5 <= tau_i.back());
    EXPECT_TRUE(0.5 * tau_1 / (tau_1 + 0.5) <= tau_d.back());
  }
}

}  // namespace
}  // namespace portrait
