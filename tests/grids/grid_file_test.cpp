#include "grids/grid_file.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

const std::string kHead = "plant = \"dipdt\"\nhorizon = 50\n";
const std::string kLoop = "[parameters]\nkappa = 0.2\ntau_i = 8\n";

std::vector<std::string> fixed_text(const Grid& grid) {
  std::vector<std::string> parts;
  for (const auto& [parameter, value] : grid.fixed)
    parts.push_back(fmt::format("{}={}", to_string(parameter), value));
  return parts;
}

using Strings = std::vector<std::string>;

TEST(GridFile, TheExampleIsReadAsPrinted) {
  const Grid grid = parsed(kExample);
  EXPECT_EQ(grid.title, "DIPDT, PID, first-order filter");
  EXPECT_EQ(grid.family.plant, Plant::dipdt);
  EXPECT_EQ(grid.family.n, 1);
  EXPECT_EQ(grid.family.prefilter, Prefilter::full);
  EXPECT_EQ(grid.horizon.dead_times, 51);
  EXPECT_FALSE(grid.horizon.automatic);
  EXPECT_EQ(grid.precision, Precision::real64);
  EXPECT_EQ(grid.measures.size(), kStandardMeasureCount - 1) << "without noise_gain";
  EXPECT_EQ(setting_count(grid), 31u * 15 * 6 * 9);
  EXPECT_EQ(fixed_text(grid), (Strings{"b=0", "c=0"}));
}

TEST(GridFile, TheExampleIsTheOneOfTheReadme) {
  const std::string readme = file_text(std::filesystem::path(PORTRAIT_SOURCE_DIR) / "grids/README.md");
  EXPECT_NE(readme.find("```toml\n" + kExample + "```"), std::string::npos);
}

TEST(GridFile, AxesStandInTheOrderOfTheFile) {
  const Grid grid = parsed(kExample);
  Strings names;
  for (const Axis& axis : grid.axes) names.emplace_back(axis.name());
  EXPECT_EQ(names, (Strings{"kappa", "delta", "tau_i", "tau_f"}));
  EXPECT_EQ(grid.axes[0][19], 0.24);
  EXPECT_EQ(grid.axes[1][7], 0.7);
  EXPECT_EQ(grid.axes[2].values(), (std::vector<double>{6, 8, 10, 14, 20, kInf}));
  EXPECT_EQ(grid.axes[3][4], 0.1);
}

TEST(GridFile, TheTextIsKeptByteForByte) {
  const std::string text = kHead + "# \xc3\xa9t\xc3\xa9\r\n" + kLoop + "\n  # the end, without a line end";
  EXPECT_EQ(parsed(text).text, text);
}

TEST(GridFile, WhatIsLeftOutHasADefault) {
  const Grid grid = parsed(kHead + kLoop);
  EXPECT_EQ(grid.title, "");
  EXPECT_EQ(grid.family.n, 0);
  EXPECT_EQ(grid.family.prefilter, Prefilter::pi);
  EXPECT_EQ(grid.precision, Precision::real64);
  EXPECT_EQ(grid.measures.size(), kStandardMeasureCount - 1) << "without noise_gain";
  EXPECT_TRUE(grid.axes.empty());
  EXPECT_EQ(fixed_text(grid), (Strings{"kappa=0.2", "tau_i=8", "delta=0", "b=0"}));
  EXPECT_EQ(parsed(kHead + "n = 1\n" + kLoop + "tau_f = 0.1").family.prefilter, Prefilter::full);
}

TEST(GridFile, SamplingBringsTheNoiseGain) {
  EXPECT_FALSE(parsed(kHead + kLoop).sampling);
  const Grid grid = parsed(kHead + "sampling = 0.25\n" + kLoop);
  EXPECT_EQ(grid.sampling, 0.25);
  EXPECT_EQ(grid.measures.size(), kStandardMeasureCount);
  const Grid some = parsed(kHead + "sampling = 1\nmeasures = [\"noise_gain\", \"Ms\"]\n" + kLoop);
  EXPECT_EQ(some.measures, (std::vector<Measure>{Measure::Ms, Measure::noise_gain}));
  EXPECT_EQ(parsed(kHead + "sampling = 1\nmeasures = [\"Ms\"]\n" + kLoop).measures,
            std::vector<Measure>{Measure::Ms});
}

TEST(GridFile, FixedHoldsWhatTheFamilyHas) {
  const Grid fotd =
      parsed("plant = \"fotd\"\nn = 2\nhorizon = \"auto\"\n" + kLoop + "tau_1 = 3\ntau_f = 0.1\ntau_d = 2\n");
  EXPECT_TRUE(fotd.horizon.automatic);
  EXPECT_EQ(fixed_text(fotd), (Strings{"kappa=0.2", "tau_i=8", "tau_d=2", "tau_1=3", "tau_f=0.1", "b=0", "c=0"}));
  EXPECT_EQ(setting_at(fotd, 0).delta, 0.4);
}

TEST(GridFile, PrefilterCoefficientsMayStandIdleAtZero) {
  EXPECT_EQ(fixed_text(parsed(kHead + "prefilter = \"none\"\n" + kLoop + "b = 0\nc = 0.0\n")),
            (Strings{"kappa=0.2", "tau_i=8", "delta=0"}));
}

TEST(GridFile, InfIsNoIntegralActionInAListAndAlone) {
  const Grid grid = parsed(kHead + "[parameters]\nkappa = 0.2\ntau_i = inf\ndelta = 0.7\n");
  EXPECT_FALSE(has_integral_action(setting_at(grid, 0)));
}

TEST(GridFile, MeasuresStandInCatalogueOrder) {
  const Grid grid = parsed("measures = [\"Ms\", \"TV2_uw\", \"IAE_w\"]\nprecision = \"single\"\n" + kHead + kLoop);
  EXPECT_EQ(grid.measures, (std::vector<Measure>{Measure::IAE_w, Measure::TV2_uw, Measure::Ms}));
  EXPECT_EQ(grid.precision, Precision::real32);
}

TEST(GridFile, NumbersMayBeIntegersOrFloats) {
  const Grid grid = parsed(
      "plant = \"dipdt\"\nhorizon = 5e1\nn = 1.0\n[parameters]\nkappa = {from = 1, to = 2.0, count = 3.0}\n"
      "tau_i = [6.0, 8, 0x10]\ntau_f = 1\n");
  EXPECT_EQ(grid.family.n, 1);
  EXPECT_EQ(grid.axes[0].values(), (std::vector<double>{1, 1.5, 2}));
  EXPECT_EQ(grid.axes[1].values(), (std::vector<double>{6, 8, 16}));
}

TEST(GridFile, AZeroHasNoSign) {
  EXPECT_FALSE(std::signbit(setting_at(parsed(kHead + kLoop + "b = -0.0\n"), 0).b));
}

TEST(GridFile, TablesMayBeWrittenInEveryWayOfToml) {
  const std::string sections =
      kHead + "[parameters]\ntau_i = 8\n[parameters.kappa]\nfrom = 1\nto = 2\ncount = 3\nscale = \"linear\"\n";
  const std::string dotted = kHead +
                             "parameters.tau_i = 8\nparameters.kappa.from = 1\nparameters.kappa.to = 2\n"
                             "parameters.kappa.step = 0.5\n";
  for (const std::string& text : {sections, dotted})
    EXPECT_EQ(parsed(text).axes.at(0).values(), (std::vector<double>{1, 1.5, 2})) << text;
}

TEST(GridFile, AStepMayMissByAMillionth) {
  const Grid grid =
      parsed(kHead + "[parameters]\nkappa = { from = 0.1, to = 0.9, step = 0.26666667 }\ntau_i = 8\n");
  EXPECT_EQ(grid.axes[0].values(), (std::vector<double>{0.1, 0.366666666666667, 0.633333333333333, 0.9}));
  EXPECT_EQ(complaint(kHead + "[parameters]\nkappa = { from = 0.1, to = 0.9, step = 0.266667 }\ntau_i = 8\n"),
            "grid.toml:4:40: step 0.266667 does not lead from 0.1 to 0.9: use 0.4 (count = 3) or 0.266666666666667 "
            "(count = 4)");
}

TEST(GridFile, StepsNamedInAnErrorAreAccepted) {
  const auto with_step = [](const std::string& step) {
    return kHead + "[parameters]\nkappa = { from = 0.05, to = 0.35, step = " + step + " }\ntau_i = 8\n";
  };
  EXPECT_NE(complaint(with_step("0.08")), "");
  EXPECT_EQ(complaint(with_step("0.1")), "");
  EXPECT_EQ(complaint(with_step("0.075")), "");
}

TEST(GridFile, AQuadrillionSettingsAreReadAtOnce) {
  const Grid grid =
      parsed(kHead +
             "[parameters]\nkappa = { from = 1, to = 2, count = 100_000 }\n"
             "tau_i = { from = 1, to = 2, count = 100_000 }\ndelta = { from = 0, to = 2, count = 100_000 }\n");
  EXPECT_EQ(setting_count(grid), 1'000'000'000'000'000u);
}

TEST(GridFile, TheLargestNumberOfSettingsIsBelowTwoToThe63) {
  const auto with_counts = [](const std::string& a, const std::string& b) {
    return kHead + "[parameters]\nkappa = { from = 1, to = 2, count = " + a +
           " }\ntau_i = { from = 1, to = 2, count = " + b + " }\n";
  };
  EXPECT_EQ(setting_count(parsed(with_counts("2147483648", "4294967295"))), (1ull << 63) - (1ull << 31));
  EXPECT_EQ(complaint(with_counts("2147483648", "4294967296")),
            "grid.toml:3:1: the grid has 9.22e+18 settings: it must have fewer than 2^63");
}

TEST(GridFile, ANumberOfSettingsThatWrapsAroundIsRefusedToo) {
  EXPECT_EQ(complaint(kHead + "[parameters]\nkappa = { from = 1, to = 2, count = 4294967296 }\n"
                              "tau_i = { from = 1, to = 2, count = 4294967296 }\n"),
            "grid.toml:3:1: the grid has 1.84e+19 settings: it must have fewer than 2^63");
}

TEST(GridFile, AnAxisMayBeAsFineAs15DigitsTellApart) {
  const auto with_count = [](double count) {
    return kHead + fmt::format("[parameters]\nkappa = {{ from = 1, to = 2, count = {:.0f} }}\ntau_i = 8\n", count);
  };
  const double most = Axis::most_linear(1, 2);
  EXPECT_EQ(most, 50'000'000'000'001);
  EXPECT_EQ(complaint(with_count(most)), "");
  EXPECT_EQ(complaint(with_count(most + 1)),
            "grid.toml:4:9: axis \"kappa\" would have 50000000000002 values, of which 50000000000001 differ in 15 "
            "digits");
}

TEST(GridFile, EmptyTextMissesItsFirstKey) {
  EXPECT_EQ(complaint(""), "grid.toml:1:1: missing key \"plant\": one of dipdt, ipdt, fotd, jotd");
}

TEST(GridFile, BytesThatAreNoTextAreRefused) {
  EXPECT_EQ(complaint("title = \"\xff\"\n"), "grid.toml:1:9: Encountered invalid utf-8 sequence");
}

TEST(GridFile, AFileThatCannotBeReadIsNamed) {
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      read_grid(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(message("no/such/grid.toml"), "no/such/grid.toml: cannot be read: No such file or directory");
  EXPECT_EQ(message("/"), "/: cannot be read: Is a directory");
}

}  // namespace
}  // namespace portrait
