#include "engine/records/plant_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/records/held_input.h"
#include "engine/records/line_fit.h"

namespace portrait::records {
namespace {

/// Searched parameters: Td and T1, both relative to the time from the change to the end.
using Point = std::array<double, 2>;

class Search {
 public:
  Search(const Record& record, Plant family, bool with_drift, double start)
      : record_(record), input_(record), family_(family), drift_(with_drift), span_(record.t.back() - start) {}

  bool has_lag() const { return family_ == Plant::fotd; }

  struct Solved {
    double K, level, drift, sum_of_squares;
  };
  Solved solve(const Point& p) const {
    const auto n = static_cast<Eigen::Index>(record_.size());
    Eigen::MatrixXd A(n, drift_ ? 3 : 2);
    const std::vector<double> g = answer(p);
    Eigen::VectorXd y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      A(i, 0) = g[k], A(i, 1) = 1, y(i) = record_.y[k];
      if (drift_) A(i, 2) = record_.t[k] - record_.t[0];
    }
    const Eigen::VectorXd x = A.colPivHouseholderQr().solve(y);
    return {x(0), x(1), drift_ ? x(2) : 0, (A * x - y).squaredNorm()};
  }

  double cost(const Point& p) const { return p[0] >= 0 && p[1] > 0 ? solve(p).sum_of_squares : kInf; }
  double Td(const Point& p) const { return p[0] * span_; }
  double T1(const Point& p) const { return p[1] * span_; }

 private:
  std::vector<double> answer(const Point& p) const {
    if (has_lag()) return input_.lagged(record_.t, Td(p), T1(p));
    std::vector<double> g;
    for (const double t : record_.t)
      g.push_back(family_ == Plant::ipdt ? input_.integral(t - Td(p)) : input_.double_integral(t - Td(p)));
    return g;
  }

  const Record& record_;
  HeldInput input_;
  Plant family_;
  bool drift_;
  double span_;
};

Point best_of_grid(const Search& search) {
  Point best{0, 1};
  double least = kInf;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < (search.has_lag() ? 20 : 1); ++k) {
      const Point p{0.8 * i / 30, search.has_lag() ? 0.002 * std::pow(2500.0, k / 19.0) : 1};
      if (const double cost = search.cost(p); cost < least) least = cost, best = p;
    }
  return best;
}

/// Steps along both parameters and their diagonals, halved where none helps.
Point refined(const Search& search, Point at) {
  double least = search.cost(at);
  for (double step = 0.1; step > 1e-10;) {
    bool better = false;
    for (const auto& [i, k] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}, {1, 1}, {-1, -1}}) {
      if (k != 0 && !search.has_lag()) continue;
      const Point p{std::max(0.0, at[0] + i * step * std::max(at[0], 0.05)), at[1] * (1 + k * step)};
      if (const double cost = search.cost(p); cost < least) least = cost, at = p, better = true;
    }
    if (!better) step /= 2;
  }
  return at;
}

/// Every n-th sample, for the search on the grid.
Record thinned(const Record& r) {
  const std::size_t n = r.size() / 400 + 1;
  Record thin;
  for (std::size_t i = 0; i < r.size(); i += n)
    thin.t.push_back(r.t[i]), thin.u.push_back(r.u[i]), thin.y.push_back(r.y[i]);
  return thin;
}

double spread_about_line(const Record& r) {
  const LineFit line = line_fit(r, 0, r.size());
  double sum = 0;
  for (std::size_t i = 0; i < r.size(); ++i) sum += std::pow(r.y[i] - line.level, 2);
  return sum;
}

}  // namespace

PlantFit fitted_plant(const Record& r, Plant family, bool with_drift) {
  const Quality q = quality(r);
  const Record few = thinned(r);
  const Search search(r, family, with_drift, q.start);
  const Point at = refined(search, best_of_grid(Search(few, family, with_drift, q.start)));
  const auto [K, level, drift, squares] = search.solve(at);
  const double spread = spread_about_line(r);
  const double share = spread > 0 ? squares / spread : 1;
  if (!(share < 0.5) || K == 0)
    throw InputError(
        fmt::format("{} does not answer this input like that: the best model leaves {:.0f} % of y's variation",
                    to_string(family), 100 * share));
  PlantFit fit{{family, K, search.Td(at), search.has_lag() ? search.T1(at) : 0},
               level,
               drift,
               std::sqrt(squares / static_cast<double>(r.size())),
               share,
               q,
               q.remarks};
  if (fit.residual > 3 * q.noise && share > 1e-4)
    fit.remarks.push_back(fmt::format(
        "the model leaves more than noise: {:.3g} against {:.3g} from sample to sample", fit.residual, q.noise));
  if (fit.plant.Td == 0)
    fit.remarks.push_back("no dead time: the response begins at once, or the plant is of higher order");
  return fit;
}

MeasuredReactionCurve measured_reaction_curve(const Record& r) {
  const Quality q = quality(r);
  const double dU = r.u.back() - r.u[0];
  for (std::size_t i = 0; i < r.size(); ++i)
    if (std::abs(r.u[i] - (r.t[i] < q.start ? r.u[0] : r.u.back())) > 0.02 * std::abs(dU))
      throw InputError("a reaction curve needs one step of u, and u does more");
  const std::size_t window = std::max<std::size_t>(5, r.size() / 40);
  LineFit steepest;
  for (std::size_t i = 0; i + window <= r.size(); ++i) {
    const LineFit line = line_fit(r, i, i + window);
    if (line.middle > q.start && std::abs(line.slope - q.drift) > std::abs(steepest.slope))
      steepest = line, steepest.slope -= q.drift;
  }
  if (steepest.slope == 0) throw InputError("y does not answer the step");
  const double base = q.before_y + q.drift * (steepest.middle - q.start);
  return {steepest.slope / dU, steepest.middle - (steepest.level - base) / steepest.slope - q.start,
          r.t[window] - r.t[0]};
}

}  // namespace portrait::records
