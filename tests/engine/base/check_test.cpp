#include "engine/base/check.h"

#include <gtest/gtest.h>

#include "tests/engine/base/message_of.h"

namespace portrait {
namespace {

/// What a broken promise says, without the path before this file's name.
template <typename Action>
std::string promise_broken_by(Action action) {
  const std::string text = message_of<BrokenPromise>(action);
  return text.substr(text.find("check_test.cpp"));
}

TEST(Check, PassesWhatHolds) {
  EXPECT_NO_THROW(PORTRAIT_CHECK(1 + 1 == 2));
  EXPECT_NO_THROW(PORTRAIT_CHECK_EQ(1 + 1, 2));
}

TEST(Check, NamesThePlaceAndTheCondition) {
  const int line = __LINE__ + 1;
  const std::string message = promise_broken_by([] { PORTRAIT_CHECK(1 + 1 == 3); });
  EXPECT_EQ(message, fmt::format("check_test.cpp:{}: check failed: 1 + 1 == 3", line));
}

TEST(Check, PrintsBothValues) {
  const int settings = 7;
  const int line = __LINE__ + 1;
  const std::string message = promise_broken_by([&] { PORTRAIT_CHECK_EQ(settings, 8); });
  EXPECT_EQ(message, fmt::format("check_test.cpp:{}: check failed: settings == 8 (7 against 8)", line));
}

TEST(Check, EvaluatesItsArgumentsOnce) {
  int calls = 0;
  PORTRAIT_CHECK(++calls == 1);
  PORTRAIT_CHECK_EQ(++calls, 2);
  EXPECT_EQ(calls, 2);
}

TEST(Assert, HoldsWithoutNdebugOnly) {
#ifdef NDEBUG
  EXPECT_NO_THROW(PORTRAIT_ASSERT(false));
#else
  EXPECT_THROW(PORTRAIT_ASSERT(false), BrokenPromise);
#endif
}

}  // namespace
}  // namespace portrait
