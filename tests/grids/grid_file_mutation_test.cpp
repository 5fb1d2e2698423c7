/// Any bytes give a grid whose every setting can be simulated, or an InputError: never a crash, never another
/// error.
#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

const std::vector<std::string> kPieces = {"inf",
                                          "nan",
                                          "-",
                                          "0",
                                          "1e308",
                                          "1e-320",
                                          "-0.0",
                                          "9007199254740993",
                                          "9223372036854775807",
                                          "[",
                                          "]",
                                          "{",
                                          "}",
                                          "\"",
                                          "'",
                                          "\"\"\"",
                                          ".",
                                          ",",
                                          "=",
                                          "\n",
                                          "\r\n",
                                          "#",
                                          "[[",
                                          "]]",
                                          "\\u",

                                          "\xff",
                                          "\xc3",
                                          "true",
                                          "1979-05-27",
                                          "step = 1e-9",
                                          "fotd",
                                          "tau_d",
                                          "n = 0",
                                          "tau_1 = 3",
                                          "scale = \"log\"",
                                          "count = 2",
                                          "measures = []",
                                          "[parameters]",
                                          "kappa",
                                          "\"none\"",
                                          "\"pi\""};

/// One change: a piece or a byte put in, a stretch cut out, copied or moved.
void mutate(std::string& text) {
  const std::size_t at = *rc::gen::inRange<std::size_t>(0, text.size() + 1);
  const std::size_t length = std::min(*rc::gen::inRange<std::size_t>(0, 30), text.size() - at);
  const std::size_t to = *rc::gen::inRange<std::size_t>(0, text.size() - length + 1);
  const std::string stretch = text.substr(at, length);
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      text.insert(at, *rc::gen::elementOf(kPieces));
      return;
    case 1:
      text.insert(at, 1, *rc::gen::arbitrary<char>());
      return;
    case 2:
      text.erase(at, length);
      return;
    case 3:
      text.insert(to, stretch);
      return;
    case 4:
      text.erase(at, length).insert(to, stretch);
      return;
    case 5:
      text.replace(at, length, *rc::gen::elementOf(kPieces));
      return;
  }
}

void check_some_settings(const Grid& grid) {
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t number = *rc::gen::inRange<std::uint64_t>(0, setting_count(grid));
    RC_ASSERT(!why_invalid({grid.family, setting_at(grid, number)}));
  }
}

/// Whether the text was accepted.
bool gives_grid_or_input_error(const std::string& text) {
  try {
    const Grid grid = parsed(text);
    RC_ASSERT(grid.text == text);
    check_some_settings(grid);
    return true;
  } catch (const InputError& error) {
    RC_ASSERT(std::string(error.what()).starts_with("grid.toml:"));
    return false;
  }
}

RC_GTEST_PROP(GridFileMutation, GivesAGridOrAnInputError, ()) {
  int accepted = 0;
  for (int round = 0; round < 20; ++round) {
    std::string text = kExample;
    for (int changes = *rc::gen::inRange(1, 6); changes > 0; --changes) mutate(text);
    if (gives_grid_or_input_error(text)) ++accepted;
  }
  RC_CLASSIFY(accepted > 0);
}

RC_GTEST_PROP(GridFileMutation, NoiseIsNoGrid, (const std::string& noise)) {
  RC_ASSERT_THROWS_AS(parsed(noise), InputError);
}

}  // namespace
}  // namespace portrait
