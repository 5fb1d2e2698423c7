#include "portraits/query/admission.h"

namespace portrait {

bool Admission::glance(std::uint64_t tile, Counted& counted, Glance& glance) const {
  glance.possible = false;
  glance.open.clear();
  if (sheet_.in_slice(tile) == Outlook::never) return false;
  glance.is_counted = count_unread(sheet_, tile, counted);
  if (glance.is_counted && sheet_.most_eligible(tile) == 0) return false;
  glance.possible = true;
  thread_local std::vector<Interval> stack;
  for (const Constraint& constraint : where_) {
    const Outlook outlook = sheet_.outlook(constraint, tile, stack);
    if (outlook == Outlook::never) glance.possible = false;
    if (outlook == Outlook::never) break;
    if (outlook == Outlook::maybe) glance.open.push_back(&constraint);
  }
  return glance.possible || !glance.is_counted;
}

void Admission::choose(std::uint64_t tile, const Glance& glance, TilePage& page, Counted& counted,
                       std::vector<std::size_t>& chosen) const {
  thread_local Filter filter;
  page.open(tile);
  portrait::choose(sheet_, page, chosen, glance.is_counted ? nullptr : &counted);
  if (!glance.possible) chosen.clear();
  for (const Constraint* constraint : glance.open) filter.keep(*constraint, page, chosen);
}

}  // namespace portrait
