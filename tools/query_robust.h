/// `portrait query --uncertain`: the best controller for every plant of a box, as text or JSON.
#pragma once

#include <string>

#include "tools/query_kinds.h"

namespace portrait::tools {

struct RobustArguments {
  std::string minimize, uncertain, over, why;
  std::size_t top = 1;
};

/// Gives the exit code. With a setting (--why) that setting over the box instead of the best.
int print_robust(const QueryRequest& request, const RobustArguments& arguments);

}  // namespace portrait::tools
