/// Portraits that are written in a folder of their own, all at the same moment: equal ones have the same bytes.
#pragma once

#include <cstdlib>

#include "tests/portraits/scratch.h"

namespace portrait {

class DatedScratchTest : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  }
  void TearDown() override {
    unsetenv("SOURCE_DATE_EPOCH");
    ScratchTest::TearDown();
  }
};

}  // namespace portrait
