// PORTRAIT_ISA chooses the instruction set; a name it does not know is an error.
#include "engine/isa/dispatch.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace portrait {
namespace {

class Dispatch : public ::testing::Test {
 protected:
  void TearDown() override { unsetenv("PORTRAIT_ISA"); }
};

TEST_F(Dispatch, BaseIsAlwaysThere) { EXPECT_STREQ(available_implementations().front()->name, "base"); }

TEST_F(Dispatch, TheBestIsTheDefault) { EXPECT_EQ(&chosen_implementation(), available_implementations().back()); }

TEST_F(Dispatch, ANameForcesOne) {
  for (const auto* implementation : available_implementations()) {
    setenv("PORTRAIT_ISA", implementation->name, 1);
    EXPECT_EQ(&chosen_implementation(), implementation);
  }
}

TEST_F(Dispatch, AnUnknownNameIsAnError) {
  setenv("PORTRAIT_ISA", "avx12", 1);
  try {
    chosen_implementation();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "PORTRAIT_ISA: unknown instruction set \"avx12\" (did you mean \"avx2\"?)");
  }
}

}  // namespace
}  // namespace portrait
