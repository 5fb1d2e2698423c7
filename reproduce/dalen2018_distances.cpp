/// The tables of Dalen2018 on V_M, the distance of a tuning from the Pareto front: 2, 7, 9, 11, 13.

#include <cmath>

#include "engine/reference/measure.h"
#include "reproduce/dalen2018.h"

namespace portrait::reproduce {
namespace {

using rules::LagDelayPlant;
using rules::PiLoop;
using rules::RulePlant;

constexpr int kIntervals = 16;

/// Mean over a grid of Ms of (J of the PI on the curve of cbar less J of the front)^2, J with the references of Ms = 1.59
/// throughout.                                                                                  [Dalen2018 (41), (42)]
/// The paper does not state the grid. Here it is dense and uniform in the delta of Algorithm 1 with cbar = 2.5, from Ms = 2.0
/// to 1.3: the mean is an integral, by Simpson's rule.
struct Distances {
  PiLoop loop;
  std::vector<double> Ms, weight;
  rules::PiErrors least;
  std::vector<double> front;

  enum class Weights { least, of_front };

  explicit Distances(PiLoop a_loop, Weights weights = Weights::least) : loop(std::move(a_loop)) {
    const rules::ParetoPi po = rules::pareto_pi(loop, kPrescribedMs, 0.5).value();
    least = weights == Weights::least ? po.least : po.errors;
    const double first = delta_of(2.0), last = delta_of(1.3);
    for (int i = 0; i <= kIntervals; ++i) {
      const StandardForm f = rules::delta_tuning(loop.scale, 2.5, first + (last - first) * i / kIntervals);
      Ms.push_back(loop.Ms(f.Kc, f.Ti));
      weight.push_back((i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3 * kIntervals));
      front.push_back(rules::pareto_pi(loop, Ms.back(), 0.5, least)->J);
    }
  }
  double delta_of(double peak) const {
    const StandardForm f = rules::pi_of_sensitivity(loop, 2.5, peak).value();
    return rules::relative_delay_margin(f.Kc * loop.scale.k * loop.scale.tau, f.Ti / loop.scale.tau);
  }
  double J(const rules::PiErrors& e) const { return 0.5 * (e.IAE_vy / least.IAE_vy + e.IAE_vu / least.IAE_vu); }
  /// `form` gives the PI of one Ms.
  template <typename Form>
  double of(const Form& form) const {
    double sum = 0;
    for (std::size_t i = 0; i < Ms.size(); ++i) {
      const StandardForm f = form(Ms[i]);
      sum += weight[i] * std::pow(J(loop.errors(f.Kc, f.Ti)) - front[i], 2);
    }
    return sum;
  }
  double of_cbar(double cbar) const {
    return of([&](double peak) { return rules::pi_of_sensitivity(loop, cbar, peak).value(); });
  }
};

/// SIMC of a lag plant at a prescribed Ms, by its Tc.
StandardForm simc_of_sensitivity(const PiLoop& loop, const LagDelayPlant& p, double Ms) {
  double low = -0.5 * p.tau, high = 20 * p.tau;
  for (int i = 0; i < 60; ++i) {
    const double Tc = 0.5 * (low + high);
    const StandardForm f = rules::simc_pi(p, Tc);
    (loop.Ms(f.Kc, f.Ti) < Ms ? high : low) = Tc;
  }
  return rules::simc_pi(p, high);
}

/// The integrals of each step over a window of time alone.
PiLoop within_window(PiLoop loop, const RulePlant& plant, double seconds) {
  loop.errors = [plant, seconds](double Kp, double Ti) {
    const auto m = reference::measure_in_units(rules::general_loop(plant, pi(Kp, Ti)), Horizon::fixed(seconds));
    return rules::PiErrors{m.measured.measures[Measure::IAE_w], m.measured.measures[Measure::IAE_d]};
  };
  return loop;
}

Numbers with_correction(const std::vector<double>& values, const std::vector<double>& corrected) {
  Numbers numbers{row(values, values.size())};
  for (std::size_t i = 0; i < corrected.size(); ++i) numbers[0][i].corrected = corrected[i];
  return numbers;
}

Numbers table2(const PublishedTable&) {
  const Distances d(rules::pi_loop(kUnit));
  return {row({d.of_cbar(2.5), d.of_cbar(2.7), d.of_cbar(4)})};
}

std::vector<double> beside_simc(const Distances& d, const LagDelayPlant& half) {
  return {d.of_cbar(2.5), d.of_cbar(2.7), d.of([&](double Ms) { return simc_of_sensitivity(d.loop, half, Ms); })};
}
/// The paper's own run of Table 8: hold of 0.1, output step at 0, input step at 140, end at 350.
PiLoop sampled_heater() {
  PiLoop loop = rules::pi_loop(kHeater);
  loop.errors = [plant = sampled_plant(kHeater, 0.1)](double Kp, double Ti) {
    constexpr std::size_t kInput = 1400, kEnd = 3500;
    const std::vector<double> error = sampled_run(plant, {Kp, Ti, 0}, 0, kInput, kEnd).error;
    rules::PiErrors sum{0, 0};
    for (std::size_t k = 1; k <= kEnd; ++k)
      (k <= kInput ? sum.IAE_vy : sum.IAE_vu) += plant.dt / 2 * (std::abs(error[k]) + std::abs(error[k - 1]));
    return sum;
  };
  return loop;
}
Numbers table7(const PublishedTable&) {
  return with_correction(beside_simc(Distances(rules::pi_loop(kHeater)), kHeater),
                         beside_simc(Distances(sampled_heater()), kHeater));
}
Numbers table9(const PublishedTable&) {
  const PiLoop loop = general_pi_loop(column(), kColumn);
  const LagDelayPlant half{34, 54.25, 0.75};
  return with_correction(beside_simc(Distances(loop), half),
                         beside_simc(Distances(within_window(loop, column(), 40)), half));
}

const Distances& submersible_distances() {
  static const Distances d(general_pi_loop(submersible(), kSubmersible));
  return d;
}
/// Corrected: windows of 125 s, and the weights of Table 12.
const Distances& submersible_windows() {
  static const Distances d(within_window(general_pi_loop(submersible(), kSubmersible), submersible(), 125),
                           Distances::Weights::of_front);
  return d;
}
Numbers table11(const PublishedTable&) {
  const auto of = [](const Distances& d) { return std::vector{d.of_cbar(2.5), d.of_cbar(2.7), d.of_cbar(4)}; };
  return with_correction(of(submersible_distances()), of(submersible_windows()));
}

/// zeta at a prescribed Ms: Ti stays, Kp falls with zeta.
StandardForm zeta_of_sensitivity(const PiLoop& loop, double Ms) {
  const auto form = [](double zeta) {
    return rules::delta_tuning({kSubmersible.k * zeta, kSubmersible.tau}, 2.7, 2.7);
  };
  double low = 0.2, high = 3;
  for (int i = 0; i < 60; ++i) {
    const double zeta = 0.5 * (low + high);
    const StandardForm f = form(zeta);
    (loop.Ms(f.Kc, f.Ti) < Ms ? high : low) = zeta;
  }
  return form(high);
}
Numbers table13(const PublishedTable&) {
  const auto of = [](const Distances& d) {
    return std::vector{d.of_cbar(2.5), d.of([&](double Ms) { return zeta_of_sensitivity(d.loop, Ms); })};
  };
  return with_correction(of(submersible_distances()), of(submersible_windows()));
}

}  // namespace

std::vector<Maker> dalen2018_distance_makers() {
  return {{"dalen2018/table2", table2},
          {"dalen2018/table7", table7},
          {"dalen2018/table9", table9},
          {"dalen2018/table11", table11},
          {"dalen2018/table13", table13}};
}

}  // namespace portrait::reproduce
