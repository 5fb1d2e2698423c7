#include "portraits/verify.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <future>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/facts.h"
#include "portraits/open_portrait.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/stored_column.h"
#include "portraits/stored_grid.h"
#include "portraits/tile_summary.h"

namespace portrait {
namespace {

/// A query trusts a summary in place of the values, so the two must agree.
void check_summary(const h5::Dataset& dataset, std::span<const std::byte> values, std::span<const double> kept,
                   std::uint64_t tile) {
  const std::vector<double> found = dataset.name() == schema::kStatus
                                        ? status_summary(values)
                                        : range_summary(values, h5::size_of(dataset.layout().element));
  if (!std::equal(found.begin(), found.end(), kept.begin(), kept.end()))
    throw IntegrityError(fmt::format("{}: {} does not fit the values of tile {}", dataset.origin().file,
                                     schema::tile_summaries_of(dataset.name()), tile));
}

/// Of every tile, then of the tiles' digests.
void check_values(StoredColumn& column, const TileRows& rows, const std::string& digest,
                  const std::vector<double>& summaries) {
  Digest whole;
  const std::size_t numbers = summaries.size() / rows.tile_count();
  for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile) {
    const auto values = column.tile(tile);
    const std::uint64_t of_tile = column.digest(tile);
    whole.add(std::as_bytes(std::span(&of_tile, 1)));
    if (numbers > 0)
      check_summary(column.dataset(), values, std::span(summaries).subspan(tile * numbers, numbers), tile);
  }
  const h5::Dataset& dataset = column.dataset();
  if (digest_text(whole.value()) != digest)
    throw IntegrityError(fmt::format("{}: {} holds other values than were written (its digest differs)",
                                     dataset.origin().file, dataset.name()));
}

/// A measure or the status on its way to a CheckedDataset. HDF5 opens and closes it on one thread, any may check
/// it.
class ColumnCheck {
 public:
  ColumnCheck(const h5::File& file, const TileRows& rows, const std::string& name, h5::Element element)
      : rows_(&rows), result_{name, "", ""} {
    noting_problems([&] {
      column_.emplace(file, name, element, rows);
      result_.digest = column_->dataset().text(schema::kDigest);
      const std::size_t numbers = element == h5::Element::uint8 ? StatusCounts{}.size() : kRangeNumbers;
      summaries_ = StoredColumn::summaries(file, name, numbers, rows);
    });
  }

  void run() {
    if (result_.problem.empty())
      noting_problems([&] { check_values(*column_, *rows_, result_.digest, summaries_); });
  }
  const CheckedDataset& result() const { return result_; }

 private:
  template <typename Work>
  void noting_problems(Work work) {
    try {
      work();
    } catch (const IntegrityError& error) {
      result_.problem = error.what();
    }
  }

  const TileRows* rows_;
  std::optional<StoredColumn> column_;
  std::vector<double> summaries_;
  CheckedDataset result_;
};

void run_all(std::vector<ColumnCheck>& checks, int threads) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < checks.size(); k = next++) checks[k].run();
  };
  const auto count = static_cast<std::size_t>(
      threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
  std::vector<std::future<void>> others;
  while (others.size() + 1 < std::min(count, checks.size())) others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
}

}  // namespace

VerifyReport inspect(const std::filesystem::path& path, int threads) {
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
  const TileRows rows(grid);
  std::vector<ColumnCheck> checks;
  for (const Measure measure : grid.measures)
    checks.emplace_back(file, rows, std::string(to_string(measure)), schema::element_of(grid.precision));
  checks.emplace_back(file, rows, schema::kStatus, h5::Element::uint8);
  run_all(checks, threads);
  for (const ColumnCheck& check : checks) report.datasets.push_back(check.result());
  read_row_of_uint64(file, schema::tile_digests_of(schema::kTile));
  return report;
}

VerifyReport verify(const std::filesystem::path& path, int threads) {
  VerifyReport report = inspect(path, threads);
  std::string problems;
  for (const CheckedDataset& dataset : report.datasets)
    if (!dataset.problem.empty()) problems += (problems.empty() ? "" : "\n") + dataset.problem;
  if (!problems.empty()) throw IntegrityError(problems);
  return report;
}

}  // namespace portrait
