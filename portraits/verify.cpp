#include "portraits/verify.h"

#include <cstdint>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/facts.h"
#include "portraits/open_portrait.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/stored_column.h"
#include "portraits/stored_grid.h"

namespace portrait {
namespace {

void check_values(StoredColumn& column, const TileRows& rows) {
  Digest whole;
  for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile) whole.add(column.tile(tile));
  const h5::Dataset& dataset = column.dataset();
  if (digest_text(whole.value()) != dataset.text(schema::kDigest))
    throw IntegrityError(fmt::format("{}: {} holds other values than were written (its digest differs)",
                                     dataset.origin().file, dataset.name()));
}

CheckedDataset checked_column(const h5::File& file, const Grid& grid, const std::string& name,
                              h5::Element element) {
  CheckedDataset checked{name, "", ""};
  try {
    const TileRows rows(grid);
    StoredColumn column(file, name, element, rows);
    checked.digest = column.dataset().text(schema::kDigest);
    check_values(column, rows);
  } catch (const IntegrityError& error) {
    checked.problem = error.what();
  }
  return checked;
}

}  // namespace

VerifyReport inspect(const std::filesystem::path& path) {
  const h5::File file = open_portrait(path);
  const Grid grid = read_grid(file);
  read_facts(file);
  VerifyReport report;
  const auto add_parameter = [&](Parameter parameter) {
    const std::string name(to_string(parameter));
    report.datasets.push_back({name, file.dataset(name).text(schema::kDigest), ""});
  };
  for (const Axis& axis : grid.axes) add_parameter(axis.parameter());
  for (const FixedParameter& fixed : grid.fixed) add_parameter(fixed.parameter);
  for (const Measure measure : grid.measures)
    report.datasets.push_back(
        checked_column(file, grid, std::string(to_string(measure)), schema::element_of(grid.precision)));
  report.datasets.push_back(checked_column(file, grid, schema::kStatus, h5::Element::uint8));
  read_row_of_uint64(file, schema::tile_digests_of(schema::kTile));
  return report;
}

VerifyReport verify(const std::filesystem::path& path) {
  VerifyReport report = inspect(path);
  std::string problems;
  for (const CheckedDataset& dataset : report.datasets)
    if (!dataset.problem.empty()) problems += (problems.empty() ? "" : "\n") + dataset.problem;
  if (!problems.empty()) throw IntegrityError(problems);
  return report;
}

}  // namespace portrait
