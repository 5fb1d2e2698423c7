/// Rows of a portrait against plain loops over its settings.
#include "portraits/query/export.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/memory_source.h"

namespace portrait {
namespace {

constexpr std::uint64_t kSettings = 3 * 100 * 60, kTiles = 6;  // a value of tau_1 and half the values of kappa

/// IAE_w is the number of the setting; TV2_uw 1 or 2; every seventh setting unstable, every eleventh not settled.
MemorySource portrait_of_lags() {
  Grid grid;
  grid.family = {Plant::fotd, 1, Prefilter::pi};
  grid.measures = {Measure::IAE_w, Measure::TV2_uw, Measure::Ms};
  grid.axes = {Axis::list(Parameter::tau_1, {1, 2, 4}), Axis::linear(Parameter::kappa, 0.1, 10, 100),
               Axis::linear(Parameter::tau_d, 0.1, 6, 60)};
  grid.fixed = {{Parameter::tau_i, 3}, {Parameter::tau_f, 0.2}, {Parameter::b, 0}};
  MemorySource source(grid);
  for (std::uint64_t i = 0; i < kSettings; ++i) {
    source.status(i) = i % 7 == 0 ? Status::unstable : i % 11 == 0 ? Status::not_settled : Status::settled;
    source.at(Measure::IAE_w, i) = i % 7 == 0 ? kNaN : static_cast<double>(i);
    source.at(Measure::TV2_uw, i) = i % 3 == 0 ? 2 : 1;
  }
  return source;
}

Conditions where(const std::vector<std::string>& texts) {
  Conditions conditions;
  for (const std::string& text : texts) conditions.where.push_back(parse_constraint({"--where", text}));
  return conditions;
}

struct Table {
  std::vector<std::vector<double>> values;  ///< by column
  std::uint64_t rows = 0;
};
Table all_rows(const Export& exported) {
  Table table{std::vector<std::vector<double>>(exported.columns().size()), 0};
  std::uint64_t counted = 0;
  table.rows = exported.for_each([&](const TableRows& block) {
    counted += block.count;
    for (std::size_t c = 0; c < table.values.size(); ++c)
      table.values[c].insert(table.values[c].end(), block.values[c].begin(), block.values[c].end());
  });
  EXPECT_EQ(table.rows, counted);
  for (const std::vector<double>& column : table.values) EXPECT_EQ(column.size(), counted);
  return table;
}

std::vector<std::string> names(const Export& exported) {
  std::vector<std::string> all;
  for (const TableColumn& column : exported.columns()) all.push_back(column.name);
  return all;
}

/// The columns tau_1, kappa, tau_d, status, IAE_w of the settings that are wanted, in their order.
template <typename Wanted>
Table plain_rows(const MemorySource& source, Wanted wanted) {
  Table table{std::vector<std::vector<double>>(5), 0};
  const std::vector<Axis>& axes = source.grid().axes;
  for (std::uint64_t i = 0; i < kSettings; ++i) {
    const std::vector<std::uint64_t> at = coordinates(source.grid(), i);
    if (!wanted(i, at)) continue;
    ++table.rows;
    for (std::size_t k = 0; k < 3; ++k) table.values[k].push_back(axes[k][at[k]]);
    table.values[3].push_back(static_cast<double>(source.status(i)));
    table.values[4].push_back(source.at(Measure::IAE_w, i));
  }
  return table;
}

void expect_same(const Table& found, const Table& expected) {
  EXPECT_EQ(found.rows, expected.rows);
  ASSERT_EQ(found.values.size(), expected.values.size());
  for (std::size_t c = 0; c < expected.values.size(); ++c) {
    ASSERT_EQ(found.values[c].size(), expected.values[c].size()) << c;
    for (std::size_t i = 0; i < expected.values[c].size(); ++i) {
      const double value = found.values[c][i], wanted = expected.values[c][i];
      ASSERT_TRUE(value == wanted || (std::isnan(value) && std::isnan(wanted))) << c << ", " << i;
    }
  }
}

TEST(Export, gives_every_setting_in_the_order_of_the_grid) {
  const MemorySource source = portrait_of_lags();
  const Export exported(source, {{}, {}, {Measure::IAE_w}});
  EXPECT_EQ(names(exported), (std::vector<std::string>{"tau_1", "kappa", "tau_d", "status", "IAE_w"}));
  EXPECT_EQ(exported.shape(), (std::vector<std::uint64_t>{3, 100, 60}));
  EXPECT_EQ(exported.free_axes(), (std::vector{Parameter::tau_1, Parameter::kappa, Parameter::tau_d}));
  expect_same(all_rows(exported), plain_rows(source, [](auto, const auto&) { return true; }));
  EXPECT_EQ(source.longest_read(), kSettings / kTiles);
}

TEST(Export, of_a_slice_reads_its_tiles_only) {
  // First and last values of an axis, and those on both sides of a border between tiles.
  for (const std::uint64_t kappa : {0, 49, 50, 99})
    for (const std::uint64_t tau_d : {0, 59}) {
      const MemorySource source = portrait_of_lags();
      const std::vector<Axis>& axes = source.grid().axes;
      const Export exported(
          source, {{}, {{Parameter::tau_d, axes[2][tau_d]}, {Parameter::kappa, axes[1][kappa]}}, {Measure::IAE_w}});
      EXPECT_EQ(exported.shape(), std::vector<std::uint64_t>{3});
      EXPECT_EQ(exported.free_axes(), std::vector{Parameter::tau_1});
      expect_same(all_rows(exported),
                  plain_rows(source, [&](auto, const auto& at) { return at[1] == kappa && at[2] == tau_d; }));
      EXPECT_EQ(source.values_read(), 3 * kSettings / kTiles);
    }
}

TEST(Export, under_conditions_gives_what_a_query_admits) {
  const MemorySource source = portrait_of_lags();
  Conditions conditions = where({"TV2_uw <= 1", "kappa >= 4.05", "IAE_w < 17000"});
  for (const bool not_settled : {false, true}) {
    conditions.include_not_settled = not_settled;
    const auto admissible = [&](std::uint64_t i, const std::vector<std::uint64_t>& at) {
      const Status status = source.status(i);
      return (status == Status::settled || (not_settled && status == Status::not_settled)) && i % 3 != 0 &&
             at[1] >= 40 && i < 17000;
    };
    expect_same(all_rows(Export(source, {conditions, {}, {Measure::IAE_w}})), plain_rows(source, admissible));
    expect_same(
        all_rows(Export(source, {conditions, {{Parameter::tau_d, 0.1}, {Parameter::tau_1, 4}}, {Measure::IAE_w}})),
        plain_rows(source, [&](auto i, const auto& at) { return admissible(i, at) && at[2] == 0 && at[0] == 2; }));
  }
}

TEST(Export, reads_no_tile_that_its_range_rules_out) {
  const MemorySource source = portrait_of_lags();
  all_rows(Export(source, {where({"IAE_w < 3000"}), {}, {Measure::Ms}}));
  EXPECT_EQ(source.values_read(), kSettings / kTiles);  // Ms of the first, where IAE_w < 3000 throughout
  const MemorySource other = portrait_of_lags();
  EXPECT_EQ(all_rows(Export(other, {where({"IAE_w < 0"}), {}, {Measure::Ms}})).rows, 0u);
  EXPECT_EQ(other.values_read(), 0u);
}

/// tau_1 = T1/Td = 2, K = 4, Td = 0.5: a step of 3 in the setpoint.
TEST(Export, of_a_plant_is_its_slice_in_real_units_with_the_controller) {
  const MemorySource source = portrait_of_lags();
  ExportRequest request{{}, {}, {Measure::Ms, Measure::IAE_w}};
  request.conditions.units = {RealPlant{Plant::fotd, 4, 0.5, 1}, {3, 1}};
  const Export exported(source, request);
  EXPECT_EQ(names(exported), (std::vector<std::string>{"tau_1", "kappa", "tau_d", "Kc", "Ti", "TD", "Ki", "Kd",
                                                       "Tf", "status", "Ms", "IAE_w"}));
  EXPECT_EQ(exported.free_axes(), (std::vector{Parameter::kappa, Parameter::tau_d}));
  const Table table = all_rows(exported);
  ASSERT_EQ(table.rows, kSettings / 3);
  for (const std::uint64_t row : {0, 1, 59, 60, 3000, 5999}) {
    const std::uint64_t number = kSettings / 3 + row;
    const RealController controller =
        controller_for({source.grid().family, setting_at(source.grid(), number)}, *request.conditions.units.plant);
    const auto [Kc, Ti, TD] = controller.standard;
    const std::vector<double> expected = {Kc, Ti, TD, Kc / Ti, Kc * TD, controller.Tf};
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_DOUBLE_EQ(table.values[3 + k][row], expected[k]) << names(exported)[3 + k];
    EXPECT_EQ(table.values[0][row], 2);
    EXPECT_EQ(table.values[9][row], static_cast<double>(source.status(number)));
    EXPECT_EQ(table.values[10][row], 1);
    if (number % 7 != 0) {
      EXPECT_DOUBLE_EQ(table.values[11][row], static_cast<double>(number) * 0.5 * 3);
    }
  }
}

TEST(Export, gives_what_a_query_found) {
  const MemorySource source = portrait_of_lags();
  ExportRequest request{where({"TV2_uw <= 1"}), {}, {Measure::IAE_w}};
  request.conditions.units = {RealPlant{Plant::fotd, 4, 0.5, 1}, {3, 1}};
  const Answer answer = ask(source, {parse_expression({"", "-IAE_w"}), request.conditions, 3});
  const Export exported(source, request);
  const TableRows rows = exported.rows_of(answer.top);
  ASSERT_EQ(rows.count, 3u);
  const Table all = all_rows(exported);
  for (std::size_t c = 0; c < rows.values.size(); ++c) {
    ASSERT_EQ(rows.values[c].size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rows.values[c][i], all.values[c][all.rows - 1 - i]) << c;
  }
}

TEST(Export, says_what_its_columns_are) {
  ExportRequest request{{}, {}, {Measure::IAE_w}};
  request.conditions.units.plant = RealPlant{Plant::ipdt, 1, 1, 0};
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.2, 2)};
  grid.fixed = {{Parameter::tau_i, 8}, {Parameter::delta, 0}};
  const MemorySource source(grid);
  const std::vector<TableColumn> columns = Export(source, request).columns();
  ASSERT_EQ(columns.size(), 8u) << "without a filter there is no Tf";
  EXPECT_EQ(columns[0].unit, "normalised, " + normalisation(Parameter::kappa, Plant::ipdt));
  EXPECT_EQ(columns[0].meaning, info(Parameter::kappa).long_name);
  EXPECT_EQ(columns[1].name, "Kc");
  EXPECT_EQ(columns[1].unit, "real, unit of u per unit of y");
  EXPECT_EQ(columns[6].name, "status");
  for (const TableColumn& column : columns) EXPECT_EQ(column.is_status, column.name == "status");
  EXPECT_EQ(columns[7].unit, "real, unit of y times time, for a step of 1 in the setpoint");
  EXPECT_EQ(columns[7].meaning.find(info(Measure::IAE_w).long_name), 0u);
}

TEST(Export, refuses_what_does_not_fit) {
  const MemorySource source = portrait_of_lags();
  const auto problem = [&](const ExportRequest& request) {
    return error_text([&] { const Export exported(source, request); });
  };
  EXPECT_EQ(problem({{}, {{Parameter::kappa, 0.25}}, {}}),
            "the axis kappa has no value 0.25 (nearest: 0.2 and 0.3)");
  EXPECT_EQ(problem({{}, {{Parameter::tau_i, 3}}, {}}),
            "tau_i is no axis of the portrait (did you mean \"tau_1\"?)");
  EXPECT_NE(problem({where({"Mt < 2"}), {}, {}}).find("measure \"Mt\" is not stored"), std::string::npos);
}

}  // namespace
}  // namespace portrait
