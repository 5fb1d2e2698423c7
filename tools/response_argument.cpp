#include "tools/response_argument.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/records/plant_fit.h"
#include "engine/records/record_areas.h"
#include "tools/arguments.h"

namespace portrait::tools {
namespace {

constexpr std::size_t kAreas = 10;  ///< enough for PID^3

records::Record record_in(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: {}", path, std::strerror(errno)));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return records::read_record(text, path);
}

void tell(const records::Quality& q, RecordedPlant& made) {
  made.found.insert(made.found.end(), {{"change_at", q.start},
                                       {"u_before", q.before_u},
                                       {"y_before", q.before_y},
                                       {"drift_before", q.drift},
                                       {"noise", q.noise}});
}

RecordedPlant fitted(const records::Record& record, Plant family, bool drift) {
  const records::PlantFit fit = records::fitted_plant(record, family, drift);
  RecordedPlant made;
  const RealPlant& p = fit.plant;
  made.plant = family == Plant::dipdt  ? rules::dipdt(p.K, p.Td)
               : family == Plant::ipdt ? rules::ipdt(p.K, p.Td)
                                       : rules::jotd(p.K, p.Td, p.T1, 1);
  made.found = {{"K", p.K}, {"Td", p.Td}};
  if (family == Plant::fotd) made.found.push_back({"T1", p.T1});
  made.found.insert(
      made.found.end(),
      {{"level", fit.level}, {"drift", fit.drift}, {"residual", fit.residual}, {"residual_share", fit.share}});
  tell(fit.quality, made);
  made.remarks = fit.remarks;
  return made;
}

RecordedPlant with_areas(const records::Record& record, bool integrating, double settled_from) {
  const records::RecordAreas found = integrating ? records::integrating_areas(record, kAreas, settled_from)
                                                 : records::self_regulating_areas(record, kAreas, settled_from);
  RecordedPlant made;
  made.plant.name = integrating ? "integrating" : "self-regulating";
  made.plant.integrators = integrating ? 1 : 0, made.plant.K = found.areas[0], made.plant.measured = found.areas;
  for (std::size_t i = 0; i < found.areas.size(); ++i)
    made.found.push_back({fmt::format("A_{}", i), found.areas[i]});
  made.found.push_back({"settled_from", found.settled_from});
  tell(found.quality, made);
  made.remarks = found.quality.remarks;
  return made;
}

RecordedPlant by_tangent(const records::Record& record) {
  const records::MeasuredReactionCurve curve = records::measured_reaction_curve(record);
  if (!(curve.lag > 0))
    throw InputError(
        "the steepest tangent of the record meets the initial level before the step: there is no dead time to tune "
        "by");
  RecordedPlant made;
  made.plant = rules::ipdt(curve.slope, curve.lag);
  made.found = {{"k", curve.slope}, {"tau", curve.lag}, {"window", curve.window}};
  tell(records::quality(record), made);
  return made;
}

}  // namespace

void add_response_options(CLI::App& verb, ResponseArguments& a) {
  verb.add_option("--response", a.file,
                  "a recorded response, CSV of t, u, y: the plant is fitted to it, or its areas are taken");
  verb.add_option("--settled-from", a.settled_from,
                  "time from which the record has settled (areas; without it: its last tenth)");
  verb.add_flag("--drift", a.drift, "y had a slope before the change already (fits)");
}

RecordedPlant recorded_plant(const ResponseArguments& a, const std::string& family) {
  const records::Record record = record_in(a.file);
  if (const auto known = plant_named(family)) return fitted(record, *known, a.drift);
  const double settled_from = a.settled_from.empty() ? kNaN : number_argument("--settled-from", a.settled_from);
  if (family == "self-regulating" || family == "integrating")
    return with_areas(record, family == "integrating", settled_from);
  if (family == "reaction-curve") return by_tangent(record);
  throw InputError(fmt::format(
      "--plant: with --response it is what to make of the record, and \"{}\" is none{}", family,
      suggestion(family, {"dipdt", "ipdt", "fotd", "self-regulating", "integrating", "reaction-curve"})));
}

}  // namespace portrait::tools
