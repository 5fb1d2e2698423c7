#include "portraits/query/candidates.h"

namespace portrait {

void LeftOut::add(Status status, std::uint64_t settings) {
  if (status == Status::unstable) unstable += settings;
  if (status == Status::not_settled) not_settled += settings;
  if (status == Status::not_computed) not_computed += settings;
}

LeftOut& LeftOut::operator+=(const LeftOut& other) {
  unstable += other.unstable;
  not_settled += other.not_settled;
  not_computed += other.not_computed;
  objective_missing += other.objective_missing;
  return *this;
}

bool count_unread(const Sheet& sheet, std::uint64_t tile, Counted& counted) {
  const StatusCounts* counts = sheet.status_counts(tile);
  if (counts == nullptr || sheet.in_slice(tile) != Outlook::always) return false;
  for (std::size_t code = 0; code < counts->size(); ++code) {
    const auto status = static_cast<Status>(code);
    counted.total += (*counts)[code];
    if (!sheet.has_right_status(status)) counted.left_out.add(status, (*counts)[code]);
  }
  return true;
}

void choose(const Sheet& sheet, TilePage& page, std::vector<std::size_t>& chosen, Counted* counted) {
  chosen.clear();
  const std::vector<Status>& statuses = page.statuses();
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    if (!page.is_in_slice(i)) continue;
    const bool right = sheet.has_right_status(statuses[i]);
    if (right) chosen.push_back(i);
    if (counted == nullptr) continue;
    ++counted->total;
    if (!right) counted->left_out.add(statuses[i], 1);
  }
}

void Filter::keep(const Constraint& constraint, TilePage& page, std::vector<std::size_t>& chosen) {
  if (chosen.empty()) return;
  page.evaluate(constraint.left, left_);
  page.evaluate(constraint.right, right_);
  std::erase_if(chosen, [&](std::size_t i) { return !holds(constraint.relation, left_[i], right_[i]); });
}

}  // namespace portrait
