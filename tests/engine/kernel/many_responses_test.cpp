// The promise of engine/kernel/responses.h over ten thousand random settings of every family.
#include <gtest/gtest.h>

#include "tests/engine/kernel/comparison.h"

namespace portrait {
namespace {

#ifdef PORTRAIT_SANITIZED
constexpr int kLoops = 1'000;
#else
constexpr int kLoops = 10'000;
#endif

TEST(ManyResponses, EqualTheReference) {
  const Errors errors = errors_over(*available_implementations().back(), kLoops, 42);
  EXPECT_LT(errors.integral.error, 1e-8) << errors.integral.where;
  EXPECT_LT(errors.variation.error, 1e-7) << errors.variation.where;
  EXPECT_EQ(errors.unresolved, 0);
  EXPECT_EQ(errors.status_differs, 0);
}

}  // namespace
}  // namespace portrait
