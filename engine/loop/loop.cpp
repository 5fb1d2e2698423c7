#include "engine/loop/loop.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {
namespace {

template <typename Names>
std::optional<std::size_t> index_of(const Names& names, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return i;
  return std::nullopt;
}

std::string must(std::string_view name, std::string_view rule, double value) {
  return fmt::format("{} must be {} (it is {})", name, rule, number_text(value));
}

bool finite_above_zero(double x) { return std::isfinite(x) && x > 0; }

std::optional<std::string> why_controller_invalid(const Setting& s) {
  if (!finite_above_zero(s.kappa)) return must("kappa", "finite and above 0", s.kappa);
  if (!(s.tau_i > 0)) return must("tau_i", "above 0, or inf for no integral action", s.tau_i);
  if (!std::isfinite(s.delta) || s.delta < 0) return must("delta", "finite and not below 0", s.delta);
  return std::nullopt;
}

std::optional<std::string> why_gains_invalid(const LoopFamily& family, const Setting& s) {
  for (int i = 0; i <= kMaxGainOrder + 1; ++i) {
    const double K = s.gains[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("K_{}", i - 1);
    if (!std::isfinite(K)) return must(name, "finite", K);
    if (i <= 1 && K < 0) return must(name, "not below 0", K);
    if (i > family.m + 1 && K != 0) return must(name, fmt::format("0 beyond K_{}", family.m), K);
  }
  if (s.gains[0] == 0 && s.gains[1] == 0) return "K_0 must be above 0 where K_-1 is 0: at rest nothing would act";
  if (s.kappa != 0 || s.delta != 0) return "kappa and delta have no place beside gains";
  return std::nullopt;
}

/// F must be proper: a setpoint step through an improper prefilter is an impulse.
std::optional<std::string> why_prefilter_invalid(Prefilter prefilter, const Setting& s) {
  if (!std::isfinite(s.b)) return must("b", "finite", s.b);
  if (!std::isfinite(s.c)) return must("c", "finite", s.c);
  const bool derivative = s.delta > 0;
  if (prefilter == Prefilter::none && (s.b != 0 || s.c != 0))
    return "b and c belong to a prefilter: with prefilter = \"none\" both must be 0";
  if (prefilter == Prefilter::pi && s.c != 0)
    return must("c", "0 with prefilter = \"pi\", whose numerator is 1 + b tau_i s", s.c);
  if (prefilter != Prefilter::full) return std::nullopt;
  if (s.c != 0 && !(derivative && has_integral_action(s)))
    return must("c", "0 without both integral and derivative action, or the prefilter is improper", s.c);
  if (s.b != 0 && !derivative && !has_integral_action(s))
    return must("b", "0 without integral and derivative action, or the prefilter is improper", s.b);
  return std::nullopt;
}

double digits_from_one(double x) { return x == 0 || !std::isfinite(x) ? 0 : std::abs(std::log10(std::abs(x))); }

/// |N|^2 and |D|^2 are polynomials whose coefficients double has to hold.
std::optional<std::string> why_out_of_range(const Loop& loop) {
  constexpr double kMostDigits = 140;
  const Setting& s = loop.setting;
  const PlantLags lags = plant_lags(loop);
  double digits = std::max({digits_from_one(s.tau_i), digits_from_one(s.b), digits_from_one(s.c)});
  for (const double gain : gains_of(loop)) digits = std::max(digits, digits_from_one(gain));
  digits += loop.family.n * digits_from_one(s.tau_f) + lags.count * digits_from_one(lags.time);
  if (digits <= kMostDigits) return std::nullopt;
  return "its gains and times lie too far from 1, or in too high an order, to compute with";
}

}  // namespace

std::optional<Plant> plant_named(std::string_view name) {
  if (const auto i = index_of(kPlantNames, name)) return static_cast<Plant>(*i);
  return std::nullopt;
}

std::optional<Prefilter> prefilter_named(std::string_view name) {
  if (const auto i = index_of(kPrefilterNames, name)) return static_cast<Prefilter>(*i);
  return std::nullopt;
}

std::array<double, kMaxGainOrder + 2> gains_of(const Loop& loop) {
  const Setting& s = loop.setting;
  if (has_gains(loop.family)) return s.gains;
  return {has_integral_action(s) ? s.kappa / s.tau_i : 0, s.kappa, s.delta};
}

std::optional<std::string> why_invalid(const LoopFamily& family) {
  if (family.n < 0 || family.n > kMaxFilterOrder)
    return fmt::format("n must be 0 .. {} (it is {})", kMaxFilterOrder, family.n);
  if (family.plant == Plant::jotd && (family.j < 1 || family.j > kMaxPlantOrder))
    return fmt::format("j must be 1 .. {} (it is {})", kMaxPlantOrder, family.j);
  if (!has_gains(family)) return std::nullopt;
  if (family.m > kMaxGainOrder) return fmt::format("gains go up to K_{} (here to K_{})", kMaxGainOrder, family.m);
  if (family.n < family.m)
    return fmt::format("gains up to K_{} need a filter of order n >= {} (n is {})", family.m, family.m, family.n);
  if (family.prefilter != Prefilter::none)
    return fmt::format("prefilter \"{}\" is made of a PID controller's times: beside gains it must be \"none\"",
                       to_string(family.prefilter));
  return std::nullopt;
}

std::optional<std::string> why_invalid(const Loop& loop) {
  const Setting& s = loop.setting;
  if (auto reason = why_invalid(loop.family)) return reason;
  if (auto reason = has_gains(loop.family) ? why_gains_invalid(loop.family, s) : why_controller_invalid(s))
    return reason;
  if (loop.family.plant == Plant::fotd && !finite_above_zero(s.tau_1))
    return must("tau_1", "finite and above 0", s.tau_1);
  if (loop.family.plant == Plant::jotd && !finite_above_zero(s.tau_j))
    return must("tau_j", "finite and above 0", s.tau_j);
  if (loop.family.n >= 1 && !finite_above_zero(s.tau_f)) return must("tau_f", "finite and above 0", s.tau_f);
  if (auto reason = why_prefilter_invalid(loop.family.prefilter, s)) return reason;
  return why_out_of_range(loop);
}

}  // namespace portrait
