/// What steps of another size and a real plant do to a measure, and what the units are called.
#include "portraits/query/query_units.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

TEST(QueryUnits, measures_grow_with_their_step_as_their_unit_says) {
  const QueryUnits units{std::nullopt, {2, 3}};
  const std::vector<std::pair<Measure, double>> table = {
      {Measure::IAE_w, 2},    {Measure::IAE_d, 3},      {Measure::ITAE_w, 2},  {Measure::ISE_w, 4},
      {Measure::ISE_d, 9},    {Measure::ITSE_w, 4},     {Measure::ITSE_d, 9},  {Measure::TV_yw, 2},
      {Measure::TV2_ud, 3},   {Measure::u_max_w, 2},    {Measure::y_max_d, 3}, {Measure::Ms, 1},
      {Measure::Ms_omega, 1}, {Measure::noise_gain, 1}, {Measure::PM, 1},      {Measure::DM, 1},
      {Measure::IAE_o, 1},    {Measure::ISE_o, 1},      {Measure::DC_yw, 1}};
  for (const auto& [measure, grows] : table) {
    EXPECT_EQ(factor(measure, units), grows) << to_string(measure);
    EXPECT_EQ(factor(measure, {}), 1) << to_string(measure);
    const RealPlant plant{Plant::ipdt, -2, 0.5, 0};
    EXPECT_EQ(factor(measure, {plant, {2, 3}}), scale(measure, plant) * grows) << to_string(measure);
  }
}

TEST(QueryUnits, a_step_has_a_size) {
  for (const double size : {0.0, -1.0, kInf, kNaN}) {
    EXPECT_NE(error_text([&] {
                require_fits({std::nullopt, {size, 1}}, line(3));
              }).find("step: w must be"),
              std::string::npos);
    EXPECT_NE(error_text([&] {
                require_fits({std::nullopt, {1, size}}, line(3));
              }).find("step: d must be"),
              std::string::npos);
  }
  EXPECT_EQ(error_text([&] { require_fits({std::nullopt, {1e-9, 1e9}}, line(3)); }), "no InputError");
}

TEST(QueryUnits, are_called_by_what_they_are) {
  const QueryUnits plain{std::nullopt, {2, 3}}, real{RealPlant{Plant::dipdt, 1, 1, 0}, {2, 3}};
  const auto text = [](Quantity quantity, const QueryUnits& units) { return unit_text(quantity, units, line(3)); };
  EXPECT_EQ(text(Measure::IAE_w, plain), "normalised, for a step of 2 in the setpoint");
  EXPECT_EQ(text(Measure::ISE_d, real),
            "real, unit of y squared times time, for a step of 3 in the input disturbance");
  EXPECT_EQ(text(Measure::TV_uo, real), "real, unit of u, for a step of 1 in the output disturbance");
  EXPECT_EQ(text(Measure::Ms, real), "a pure number");
  EXPECT_EQ(text(Measure::PM, plain), "degrees");
  EXPECT_EQ(text(Measure::DM, real), "real, time");
  EXPECT_EQ(text(Measure::DM, plain), "normalised");
  EXPECT_EQ(text(Measure::noise_gain, real), "real, unit of u per unit of y");
  EXPECT_EQ(text(ControllerValue::Ki, real), "real, unit of u per unit of y and time");
}

/// Of the first setting too, and of every tile.
TEST(QueryUnits, values_of_the_controller_are_those_of_each_setting) {
  const RealPlant plant{Plant::dipdt, -2, 3, 0};
  const auto found = [&](const std::string& minimize, std::size_t top) {
    Question asked = question(minimize, {}, top);
    asked.conditions.units.plant = plant;
    return ask(MemorySource(line(3)), asked).top;
  };
  const std::vector<Found> rising = found("-Kc", 3);  // K is negative, and so is Kc
  ASSERT_EQ(rising.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rising[i].number, i);
    EXPECT_NEAR(rising[i].objective, 0.1 * static_cast<double>(i + 1) / 18, 1e-15);  // kappa/(K Td^2)
  }
  for (const auto& [name, expected] : std::vector<std::pair<std::string, double>>{
           {"Ti", 24}, {"Ki", -0.3 / 18 / 24}, {"Kd", -0.5 / 6}, {"TD", 0.5 / 0.3 * 3}})
    EXPECT_NEAR(found(name, 1).at(0).objective, expected, 1e-13) << name;
}

}  // namespace
}  // namespace portrait
