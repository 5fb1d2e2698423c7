#include "portraits/query/measured.h"

#include "engine/sweep/method.h"
#include "grids/sweep_job.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

void measure_part(const Grid& grid, const QueryUnits& units, std::span<const Setting> settings,
                  std::span<Measured> into) {
  std::vector<SettingMeasured> found(settings.size());
  measure_settings(method_for(grid.measures), grid.family, grid.horizon, extras_for(grid), settings, found);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    into[i] = {settings[i], found[i].status, found[i].measures, units.plant};
    for (const Measure measure : grid.measures) into[i].measures[measure] *= factor(measure, units);
  }
}

double quantity_at(Quantity quantity, const Measured& measured) {
  if (const Measure* measure = std::get_if<Measure>(&quantity)) return measured.measures[*measure];
  if (const Parameter* parameter = std::get_if<Parameter>(&quantity)) return get(measured.setting, *parameter);
  return controller_value<double>(std::get<ControllerValue>(quantity), *measured.plant,
                                  [&](Parameter parameter) { return get(measured.setting, parameter); });
}

}  // namespace

std::vector<Measured> measure(const Grid& grid, const QueryUnits& units, std::span<const Setting> settings,
                              int threads) {
  std::vector<Measured> all(settings.size());
  in_parts(threads, settings.size(), kSettingsPerThread, [&](std::size_t begin, std::size_t end) {
    measure_part(grid, units, settings.subspan(begin, end - begin), std::span(all).subspan(begin, end - begin));
  });
  return all;
}

double value_at(const Expression& expression, const Measured& measured) {
  thread_local Columns columns;
  thread_local ColumnStack stack;
  thread_local std::vector<double> value;
  columns.count = 1;
  for (const Expression::Use& use : expression.uses())
    columns[use.quantity] = {quantity_at(use.quantity, measured)};
  expression.evaluate(columns, stack, value);
  return value[0];
}

}  // namespace portrait
