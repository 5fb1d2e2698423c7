#include "engine/reference/measure.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/measures/variation.h"

namespace portrait::reference {
namespace {

using SeriesOf = Series Piece::*;

/// x(0-) = 0, both ends of every panel, every extreme between them: monotonic from point to point.
std::vector<double> turning_points(const std::vector<Piece>& pieces, SeriesOf signal, double noise) {
  std::vector<double> points{0.0};
  for (const Piece& piece : pieces) {
    const Series& c = piece.*signal;
    const auto degree = static_cast<double>(c.size() - 1);
    points.push_back(value(c, -1));
    for (const double x : sign_changes(derivative(c), noise * degree * degree)) points.push_back(value(c, x));
    points.push_back(value(c, 1));
  }
  return points;
}

double largest_magnitude(std::span<const double> points) {
  double largest = 0;
  for (const double x : points) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Integral of |target - y|.
double absolute_error(const std::vector<Piece>& pieces, double target, double noise) {
  double sum = 0;
  for (const Piece& piece : pieces) {
    Series e = -piece.y;
    e(0) += target;
    const Series integral = antiderivative(e);
    std::vector<double> ends = sign_changes(e, noise);
    ends.push_back(1);
    double last = 0, over_panel = 0;
    for (const double x : ends) {
      const double here = value(integral, x);
      over_panel += std::abs(here - last);
      last = here;
    }
    sum += 0.5 * piece.length * over_panel;
  }
  return sum;
}

/// Whether a signal stays near its rest over the last dead time, counted from a whole number of dead times.
bool is_settled(const std::vector<Piece>& pieces, SeriesOf signal, double noise, double at_rest, double horizon) {
  const auto deviation = [&](std::span<const double> points) {
    double largest = 0;
    for (const double x : points) largest = std::max(largest, std::abs(x - at_rest));
    return largest;
  };
  const double from = std::floor(horizon - 1) - 1e-9;
  const auto first =
      std::find_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.start >= from; });
  const std::vector<double> last = turning_points({first, pieces.end()}, signal, noise);
  const double at_end = deviation(std::span(last).subspan(1));
  return at_end <= kSettlingBand * deviation(turning_points(pieces, signal, noise));
}

/// Where the measures of one step stand in the catalogue.
struct Columns {
  Measure IAE, y_max, u_max;
  std::array<Measure, 4> of_y, of_u;  ///< TV, TV0, TV1, TV2
};

constexpr std::array<Columns, kSteps> kColumns = {{
    {Measure::IAE_w,
     Measure::y_max_w,
     Measure::u_max_w,
     {Measure::TV_yw, Measure::TV0_yw, Measure::TV1_yw, Measure::TV2_yw},
     {Measure::TV_uw, Measure::TV0_uw, Measure::TV1_uw, Measure::TV2_uw}},
    {Measure::IAE_d,
     Measure::y_max_d,
     Measure::u_max_d,
     {Measure::TV_yd, Measure::TV0_yd, Measure::TV1_yd, Measure::TV2_yd},
     {Measure::TV_ud, Measure::TV0_ud, Measure::TV1_ud, Measure::TV2_ud}},
}};

void measure_signal(std::span<const double> points, double at_rest, const std::array<Measure, 4>& columns,
                    Measure largest, MeasureRow& row) {
  row[columns[0]] = total_variation(points);
  for (int m = 0; m <= 2; ++m)
    row[columns[static_cast<std::size_t>(m) + 1]] = std::max(0.0, shape_deviation(points, at_rest, m));
  row[largest] = largest_magnitude(points);
}

void measure_step(const StepResponse& r, Step step, MeasureRow& row) {
  const Columns& columns = kColumns[static_cast<std::size_t>(step)];
  const double target = step == kSetpoint ? 1 : 0;
  // Without integral action an error may remain for ever: then its integral does not exist.
  row[columns.IAE] = r.at_rest.y == target ? absolute_error(r.pieces, target, r.y_noise) : kNaN;
  measure_signal(turning_points(r.pieces, &Piece::y, r.y_noise), r.at_rest.y, columns.of_y, columns.y_max, row);
  measure_signal(turning_points(r.pieces, &Piece::u, r.u_noise), r.at_rest.u, columns.of_u, columns.u_max, row);
}

bool is_settled(const Response& response) {
  if (!response.quiet) return false;
  return std::all_of(response.steps.begin(), response.steps.end(), [&](const StepResponse& r) {
    return is_settled(r.pieces, &Piece::y, r.y_noise, r.at_rest.y, response.horizon) &&
           is_settled(r.pieces, &Piece::u, r.u_noise, r.at_rest.u, response.horizon);
  });
}

}  // namespace

Measured measure(const Loop& loop, const Response& response) {
  Measured measured;
  measured.horizon = response.horizon;
  measured.status = is_settled(response) ? Status::settled : Status::not_settled;
  measure_step(response.steps[kSetpoint], kSetpoint, measured.measures);
  measure_step(response.steps[kDisturbance], kDisturbance, measured.measures);
  const OpenLoop open = open_loop(loop);
  measured.measures[Measure::Ms] = sensitivity_peak(open).value;
  measured.measures[Measure::Mt] = complementary_sensitivity_peak(open).value;
  return measured;
}

Measured measure(const Loop& loop, Horizon horizon, const Accuracy& accuracy) {
  if (!is_stable(open_loop(loop))) return {.status = Status::unstable, .measures = {}, .horizon = 0};
  return measure(loop, simulate(loop, horizon, accuracy));
}

}  // namespace portrait::reference
