#include "engine/reference/measure.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/loop/loop_measures.h"
#include "engine/loop/stability.h"
#include "engine/measures/step_measures.h"
#include "engine/measures/variation.h"
#include "engine/reference/error_integrals.h"

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

/// What lies beyond a time; a panel without dead time may begin before it.
std::vector<Piece> pieces_from(const std::vector<Piece>& pieces, double from) {
  constexpr double kEdge = 1e-9;
  const auto first = std::find_if(pieces.begin(), pieces.end(),
                                  [&](const Piece& piece) { return piece.start + piece.length > from + kEdge; });
  std::vector<Piece> last(first, pieces.end());
  if (!last.empty() && last.front().start < from - kEdge) {
    Piece& cut = last.front();
    const double x = 2 * (from - cut.start) / cut.length - 1, length = cut.start + cut.length - from;
    cut = {from, length, restricted(cut.y, x, 1), restricted(cut.u, x, 1)};
  }
  return last;
}

/// Whether a signal stays near its rest from some time on.
bool is_settled(const std::vector<Piece>& pieces, SeriesOf signal, double noise, double at_rest, double from) {
  const auto deviation = [&](std::span<const double> points) {
    double largest = 0;
    for (const double x : points) largest = std::max(largest, std::abs(x - at_rest));
    return largest;
  };
  const std::vector<double> last = turning_points(pieces_from(pieces, from), signal, noise);
  const double at_end = deviation(std::span(last).subspan(1));
  return at_end <= kSettlingBand * deviation(turning_points(pieces, signal, noise));
}

constexpr std::array<StepMeasures, kSteps> kMeasuresOf = {kSetpointMeasures, kDisturbanceMeasures,
                                                          kOutputStepMeasures};

/// Of a limit that is a quotient of coefficients.
constexpr double kSameRest = 1e-12;

/// Without integral action an error may remain for ever: then its integrals do not exist.
void measure_error(const StepResponse& r, double target, const StepMeasures& names, MeasureRow& row) {
  if (!(std::abs(r.at_rest.y - target) <= kSameRest)) return;
  const ErrorIntegrals of_error = error_integrals(r.pieces, target, r.y_noise);
  row[names.IAE] = of_error.IAE;
  row[names.ISE] = of_error.ISE;
  row[names.ITAE] = of_error.ITAE;
  row[names.ITSE] = of_error.ITSE;
}

/// The measures of one signal after one step, by name.
struct SignalMeasures {
  const std::array<Measure, 4>& variations;
  const std::array<Measure, 6>& further;
  Measure largest, dynamic_class;
};

void measure_signal(std::span<const double> points, double at_rest, const SignalMeasures& names, MeasureRow& row) {
  row[names.variations[0]] = total_variation(points);
  for (int m = 0; m <= 8; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const Measure name = m <= 2 ? names.variations[i + 1] : names.further[i - 3];
    row[name] = std::max(0.0, shape_deviation(points, at_rest, m));
  }
  row[names.largest] = largest_magnitude(points);
  double deviation = 0;
  for (const double x : points) deviation = std::max(deviation, std::abs(x - at_rest));
  row[names.dynamic_class] = alternating_extremes(points, at_rest, kSettlingBand * deviation);
}

void measure_step(const StepResponse& r, Step step, MeasureRow& row) {
  const StepMeasures& names = kMeasuresOf[static_cast<std::size_t>(step)];
  measure_error(r, step == kSetpoint ? 1 : 0, names, row);
  measure_signal(turning_points(r.pieces, &Piece::y, r.y_noise), r.at_rest.y,
                 {names.of_y, names.further_y, names.y_max, names.class_y}, row);
  measure_signal(turning_points(r.pieces, &Piece::u, r.u_noise), r.at_rest.u,
                 {names.of_u, names.further_u, names.u_max, names.class_u}, row);
}

bool is_settled(const Response& response) {
  if (!response.quiet) return false;
  return std::all_of(response.steps.begin(), response.steps.end(), [&](const StepResponse& r) {
    if (r.pieces.empty()) return true;
    return is_settled(r.pieces, &Piece::y, r.y_noise, r.at_rest.y, response.last_from) &&
           is_settled(r.pieces, &Piece::u, r.u_noise, r.at_rest.u, response.last_from);
  });
}

Measured measured_responses(const Response& response) {
  Measured measured;
  measured.horizon = response.horizon;
  measured.status = is_settled(response) ? Status::settled : Status::not_settled;
  for (const Step step : kAllSteps)
    if (!response.steps[step].pieces.empty()) measure_step(response.steps[step], step, measured.measures);
  return measured;
}

}  // namespace

Measured measure(const Loop& loop, const Response& response, std::optional<double> sampling) {
  Measured measured = measured_responses(response);
  measure_loop(loop, sampling, measured.measures);
  return measured;
}

Measured measure(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy, std::span<const Step> steps) {
  const OpenLoop open = open_loop(loop);
  if (!is_stable(open)) return {.status = Status::unstable, .measures = {}, .horizon = 0};
  Measured measured = measured_responses(simulate(loop, horizon, accuracy, steps));
  measure_loop(open, measured.measures);
  return measured;
}

MeasuredInUnits measure_in_units(const GeneralLoop& loop, Horizon horizon, std::span<const Step> steps) {
  const NormalisedLoop inside = normalised(loop);
  horizon.dead_times /= inside.units.time;
  MeasuredInUnits found{measure(inside.loop, horizon, {}, steps), inside.units};
  for (const Measure m : all_measures()) found.measured.measures[m] *= scale(m, inside.units);
  found.measured.horizon *= inside.units.time;
  return found;
}

Measured measure(const Loop& loop, Horizon horizon, const Accuracy& accuracy, std::optional<double> sampling,
                 std::span<const Step> steps) {
  if (!is_stable(open_loop(loop))) return {.status = Status::unstable, .measures = {}, .horizon = 0};
  return measure(loop, simulate(loop, horizon, accuracy, steps), sampling);
}

}  // namespace portrait::reference
