/// Every file in bad/ holds one mistake and, in its first line, the whole message that it must end in.
#include <gtest/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

class BadFile : public testing::TestWithParam<std::filesystem::path> {};

/// The message behind "# expect: " in the first line.
std::string expected_message(const std::string& text) {
  const std::string mark = "# expect: ";
  if (!text.starts_with(mark)) return "the first line must start with " + mark;
  return text.substr(mark.size(), text.find('\n') - mark.size());
}

TEST_P(BadFile, EndsInTheMessageOfItsFirstLine) {
  const std::string text = file_text(GetParam());
  std::string message = "accepted";
  try {
    parse_grid(text, "bad/" + GetParam().filename().string());
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, expected_message(text));
}

std::string test_name(const testing::TestParamInfo<std::filesystem::path>& file) {
  return file.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Grids, BadFile, testing::ValuesIn(toml_files("tests/grids/bad")), test_name);

}  // namespace
}  // namespace portrait
