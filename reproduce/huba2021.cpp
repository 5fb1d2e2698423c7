/// The tables of Huba2021.

#include "reproduce/huba2021.h"

#include <cmath>

#include "engine/reference/measure.h"
#include "engine/rules/catalogue.h"
#include "engine/rules/half_rule.h"
#include "engine/rules/model_based.h"

namespace portrait::reproduce {
namespace {

using rules::RulePlant;

const std::vector<double> kFour(4, 1.0);

/// TV and what is left of it after the best m pulses: all of them here, for the points alternate about the end.
Numbers eq45(const PublishedTable&) {
  const std::vector<double> u{0, 1.68, 0.80, 1.05, 0.98, 1};
  double TV = 0;
  for (std::size_t i = 1; i < u.size(); ++i) TV += std::abs(u[i] - u[i - 1]);
  std::vector<double> values{TV};
  for (std::size_t m = 0; m <= 4; ++m) {
    // u_0, then m extremes, then the end; a shape with more extremes explains more.
    double shape = 0, last = u[0];
    for (std::size_t i = 1; i <= m; ++i) shape += std::abs(u[i] - last), last = u[i];
    values.push_back(TV - shape - std::abs(u.back() - last));
  }
  return {row(values, 6)};
}

Numbers models(const PublishedTable&) {
  Numbers numbers;
  for (const std::size_t kept : {1u, 2u}) {
    const rules::FewLags few = rules::half_rule(kFour, 0, kept);
    numbers.push_back(row({few.lags.front(), few.lags.back(), few.dead_time}));
  }
  for (const std::size_t kept : {1u, 2u, 3u}) {
    const rules::FewLags few = rules::modified_half_rule(kFour, 0, kept);
    numbers.push_back(row({few.lags.front(), few.lags.back(), few.dead_time}));
  }
  return numbers;
}

double found(const rules::Tuned& t, std::string_view name) {
  for (const rules::Finding& f : t.findings)
    if (f.name == name) return f.value;
  return kNaN;
}

rules::Tuned by(const char* rule, const RulePlant& plant, const std::map<std::string, std::string>& options) {
  return rules::tune(rules::rule_named(rule), plant, options);
}

Numbers simc(const PublishedTable&) {
  const RulePlant plant = lag_plant(1, kFour, 0);
  const rules::Tuned spi = by("simc-pi", plant, {}), spid = by("simc-pid", plant, {});
  return {row({spi.pid->Kc, spi.pid->Ti, 0}),
          row({found(spid, "series_Kc"), found(spid, "series_Ti"), found(spid, "series_TD")})};
}

Numbers example1(const PublishedTable&) {
  const RulePlant plant = rules::jotd(1, 1, 1, 1);
  Numbers numbers;
  for (const auto& [Tc, Tf, quotient] : {std::tuple{"0.7", "0.1", "pade1"}, {"0.5", "0.15", "pade2"}}) {
    const rules::Tuned t = by("huba2021-jrm", plant, {{"Tc", Tc}, {"Tf", Tf}, {"n", "2"}, {"dead-time", quotient}});
    const double Td = found(t, "Td_used"), T1 = found(t, "Tj"), sum = found(t, "Tc") + Td;
    // Corrected: K_c with the identified T_1m = 1 in place of T_1, T_i as it is, and the 12 s that Figure 6 shows.
    rules::Tuned slower = t;
    for (double& a : slower.controller.numerator) a /= T1;
    const double IAE = reference::measure_in_units(rules::general_loop(plant, slower), Horizon::fixed(12))
                           .measured.measures[Measure::IAE_d];
    numbers.push_back({{rules::measured(plant, t).measures[Measure::IAE_d], IAE}, {sum, T1 * sum}});
  }
  return numbers;
}

// ---------------------------------------------------------------- Example 6

constexpr double kTf = 0.1;

/// The modified half rule to j lags, half of the filter's n Tf to them, half to the dead time; Tc = Tc_factor Td. With all
/// four lags kept Td is 0.2 T4 and the filter's half.                                              [Huba2021 (92), (99)]
Designed model_based(int j, int n, double Tc_factor, int prefilter_order) {
  const rules::FewLags few = rules::modified_half_rule(kFour, 0, static_cast<std::size_t>(j));
  const double T = few.lags[0] + n * kTf / (2 * j);
  const rules::LagPlant p{j, 1, T, (j == 4 ? 0.2 * T : few.dead_time) + n * kTf / 2};
  rules::Tuned t;
  t.controller = rules::model_based_controller(p, Tc_factor * p.Td, rules::DeadTimeQuotient::taylor);
  t.n = n, t.Tf = kTf;
  t.other_prefilter = rules::smooth_prefilter(p, prefilter_order);
  return {t, p.Tj, p.Td};
}

/// SIMC with its filter, and 1/(T1 s + 1) as prefilter.                                            [Huba2021 (99)]
Designed simc_filtered(const char* rule, const char* n, const char* Tc) {
  rules::Tuned t = by(rule, lag_plant(1, kFour, 0), {{"Tf", "0.1"}, {"n", n}, {"Tc", Tc}});
  if (std::string_view(rule) == "simc-pid") {
    // The series controller has its own fast filter T_D/100 besides Q_2.
    t.controller.denominator = product(t.controller.denominator, {1, 0.01});
    t.pid.reset();
  }
  const double T1 = 1.5, Td = found(t, "tau");
  t.other_prefilter = rules::Quotient{{1}, {1, T1}};
  return {t, T1, Td};
}

}  // namespace

rules::RulePlant example6_plant() { return lag_plant(1, kFour, 0); }

std::vector<Designed> example6() {
  return {simc_filtered("simc-pi", "1", "5.2"),
          simc_filtered("simc-pid", "2", "1.7"),
          model_based(1, 1, 2, 1),
          model_based(2, 2, 1, 2),
          model_based(3, 4, 1, 3),
          model_based(4, 6, 1, 2)};
}

/// The two loops that (99) states otherwise than they were simulated. SPID: Td = 1.5 + Tf, Tc = 2 Td, as SPI and 1PI have
/// it; only Tc + Td = 4.8 matters, which the rule, counting 1.5 + 2 Tf, makes with Tc = 3.1. 3PIDA: the prefilter of
/// Example 5, of order 2.
std::vector<Designed> example6_corrected() {
  std::vector<Designed> loops = example6();
  loops[1] = simc_filtered("simc-pid", "2", "3.1");
  loops[4] = model_based(3, 4, 1, 2);
  return loops;
}

namespace {

Numbers eq99(const PublishedTable&) {
  Numbers numbers;
  for (const Designed& d : example6()) numbers.push_back(row({d.T, d.Td}));
  // Corrected: the lag of (91) as it is printed there, rounded.
  const double kept = rules::modified_half_rule(kFour, 0, 3).lags[0];
  numbers[4][0].corrected = std::round(kept * 1e4) / 1e4 + 4 * kTf / 6;
  return numbers;
}

Numbers errors(Measure measure) {
  const auto loops = example6(), corrected = example6_corrected();
  const auto error = [&](const Designed& d) {
    return rules::measured(example6_plant(), d.tuned).measures[measure];
  };
  Numbers numbers(1);
  for (std::size_t i = 0; i < loops.size(); ++i)
    numbers[0].push_back({error(loops[i]), i == 1 || i == 4 ? std::optional(error(corrected[i])) : std::nullopt});
  return numbers;
}
Numbers table1(const PublishedTable&) { return errors(Measure::IAE_w); }
Numbers table2(const PublishedTable&) { return errors(Measure::IAE_d); }

/// J_k = IAE^k TV from the paper's own columns.
Numbers products(const std::vector<double>& IAE, const std::vector<double>& TV_u, const std::vector<double>& TV_y,
                 double y_unit) {
  std::array<std::vector<double>, 4> r;
  for (std::size_t i = 0; i < IAE.size(); ++i) {
    r[0].push_back(IAE[i] * TV_u[i]), r[1].push_back(IAE[i] * TV_y[i] * y_unit * 100);
    r[2].push_back(std::pow(IAE[i], 5) * TV_u[i] * 1e-5), r[3].push_back(std::pow(IAE[i], 5) * TV_y[i] * y_unit);
  }
  Numbers numbers;
  for (const auto& values : r) numbers.push_back(row(values, values.size()));
  return numbers;
}
Numbers table1_products(const PublishedTable&) {
  return products({9.3005, 6.3096, 7.2040, 6.4126, 5.2836, 4.7447},
                  {3.9871, 13.5908, 12.7076, 1.8372, 1.8740, 3.9900},
                  {1.3649, 5.5289, 3.4414, 8.7998, 13.5847, 22.1266}, 1e-3);
}
Numbers table2_products(const PublishedTable&) {
  const auto of = [](double y_unit) {
    return products({7.8032, 4.8093, 4.6555, 3.3136, 2.8161, 2.5935},
                    {3.9458, 13.4804, 12.6906, 1.7935, 1.7950, 3.8461},
                    {0.0428, 2.4693, 1.9083, 18.7217, 8.5841, 15.8702}, y_unit);
  };
  Numbers numbers = of(1e-2);
  const Numbers corrected = of(1e-3);
  for (std::size_t r = 0; r < numbers.size(); ++r)
    for (std::size_t c = 0; c < numbers[r].size(); ++c) numbers[r][c].corrected = corrected[r][c].as_printed;
  return numbers;
}

}  // namespace

std::vector<Maker> huba2021_makers() {
  return {{"huba2021/eq45", eq45},
          {"huba2021/models", models},
          {"huba2021/simc", simc},
          {"huba2021/example1", example1},
          {"huba2021/eq99", eq99},
          {"huba2021/table1", table1},
          {"huba2021/noise-light", example6_light_noise},
          {"huba2021/noise-filtered", example6_filtered_noise},
          {"huba2021/table1-products", table1_products},
          {"huba2021/table2", table2},
          {"huba2021/table2-products", table2_products}};
}

}  // namespace portrait::reproduce
