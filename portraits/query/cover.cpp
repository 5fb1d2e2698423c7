#include "portraits/query/cover.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "engine/base/check.h"

namespace portrait {
namespace {

constexpr int kLevels = 12;
constexpr int kEnd = 1 << kLevels;  ///< coordinates of lattice points run from 0 to this

using Place = std::array<int, 3>;

struct Cell {
  Place low, high;
};

/// Steps of the climb, as parts of the box.
constexpr double kFirstStep = 1.0 / 32, kLastStep = 1e-6;

class Covering {
 public:
  explicit Covering(const CoverProblem& problem) : problem_(problem) { result_.greatest.resize(problem.functions); }

  Cover run() {
    std::vector<Cell> cells = first_cells(), parents;
    while (!cells.empty() && know_points_of(cells)) {
      if (problem_.stop_beyond && is_beyond()) return ended(Outcome::beyond);
      parents = std::move(cells);
      cells = halved(parents);
    }
    if (!cells.empty())  // too many points: the coarser cells' bounds hold as well
      for (const Cell& cell : parents) keep_bounds(bounds_of(cell));
    climb();
    return ended(is_beyond() ? Outcome::beyond : bounds_within() ? Outcome::within : Outcome::open);
  }

 private:
  /// Of one cell: by function the bound, and what each direction adds to it.
  struct Bounds {
    std::vector<double> bound;
    std::vector<std::array<double, 3>> rise;
  };

  Cover ended(Outcome outcome) {
    result_.outcome = outcome;
    for (Greatest& greatest : result_.greatest) greatest.bound = std::max(greatest.bound, greatest.value);
    return std::move(result_);
  }

  bool is_beyond() const {
    for (std::size_t f = 0; f < problem_.functions; ++f)
      if (result_.greatest[f].value > problem_.limit[f]) return true;
    return false;
  }
  bool bounds_within() const {
    for (std::size_t f = 0; f < problem_.functions; ++f)
      if (result_.greatest[f].bound > problem_.limit[f]) return false;
    return true;
  }

  std::vector<Cell> first_cells() const {
    std::vector<Cell> cells = {{{0, 0, 0}, {kEnd, kEnd, kEnd}}};
    for (const std::size_t k : problem_.directions) {
      std::vector<Cell> cut;
      for (const Cell& cell : cells)
        for (int i = 0; i < static_cast<int>(kFirstCells); ++i) {
          cut.push_back(cell);
          cut.back().low[k] = kEnd * i / static_cast<int>(kFirstCells);
          cut.back().high[k] = kEnd * (i + 1) / static_cast<int>(kFirstCells);
        }
      cells = cut;
    }
    return cells;
  }

  static std::uint64_t key(const Place& place) {
    return static_cast<std::uint64_t>(place[0]) << 32 | static_cast<std::uint64_t>(place[1]) << 16 |
           static_cast<std::uint64_t>(place[2]);
  }

  /// Visits corners, middles and centre, the first direction fastest.
  template <typename Visit>
  void each_place(const Cell& cell, Visit visit) const {
    std::size_t count = 1;
    for (std::size_t i = 0; i < problem_.directions.size(); ++i) count *= 3;
    for (std::size_t i = 0; i < count; ++i) {
      Place place{};
      std::size_t rest = i;
      for (const std::size_t k : problem_.directions) {
        place[k] = cell.low[k] + static_cast<int>(rest % 3) * (cell.high[k] - cell.low[k]) / 2;
        rest /= 3;
      }
      visit(place);
    }
  }

  static BoxPoint point_at(const Place& place) {
    BoxPoint point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = static_cast<double>(place[k]) / kEnd;
    return point;
  }

  /// Evaluates what is missing, or nothing when that would be too much.
  bool know_points_of(const std::vector<Cell>& cells) {
    std::vector<BoxPoint> points;
    std::vector<std::uint64_t> keys;
    for (const Cell& cell : cells)
      each_place(cell, [&](const Place& place) {
        if (!rows_.try_emplace(key(place), values_.size() + points.size() * problem_.functions).second) return;
        points.push_back(point_at(place));
        keys.push_back(key(place));
      });
    if (result_.points + points.size() > kMostPoints) {
      for (const std::uint64_t k : keys) rows_.erase(k);
      return false;
    }
    const std::vector<double> values = probe(points);
    values_.insert(values_.end(), values.begin(), values.end());
    return true;
  }

  /// Evaluates, and keeps the greatest.
  std::vector<double> probe(const std::vector<BoxPoint>& points) {
    if (points.empty()) return {};
    std::vector<double> values = problem_.probe(points);
    PORTRAIT_CHECK_EQ(values.size(), points.size() * problem_.functions);
    result_.points += points.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
      Greatest& greatest = result_.greatest[i % problem_.functions];
      if (values[i] <= greatest.value) continue;
      greatest.value = values[i];
      greatest.at = points[i / problem_.functions];
    }
    return values;
  }

  Bounds bounds_of(const Cell& cell) const {
    std::vector<const double*> rows;
    each_place(cell, [&](const Place& place) { rows.push_back(&values_[rows_.at(key(place))]); });
    Bounds bounds{std::vector<double>(problem_.functions, -kInf), {}};
    bounds.rise.resize(problem_.functions, {0, 0, 0});
    for (std::size_t f = 0; f < problem_.functions; ++f) {
      for (const double* row : rows) bounds.bound[f] = std::max(bounds.bound[f], row[f]);
      std::size_t stride = 1;
      for (const std::size_t k : problem_.directions) {
        double& rise = bounds.rise[f][k];
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (i / stride % 3 == 0)
            rise = std::max(rise, rise_between(rows[i][f], rows[i + stride][f], rows[i + 2 * stride][f]));
        stride *= 3;
      }
      for (const double rise : bounds.rise[f]) bounds.bound[f] += rise;
    }
    return bounds;
  }

  bool is_decided(std::size_t f, double bound) const {
    return bound <= problem_.limit[f] && bound <= result_.greatest[f].value + problem_.tolerance[f];
  }

  void keep_bounds(const Bounds& bounds) {
    for (std::size_t f = 0; f < problem_.functions; ++f)
      result_.greatest[f].bound = std::max(result_.greatest[f].bound, bounds.bound[f]);
  }

  /// The halves of those that are not decided; the bounds of the others are kept.
  std::vector<Cell> halved(const std::vector<Cell>& cells) {
    std::vector<Cell> halves;
    for (const Cell& cell : cells) {
      const Bounds bounds = bounds_of(cell);
      std::array<double, 3> weight{};
      bool decided = true;
      for (std::size_t f = 0; f < problem_.functions; ++f) {
        if (is_decided(f, bounds.bound[f])) continue;
        decided = false;
        const double sum = bounds.rise[f][0] + bounds.rise[f][1] + bounds.rise[f][2];
        for (std::size_t k = 0; k < 3; ++k)
          weight[k] += sum > 0 && std::isfinite(sum) ? bounds.rise[f][k] / sum : 0;
      }
      const auto direction = decided ? std::nullopt : widest(cell, weight);
      if (!direction) {
        keep_bounds(bounds);
        continue;
      }
      const int middle = (cell.low[*direction] + cell.high[*direction]) / 2;
      halves.push_back(cell);
      halves.back().high[*direction] = middle;
      halves.push_back(cell);
      halves.back().low[*direction] = middle;
    }
    return halves;
  }

  /// The direction of the greatest weight that can still be halved.
  std::optional<std::size_t> widest(const Cell& cell, const std::array<double, 3>& weight) const {
    std::optional<std::size_t> best;
    for (const std::size_t k : problem_.directions)
      if (cell.high[k] - cell.low[k] >= 4 && (!best || weight[k] > weight[*best])) best = k;
    return best;
  }

  /// From the greatest point of each function to a better one nearby, as long as there is one.
  void climb() {
    for (double step = kFirstStep; step >= kLastStep && !problem_.directions.empty();) {
      std::vector<BoxPoint> points;
      for (const Greatest& greatest : result_.greatest)
        for (const std::size_t k : problem_.directions)
          for (const double side : {-step, step}) {
            BoxPoint point = greatest.at;
            point[k] = std::clamp(point[k] + side, 0.0, 1.0);
            if (point != greatest.at) points.push_back(point);
          }
      const std::vector<Greatest> before = result_.greatest;
      probe(points);
      bool better = false;
      for (std::size_t f = 0; f < problem_.functions; ++f)
        better = better || result_.greatest[f].value > before[f].value + 1e-9 * std::abs(before[f].value);
      if (!better || result_.points > 2 * kMostPoints) step /= 4;
    }
  }

  const CoverProblem& problem_;
  std::unordered_map<std::uint64_t, std::size_t> rows_;  ///< where the values of a place begin
  std::vector<double> values_;
  Cover result_;
};

}  // namespace

double rise_between(double first, double middle, double last) {
  if (first == middle && middle == last) return 0;  // infinite ones too
  const double D = first - 2 * middle + last;
  return std::isfinite(D) ? std::max(-D, std::abs(D) / 4) : kInf;
}

Cover cover(const CoverProblem& problem) {
  PORTRAIT_CHECK(problem.functions > 0 && problem.limit.size() == problem.functions &&
                 problem.tolerance.size() == problem.functions);
  return Covering(problem).run();
}

}  // namespace portrait
