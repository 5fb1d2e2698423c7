#include "engine/base/error.h"

#include <gtest/gtest.h>

namespace portrait {
namespace {

TEST(Place, PrintsWhatIsKnown) {
  EXPECT_EQ(to_string(Place{"grid.toml", 12, 9}), "grid.toml:12:9");
  EXPECT_EQ(to_string(Place{"grid.toml", 12, 0}), "grid.toml:12");
  EXPECT_EQ(to_string(Place{"--where", 0, 0}), "--where");
}

TEST(Place, AColumnWithoutALineSaysNothing) { EXPECT_EQ(to_string(Place{"grid.toml", 0, 9}), "grid.toml"); }

TEST(InputError, PutsThePlaceBeforeTheMessage) {
  EXPECT_STREQ(InputError({"grid.toml", 12, 9}, "unknown key \"kapa\"").what(),
               "grid.toml:12:9: unknown key \"kapa\"");
  EXPECT_STREQ(InputError("no grid").what(), "no grid");
}

TEST(Errors, AreToldApartByWhoCanMendThem) {
  EXPECT_THROW(throw StoreError("disk"), std::runtime_error);
  EXPECT_THROW(throw IntegrityError("torn"), std::runtime_error);
  static_assert(!std::is_base_of_v<InputError, StoreError> && !std::is_base_of_v<StoreError, IntegrityError>);
}

}  // namespace
}  // namespace portrait
