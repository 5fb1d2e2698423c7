#include "reproduce/verdict.h"

#include <cmath>

namespace portrait::reproduce {
namespace {

/// 0: rounds to what is printed; 1: within a unit of its last digit, or within what the table allows; 2: neither.
int distance(const PublishedTable& table, const Printed& p, double ours) {
  const double difference = std::abs(ours - p.value);
  if (difference <= p.half_unit * (1 + 1e-9)) return 0;
  if (difference <= 2 * p.half_unit * (1 + 1e-9) || difference <= table.within * std::abs(p.value)) return 1;
  return 2;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::corrected:
      return "agrees after a correction";
    case Verdict::differs:
      break;
  }
  return "does not agree";
}

Compared compared(const PublishedTable& table, std::size_t row, std::size_t column, const Computed& computed) {
  const std::string& text = *table.rows[row].cells[column];
  const Printed p = printed(text);
  const int as_printed = distance(table, p, computed.as_printed);
  if (as_printed < 2)
    return {text,
            computed.as_printed,
            computed.as_printed - p.value,
            Verdict::agrees,
            as_printed == 1,
            as_printed == 1 ? table.within_why : ""};
  if (computed.corrected && distance(table, p, *computed.corrected) < 2) {
    const Note* note = table.note_for(row, column, &Note::correction);
    return {text,
            *computed.corrected,
            *computed.corrected - p.value,
            Verdict::corrected,
            distance(table, p, *computed.corrected) == 1,
            note ? note->correction : ""};
  }
  const Note* note = table.note_for(row, column, &Note::why);
  return {text, computed.as_printed, computed.as_printed - p.value, Verdict::differs, false, note ? note->why : ""};
}

}  // namespace portrait::reproduce
