#include "portraits/query/query_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/check.h"

namespace portrait {
namespace {

void collect(const Expression& expression, std::vector<Quantity>& used) {
  for (const Expression::Use& use : expression.uses())
    if (std::find(used.begin(), used.end(), use.quantity) == used.end()) used.push_back(use.quantity);
}

std::vector<Quantity> quantities_in(const Question& question) {
  std::vector<Quantity> used;
  collect(question.minimize, used);
  for (const Constraint& constraint : question.where) {
    collect(constraint.left, used);
    collect(constraint.right, used);
  }
  return used;
}

}  // namespace

Tally::Tally(std::size_t top, std::size_t constraints)
    : best(top), best_without(constraints, Ranking(1)), excluded(constraints, 0) {}

QueryPass::QueryPass(const ColumnSource& source, const Question& question, std::optional<double> tau_1)
    : source_(source),
      question_(question),
      tau_1_(tau_1),
      parameters_(source.grid()),
      used_(quantities_in(question)),
      tally_(question.top, question.where.size()),
      sides_(question.where.size()) {}

Tally QueryPass::run() {
  const std::uint64_t total = setting_count(source_.grid());
  for (first_ = 0; first_ < total; first_ += columns_.count) {
    columns_.count = static_cast<std::size_t>(std::min<std::uint64_t>(kBlockSettings, total - first_));
    block();
  }
  return std::move(tally_);
}

/// The measures are read last, and only when some setting of the block may be admissible.
void QueryPass::block() {
  choose_candidates();
  if (candidates_.empty()) return;
  read_columns();
  evaluate();
  for (const std::size_t i : candidates_) judge(i);
}

void QueryPass::choose_candidates() {
  candidates_.clear();
  for (std::size_t i = 0; i < columns_.count; ++i) candidates_.push_back(i);
  if (tau_1_) {
    std::vector<double>& values = columns_[Parameter::tau_1];
    parameters_.read(Parameter::tau_1, first_, columns_.count, values);
    std::erase_if(candidates_, [&](std::size_t i) { return values[i] != *tau_1_; });
  }
  if (candidates_.empty()) return;
  tally_.total += candidates_.size();
  source_.read_statuses(first_, columns_.count, statuses_);
  PORTRAIT_CHECK_EQ(statuses_.size(), columns_.count);
  std::erase_if(candidates_, [&](std::size_t i) { return !has_right_status(statuses_[i]); });
}

/// Counts the setting when it is left out.
bool QueryPass::has_right_status(Status status) {
  PORTRAIT_CHECK(status <= Status::unstable);
  const bool stable = status == Status::settled || status == Status::not_settled;
  if (stable && (status == Status::settled || question_.include_not_settled)) return true;
  ++(stable                       ? tally_.left_out.not_settled
     : status == Status::unstable ? tally_.left_out.unstable
                                  : tally_.left_out.not_computed);
  return false;
}

void QueryPass::read_columns() {
  for (const Quantity quantity : used_) {
    std::vector<double>& values = columns_[quantity];
    if (const Measure* measure = std::get_if<Measure>(&quantity))
      source_.read(*measure, first_, columns_.count, values);
    else
      parameters_.read(std::get<Parameter>(quantity), first_, columns_.count, values);
    PORTRAIT_CHECK_EQ(values.size(), columns_.count);
  }
}

void QueryPass::evaluate() {
  question_.minimize.evaluate(columns_, stack_, objective_);
  for (std::size_t j = 0; j < sides_.size(); ++j) {
    question_.where[j].left.evaluate(columns_, stack_, sides_[j].left);
    question_.where[j].right.evaluate(columns_, stack_, sides_[j].right);
  }
}

bool QueryPass::is_violated(std::size_t constraint, std::size_t i) const {
  const Sides& sides = sides_[constraint];
  return !holds(question_.where[constraint].relation, sides.left[i], sides.right[i]);
}

void QueryPass::judge(std::size_t i) {
  const Candidate candidate{first_ + i, objective_[i], statuses_[i]};
  if (std::isnan(candidate.objective)) {
    ++tally_.left_out.objective_missing;
    return;
  }
  violated_.clear();
  for (std::size_t j = 0; j < sides_.size(); ++j)
    if (is_violated(j, i)) violated_.push_back(j);
  for (const std::size_t j : violated_) ++tally_.excluded[j];
  if (violated_.empty()) {
    ++tally_.admissible;
    tally_.best.offer(candidate);
  }
  if (violated_.size() == 1) tally_.best_without[violated_[0]].offer(candidate);
  if (tally_.admissible == 0) consider_near_miss(i, candidate);
}

void QueryPass::consider_near_miss(std::size_t i, const Candidate& candidate) {
  double worst = 0;
  for (const std::size_t j : violated_) {
    const double relative = distance(sides_[j].left[i], sides_[j].right[i]);
    if (std::isnan(relative)) return;
    worst = std::max(worst, relative);
  }
  if (tally_.nearest && worst >= tally_.nearest->worst) return;
  tally_.nearest = Tally::Nearest{candidate, worst, {}};
  for (const std::size_t j : violated_) {
    const double left = sides_[j].left[i], right = sides_[j].right[i];
    tally_.nearest->violations.push_back({j, left, right, distance(left, right)});
  }
}

}  // namespace portrait
