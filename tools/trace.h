/// Responses as a CSV file: t, y_w, u_w, y_d, u_d and, where it was simulated, y_o, u_o; in the units of the response.
///
/// Every panel of the simulation gives its points with both ends, so a jump is two rows with the same t.
/// Written to a temporary name and renamed: a reader never sees half a file.                  throws StoreError
#pragma once

#include <string>

#include "engine/reference/response.h"

namespace portrait::tools {

inline constexpr double kTracePointsPerDeadTime = 50;

void write_trace(const reference::Response& response, const std::string& path);

}  // namespace portrait::tools
