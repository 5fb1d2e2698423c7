#include "reproduce/loops.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/words.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/reference/measure.h"

namespace portrait::reproduce {

rules::RulePlant lag_plant(double K, std::vector<double> lags, double Td, int integrators, Polynomial zeros) {
  rules::RulePlant plant;
  plant.integrators = integrators, plant.K = K, plant.Td = Td, plant.zeros = std::move(zeros);
  for (const double T : lags) plant.poles.push_back({1, T});
  return plant;
}

rules::Tuned pid(const ParallelForm& form, int n, double Tf) {
  rules::Tuned t = rules::tuned(standard(form));
  t.n = n, t.Tf = Tf;
  return t;
}

rules::Tuned pi(double Kp, double Ti) { return rules::tuned(StandardForm{Kp, Ti, 0}); }

double peak_sensitivity(const rules::RulePlant& plant, const rules::Tuned& tuned) {
  const OpenLoop open = open_loop(rules::general_loop(plant, tuned));
  return is_stable(open) ? sensitivity_peak(open).value : kInf;
}

rules::PiLoop general_pi_loop(const rules::RulePlant& plant, const rules::IntegratingPlant& scale) {
  return {.Ms = [plant](double Kp, double Ti) { return peak_sensitivity(plant, pi(Kp, Ti)); },
          .errors =
              [plant](double Kp, double Ti) {
                const rules::TunedMeasures m = rules::measured(plant, pi(Kp, Ti));
                return rules::PiErrors{m.measures[Measure::IAE_w], m.measures[Measure::IAE_d]};
              },
          .scale = scale,
          .integrating = false};
}

double number_in_label(std::string_view label, std::string_view name) {
  const std::string wanted = fmt::format("{} = ", name);
  const std::size_t at = label.find(wanted);
  PORTRAIT_CHECK(at != std::string_view::npos);
  std::string_view rest = label.substr(at + wanted.size());
  rest = rest.substr(0, rest.find(','));
  if (rest == "1/2") return 0.5;
  return parse_number(rest).value();
}

std::vector<Computed> row(std::initializer_list<double> values) {
  return row(std::vector<double>(values), values.size());
}

std::vector<Computed> row(const std::vector<double>& values, std::size_t columns) {
  std::vector<Computed> made(columns);
  for (std::size_t i = 0; i < columns && i < values.size(); ++i) made[i].as_printed = values[i];
  return made;
}

}  // namespace portrait::reproduce
