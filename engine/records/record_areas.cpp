#include "engine/records/record_areas.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/records/line_fit.h"

namespace portrait::records {
namespace {

/// int_a^b t^p/p! dt and int_a^b t^p/p! (t - a)/(b - a) dt.
struct Weights {
  double constant, rising;
};
Weights weights(double a, double b, int p) {
  const double first = (std::pow(b, p + 1) - std::pow(a, p + 1)) / std::tgamma(p + 2);
  const double moment = (p + 1) * (std::pow(b, p + 2) - std::pow(a, p + 2)) / std::tgamma(p + 3);
  return {first, (moment - a * first) / (b - a)};
}

/// The part of a record from the change on, times from there, up to where the end was fitted.
struct Stretch {
  std::size_t from, to;
  double start;
};

/// int t^p/p! (end - x) dt over the stretch; `held` or a straight line between samples.
double integral(const Record& r, const Stretch& s, const std::vector<double>& x, double end, int p, bool held) {
  double sum = 0;
  for (std::size_t i = s.from; i < s.to; ++i) {
    const Weights w = weights(r.t[i] - s.start, r.t[i + 1] - s.start, p);
    sum += (end - x[i]) * w.constant - (held ? 0 : (x[i + 1] - x[i]) * w.rising);
  }
  return sum;
}

std::size_t index_at(const Record& r, double t) {
  return static_cast<std::size_t>(std::lower_bound(r.t.begin(), r.t.end(), t) - r.t.begin());
}

std::size_t tail_begin(const Record& r, const Quality& q, double settled_from) {
  const double begin = std::isnan(settled_from) ? r.t.back() - 0.1 * (r.t.back() - q.start) : settled_from;
  const std::size_t at = index_at(r, begin);
  if (!(begin > q.start) || at + 5 > r.size())
    throw InputError(fmt::format(
        "the settled part, from t = {:.6g} on, has fewer than five samples behind the change at t = {:.6g}", begin,
        q.start));
  return at;
}

double change_of_input(const Record& r, std::size_t tail) {
  double end = 0, least = r.u[tail], most = r.u[tail];
  for (std::size_t i = tail; i < r.size(); ++i) {
    end += r.u[i] / static_cast<double>(r.size() - tail);
    least = std::min(least, r.u[i]), most = std::max(most, r.u[i]);
  }
  const double dU = end - r.u[0];
  double largest = 0;
  for (const double u : r.u) largest = std::max(largest, std::abs(u - r.u[0]));
  if (std::abs(dU) < 1e-9 * largest || most - least > 0.1 * std::abs(dU))
    throw InputError(
        fmt::format("u must end on a new level: it begins at {:.6g} and lies between {:.6g} and {:.6g} at the end",
                    r.u[0], least, most));
  return dU;
}

/// A_k of the head, from Y_k and the moments of the input.
std::vector<double> divided(const std::vector<double>& Y, const std::vector<double>& U) {
  std::vector<double> A(Y.size());
  for (std::size_t k = 0; k < Y.size(); ++k) {
    A[k] = Y[k];
    for (std::size_t i = 0; i < k; ++i) A[k] -= A[i] * U[k - i];
  }
  return A;
}

std::vector<double> input_moments(const Record& r, const Stretch& s, double dU, std::size_t count) {
  std::vector<double> U{1};
  for (std::size_t k = 1; k < count; ++k)
    U.push_back(integral(r, s, r.u, r.u[0] + dU, static_cast<int>(k) - 1, true) / dU);
  return U;
}

/// By how much a line through the tail's halves differs from one level (or slope): twice what noise alone would do, or
/// a fiftieth of the whole change, is too much.
void need_rest(double moves, double change, double noise, std::size_t samples, const char* what) {
  const double allowed = 0.02 * std::abs(change) + 6 * noise / std::sqrt(static_cast<double>(samples));
  if (std::abs(moves) > allowed)
    throw InputError(fmt::format(
        "{}: over its last part it still changes by {:.3g} of {:.3g}. Record longer, say from where it rests "
        "(--settled-from), or fit a model (--plant fotd, ipdt or dipdt)",
        what, moves, change));
}

}  // namespace

RecordAreas self_regulating_areas(const Record& r, std::size_t count, double settled_from) {
  const Quality q = quality(r);
  const std::size_t tail = tail_begin(r, q, settled_from);
  const double dU = change_of_input(r, tail);
  const LineFit end = line_fit(r, tail, r.size());
  need_rest(end.slope * (r.t.back() - r.t[tail]), end.level - q.before_y, q.noise, r.size() - tail,
            "y has not come to rest at the end of the record");
  const Stretch s{index_at(r, q.start), tail, q.start};
  std::vector<double> Y{(end.level - q.before_y) / dU};
  for (std::size_t k = 1; k < count; ++k)
    Y.push_back(integral(r, s, r.y, end.level, static_cast<int>(k) - 1, false) / dU);
  return {divided(Y, input_moments(r, s, dU, count)), r.t[tail], q};
}

RecordAreas integrating_areas(const Record& r, std::size_t count, double settled_from) {
  const Quality q = quality(r);
  const std::size_t tail = tail_begin(r, q, settled_from);
  const double dU = change_of_input(r, tail);
  const LineFit end = line_fit(r, tail, r.size());
  const std::size_t middle = tail + (r.size() - tail) / 2;
  const double turns = line_fit(r, middle, r.size()).slope - line_fit(r, tail, middle).slope,
               change = end.slope - q.drift;
  need_rest(turns, change, q.noise / (r.t.back() - r.t[tail]) * 8, r.size() - tail,
            "y has not come to a straight line at the end of the record");
  const Stretch s{index_at(r, q.start), tail, q.start};
  // Distance from the line on which y would have gone on, against the last line, on which it ends: w -> w(inf).
  const double y_start = q.before_y + q.drift * (q.start - 0.5 * (r.t[0] + r.t[s.from > 0 ? s.from - 1 : 0]));
  std::vector<double> w(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) w[i] = end.slope * (r.t[i] - q.start) - (r.y[i] - y_start);
  const double w_end = end.slope * (r.t[tail] - q.start) - (end.level_at(r.t[tail]) - y_start);
  std::vector<double> Y{change / dU};
  if (count > 1) Y.push_back(w_end / dU);
  for (std::size_t k = 2; k < count; ++k)
    Y.push_back(integral(r, s, w, w_end, static_cast<int>(k) - 2, false) / dU);
  return {divided(Y, input_moments(r, s, dU, count)), r.t[tail], q};
}

}  // namespace portrait::records
