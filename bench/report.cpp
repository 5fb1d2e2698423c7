#include "bench/report.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace portrait::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Code {
  const char* name;
  const char* text;
  double Proof::*error;
};

constexpr Code kCodes[] = {{"engine", "engine", &Proof::engine},
                           {"responses", "responses alone", &Proof::engine},
                           {"margins", "margins alone", &Proof::engine},
                           {"batched", "RK4 1/50, batched", &Proof::batched},
                           {"scalar", "RK4 1/1000, scalar", &Proof::scalar}};

struct Sweep {
  const char* name;
  const char* text;
  const char* compared_to;
};

constexpr Sweep kSweeps[] = {{"scaling/one", "one thread", "scaling/one"},
                             {"scaling/all", "all threads", "scaling/one"},
                             {"store/nowhere", "all threads, stores nothing", "store/nowhere"},
                             {"store/file", "all threads, writes a portrait", "store/nowhere"}};

/// "1 234 567"
std::string grouped(double value) {
  std::string text = fmt::format("{:.0f}", value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ' ');
  return text;
}

/// Three digits, and no exponent.
std::string three_digits(double value) {
  const int decimals = value >= 100 ? 0 : value >= 10 ? 1 : 2;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string rate_row(const ProvedCase& of, const Code& code, const Results& results) {
  const std::string name = of.name + "/" + code.name;
  if (!results.has(name)) return {};
  const double rate = results.median(name);
  const auto ratio = results.ratio(of.name + "/engine", name);
  return fmt::format("{:<16}{:<20}{:>12}{:>14}{:>8.0f} %{:>12}{:>12.0e}\n", of.name, code.text, grouped(rate),
                     grouped(1e9 / rate), 100 * results.spread(name), ratio ? three_digits(*ratio) : "",
                     of.proof.*code.error);
}

std::string rate_table(const Report& report, const Results& results) {
  std::string rows;
  for (const ProvedCase& of : report.cases)
    for (const Code& code : kCodes) rows += rate_row(of, code, results);
  if (rows.empty()) return {};
  return fmt::format("\n{:<16}{:<20}{:>12}{:>14}{:>10}{:>12}{:>12}\n", "one core", "", "settings/s", "ns/setting",
                     "spread", "engine is x", "worst error") +
         rows;
}

std::string sweep_table(const Report& report, const Results& results) {
  std::string rows;
  for (const Sweep& sweep : kSweeps)
    if (results.has(sweep.name))
      rows += fmt::format("{:<36}{:>12}{:>14}{:>8.0f} %{:>12}\n", sweep.text, grouped(results.median(sweep.name)),
                          "", 100 * results.spread(sweep.name),
                          three_digits(results.ratio(sweep.name, sweep.compared_to).value_or(NAN)));
  if (rows.empty()) return {};
  return fmt::format("\n{:<36}{:>12}{:>14}{:>10}{:>12}\n",
                     fmt::format("sweep ({}), by the clock", report.sweep_method), "settings/s", "", "spread",
                     "ratio") +
         rows;
}

std::string peak_table(const Report& report, const Results& results) {
  std::string rows;
  for (const std::string& set : report.peaks)
    if (results.has("peak/" + set))
      rows += fmt::format("{:<36}{:>12.1f}{:>14}{:>8.0f} %\n", set, results.median("peak/" + set) / 1e9, "",
                          100 * results.spread("peak/" + set));
  if (rows.empty()) return {};
  return fmt::format("\n{:<36}{:>12}{:>14}{:>10}\n", "multiply and add, one core", "GFLOP/s", "", "spread") + rows;
}

/// Part of the chosen instruction set's peak that the kernel reaches.
std::optional<double> share_of_peak(const ProvedCase& of, const Report& report, const Results& results) {
  const std::string peak = "peak/" + report.instruction_set, name = of.name + "/engine";
  if (!results.has(peak) || !results.has(name)) return std::nullopt;
  return of.flops * results.median(name) / results.median(peak);
}

std::string share_table(const Report& report, const Results& results) {
  std::string rows;
  for (const ProvedCase& of : report.cases)
    if (const auto share = share_of_peak(of, report, results))
      rows += fmt::format("{:<36}{:>12}{:>24.1f} %\n", of.name, grouped(of.flops), 100 * *share);
  if (rows.empty()) return {};
  return fmt::format("\n{:<36}{:>12}{:>26}\n", "engine", "flop/setting", "of peak") + rows;
}

Json number(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

Json rate_json(const ProvedCase& of, const Code& code, const Results& results) {
  const std::string name = of.name + "/" + code.name;
  const double rate = results.median(name);
  return {{"case", of.name},
          {"code", code.name},
          {"settings_per_second", rate},
          {"ns_per_setting", 1e9 / rate},
          {"spread", results.spread(name)},
          {"engine_ratio", number(results.ratio(of.name + "/engine", name))},
          {"worst_error", of.proof.*code.error}};
}

}  // namespace

std::string table(const Report& report, const Results& results) {
  return fmt::format("{}, instruction set {}, {} threads; medians of {} interleaved repetitions\n", report.program,
                     report.instruction_set, report.threads, report.repetitions) +
         rate_table(report, results) + share_table(report, results) + sweep_table(report, results) +
         peak_table(report, results);
}

Json json(const Report& report, const Results& results) {
  Json rates = Json::array(), sweeps = Json::array(), peaks = Json::object(), kernel = Json::array();
  for (const ProvedCase& of : report.cases)
    kernel.push_back({{"case", of.name},
                      {"flops_per_setting", of.flops},
                      {"share_of_peak", number(share_of_peak(of, report, results))}});
  for (const ProvedCase& of : report.cases)
    for (const Code& code : kCodes)
      if (results.has(of.name + "/" + code.name)) rates.push_back(rate_json(of, code, results));
  for (const Sweep& sweep : kSweeps)
    if (results.has(sweep.name))
      sweeps.push_back({{"sweep", sweep.name},
                        {"settings_per_second", results.median(sweep.name)},
                        {"spread", results.spread(sweep.name)},
                        {"compared_to", sweep.compared_to},
                        {"ratio", number(results.ratio(sweep.name, sweep.compared_to))}});
  for (const std::string& set : report.peaks)
    if (results.has("peak/" + set)) peaks[set] = results.median("peak/" + set);
  return {{"program", report.program},
          {"instruction_set", report.instruction_set},
          {"threads", report.threads},
          {"repetitions", report.repetitions},
          {"sweep_method", report.sweep_method},
          {"rates", rates},
          {"kernel", kernel},
          {"sweeps", sweeps},
          {"flops_per_second_at_peak", peaks}};
}

}  // namespace portrait::bench
