/// A published number beside ours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reproduce/published.h"

namespace portrait::reproduce {

/// What was computed for one printed cell.
struct Computed {
  double as_printed = 0;            ///< under the conditions the paper states
  std::optional<double> corrected;  ///< under the correction that the table's note states
};

enum class Verdict {
  agrees,     ///< to the printed digits, the last one up to one unit; or within what the table allows, and why
  corrected,  ///< after a stated correction
  differs,    ///< and why
};
std::string_view to_string(Verdict verdict);

struct Compared {
  std::string published;
  double ours = 0;
  double difference = 0;  ///< ours less published
  Verdict verdict = Verdict::differs;
  bool last_digit = false;  ///< agrees, but would round otherwise
  std::string why;
};

/// The verdict on one cell; a note of the table gives its reason.
Compared compared(const PublishedTable& table, std::size_t row, std::size_t column, const Computed& computed);

}  // namespace portrait::reproduce
