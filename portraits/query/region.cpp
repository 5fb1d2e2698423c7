#include "portraits/query/region.h"

#include <algorithm>
#include <cmath>

#include "portraits/query/admission.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

Sheet sheet_of(const ColumnSource& source, const Conditions& conditions) {
  require_answerable(conditions, source.grid());
  std::vector<Quantity> used;
  for (const Constraint& constraint : conditions.where) collect(constraint, used);
  return Sheet(source, conditions.units, used, conditions.include_not_settled);
}

/// Whole numbers, so that sums do not depend on who added them up.
struct RegionTally {
  explicit RegionTally(const Grid& grid) : products(grid.axes.size() * grid.axes.size()), runs(grid) {
    for (const Axis& axis : grid.axes) counts.emplace_back(axis.size());
  }
  void merge(const RegionTally& other) {
    counted.merge(other.counted);
    admissible += other.admissible;
    for (std::size_t k = 0; k < counts.size(); ++k)
      for (std::size_t i = 0; i < counts[k].size(); ++i) counts[k][i] += other.counts[k][i];
    for (std::size_t k = 0; k < products.size(); ++k) products[k] += other.products[k];
    runs.merge(other.runs);
  }
  void add(std::uint64_t number, const std::vector<std::uint64_t>& at) {
    ++admissible;
    runs.add(number);
    for (std::size_t k = 0; k < at.size(); ++k) {
      ++counts[k][at[k]];
      for (std::size_t j = 0; j < at.size(); ++j) products[k * at.size() + j] += at[k] * at[j];
    }
  }

  Counted counted;
  std::uint64_t admissible = 0;
  std::vector<std::vector<std::uint64_t>> counts;  ///< by axis and value
  std::vector<std::uint64_t> products;             ///< sums of products of indices
  SettingRuns runs;
};

AxisExtent extent_of(const Axis& axis, std::vector<std::uint64_t> counts) {
  AxisExtent extent{axis.parameter(), std::move(counts), {}, {}, false, false};
  for (std::size_t i = 0; i < extent.counts.size(); ++i) {
    if (extent.counts[i] == 0) continue;
    if (!extent.first) extent.first = i;
    extent.last = i;
  }
  if (!extent.first || axis.size() < 2) return extent;
  extent.at_lower_edge = *extent.first == 0;
  extent.at_upper_edge = *extent.last + 1 == axis.size() && std::isfinite(axis[axis.size() - 1]);
  return extent;
}

std::vector<double> correlation_of(const RegionTally& tally) {
  const std::size_t axes = tally.counts.size();
  const auto count = static_cast<double>(tally.admissible);
  std::vector<double> mean(axes, 0), result(axes * axes);
  for (std::size_t k = 0; k < axes; ++k)
    for (std::size_t i = 0; i < tally.counts[k].size(); ++i)
      mean[k] += static_cast<double>(i) * static_cast<double>(tally.counts[k][i]) / count;
  const auto covariance = [&](std::size_t j, std::size_t k) {
    return static_cast<double>(tally.products[j * axes + k]) / count - mean[j] * mean[k];
  };
  for (std::size_t j = 0; j < axes; ++j)
    for (std::size_t k = 0; k < axes; ++k) {
      const double spread = std::sqrt(covariance(j, j) * covariance(k, k));
      result[j * axes + k] = spread > 1e-9 ? covariance(j, k) / spread : kNaN;
    }
  return result;
}

/// What is nearest so far, and how near others must be.
struct NearestTally {
  std::optional<Candidate> nearest;  ///< its objective is the distance
  void offer(const Candidate& candidate) {
    if (!nearest || is_better(candidate, *nearest)) nearest = candidate;
  }
  void merge(const NearestTally& other) {
    if (other.nearest) offer(*other.nearest);
  }
};

class Nearing {
 public:
  Nearing(const Sheet& sheet, const Conditions& conditions, const Setting& setting)
      : sheet_(sheet), admission_(sheet, conditions.where) {
    for (const Axis& axis : sheet.grid().axes) {
      const double wanted = place_on(axis, get(setting, axis.parameter()));
      std::vector<double> squares;
      for (std::uint64_t i = 0; i < axis.size(); ++i) {
        const double apart = wanted - place_on(axis, axis[i]);
        squares.push_back(apart * apart);
      }
      squares_.push_back(std::move(squares));
    }
  }

  void visit(NearestTally& tally, TilePage& page, std::uint64_t tile) const {
    if (least_distance(tile) > enough_.value()) return;
    thread_local Admission::Glance glance;
    thread_local std::vector<std::size_t> chosen;
    Counted nothing;
    if (!admission_.glance(tile, nothing, glance) || !glance.possible) return;
    admission_.choose(tile, glance, page, nothing, chosen);
    for (const std::size_t i : chosen) {
      const std::uint64_t number = page.range().first + i;
      tally.offer({number, distance_to(coordinates(sheet_.grid(), number)), page.statuses()[i]});
    }
    if (tally.nearest) enough_.lower(tally.nearest->objective);
  }

 private:
  double distance_to(const std::vector<std::uint64_t>& at) const {
    double sum = 0;
    for (std::size_t k = 0; k < at.size(); ++k) sum += squares_[k][at[k]];
    return std::sqrt(sum);
  }

  double least_distance(std::uint64_t tile) const {
    const Box box = sheet_.rows().box(tile);
    double sum = 0;
    for (std::size_t k = 0; k < squares_.size(); ++k) {
      const auto begin = squares_[k].begin() + static_cast<std::ptrdiff_t>(box.start[k]);
      sum += *std::min_element(begin, begin + static_cast<std::ptrdiff_t>(box.extent[k]));
    }
    return std::sqrt(sum);
  }

  const Sheet& sheet_;
  Admission admission_;
  std::vector<std::vector<double>> squares_;  ///< by axis and value
  mutable SharedLeast enough_;
};

}  // namespace

Region region(const ColumnSource& source, const Conditions& conditions) {
  const Sheet sheet = sheet_of(source, conditions);
  const Admission admission(sheet, conditions.where);
  const RegionTally tally =
      share(sheet, conditions.threads, sheet.rows().tile_count(), RegionTally(source.grid()),
            [&](RegionTally& t, TilePage& page, std::uint64_t tile) {
              thread_local Admission::Glance glance;
              thread_local std::vector<std::size_t> chosen;
              if (!admission.glance(tile, t.counted, glance)) return;
              admission.choose(tile, glance, page, t.counted, chosen);
              for (const std::size_t i : chosen)
                t.add(page.range().first + i, coordinates(source.grid(), page.range().first + i));
            });
  Region found{tally.admissible,       tally.counted.total,
               tally.counted.left_out, {},
               correlation_of(tally),  pieces_of(source.grid(), tally.runs.runs())};
  for (std::size_t k = 0; k < tally.counts.size(); ++k)
    found.axes.push_back(extent_of(source.grid().axes[k], tally.counts[k]));
  return found;
}

double place_on(const Axis& axis, double value) {
  const std::uint64_t size = axis.size();
  if (size < 2) return 0;
  const double last = axis[size - 1];
  if (value == last) return 1;
  if (!std::isfinite(value)) return kInf;
  const std::uint64_t finite = std::isfinite(last) ? size : size - 1;
  if (finite < 2) return 0;
  std::uint64_t cell = 0;
  while (cell + 2 < finite && axis[cell + 1] <= value) ++cell;
  const double within = (value - axis[cell]) / (axis[cell + 1] - axis[cell]);
  return (static_cast<double>(cell) + within) / static_cast<double>(size - 1);
}

std::optional<NearestAdmissible> nearest_admissible(const ColumnSource& source, const Conditions& conditions,
                                                    const Setting& setting) {
  const Sheet sheet = sheet_of(source, conditions);
  const Nearing nearing(sheet, conditions, setting);
  const NearestTally tally =
      share(sheet, conditions.threads, sheet.rows().tile_count(), NearestTally(),
            [&](NearestTally& t, TilePage& page, std::uint64_t tile) { nearing.visit(t, page, tile); });
  if (!tally.nearest) return std::nullopt;
  return NearestAdmissible{found_at(source, conditions.units, tally.nearest->number, kNaN),
                           tally.nearest->objective};
}

bool Verdict::admissible() const {
  return right_status &&
         std::all_of(constraints.begin(), constraints.end(), [](const Side& side) { return side.holds; });
}

Verdict judge(const Grid& grid, const Conditions& conditions, const Setting& setting) {
  require_answerable(conditions, grid);
  Verdict verdict{measure(grid, conditions.units, std::span(&setting, 1)).front(), false, {}};
  const Status status = verdict.measured.status;
  verdict.right_status =
      status == Status::settled || (conditions.include_not_settled && status == Status::not_settled);
  for (const Constraint& constraint : conditions.where) {
    const double left = value_at(constraint.left, verdict.measured);
    const double right = value_at(constraint.right, verdict.measured);
    verdict.constraints.push_back({left, right, holds(constraint.relation, left, right), distance(left, right)});
  }
  return verdict;
}

}  // namespace portrait
