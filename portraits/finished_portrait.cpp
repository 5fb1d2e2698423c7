#include "portraits/finished_portrait.h"

#include <fstream>
#include <string>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/open_portrait.h"
#include "portraits/output_column.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/stored_column.h"
#include "portraits/stored_grid.h"

namespace portrait {
namespace {

/// For programs that know NeXus: what to plot over what.
void write_nexus(const h5::File& file, const Grid& grid) {
  if (grid.measures.empty()) return;
  file.set_text("NX_class", "NXdata");
  file.set_text("signal", std::string(to_string(grid.measures.front())));
  std::vector<std::string> axes;
  for (const Axis& axis : grid.axes) axes.emplace_back(axis.name());
  if (!axes.empty()) file.set_texts("axes", axes);
}

/// Closed without a word when making it fails: the failure is what the caller hears of.
class FileInTheMaking {
 public:
  FileInTheMaking(const std::filesystem::path& path, std::uint64_t end)
      : file(h5::File::create_behind(path, end)) {}
  ~FileInTheMaking() {
    if (closed_) return;
    try {
      file.abandon();
    } catch (const StoreError&) {
    }
  }
  FileInTheMaking(const FileInTheMaking&) = delete;
  FileInTheMaking& operator=(const FileInTheMaking&) = delete;

  void close() {
    file.close();
    closed_ = true;
  }

  h5::File file;

 private:
  bool closed_ = false;
};

std::vector<OutputColumn> create_columns(const h5::File& file, const Grid& grid) {
  std::vector<OutputColumn> columns;
  for (const Measure measure : grid.measures) columns.push_back(OutputColumn::of_measure(file, grid, measure));
  columns.push_back(OutputColumn::of_status(file, grid));
  return columns;
}

/// Where the tiles lie in the grid, and their next chunks in the file: they are gone through column by column, as HDF5 keeps
/// its indices.
struct Places {
  std::vector<std::vector<std::uint64_t>> starts;  ///< first index along each axis
  std::vector<std::uint64_t> addresses;
};

Places places_of(const TileRows& rows, const std::vector<TileRecord>& tiles) {
  Places places;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    places.starts.push_back(rows.box(i).start);
    places.addresses.push_back(tiles[i].address);
  }
  return places;
}

void enter_tiles(std::vector<OutputColumn>& columns, Places places, const std::vector<TileRecord>& tiles) {
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const ChunkRecord& chunk = tiles[i].chunks[k];
      columns[k].enter(places.starts[i], chunk, places.addresses[i]);
      places.addresses[i] += chunk.length;
    }
}

void write_all(const h5::File& file, const Grid& grid, const Provenance& provenance, const RunFacts& facts,
               const Places& places, const std::vector<TileRecord>& tiles) {
  file.set_text("Conventions", "CF-1.10");
  file.set_text("title", grid.title);
  write_provenance(file, provenance);
  write_grid(file, grid);
  write_nexus(file, grid);
  std::vector<OutputColumn> columns = create_columns(file, grid);
  enter_tiles(columns, places, tiles);
  const OutputColumn::TileScales scales = OutputColumn::create_tile_scales(file, tiles.size());
  for (const OutputColumn& column : columns) column.finish(file, scales);
  write_run_facts(file, facts);
}

// ---------------------------------------------------------------- as a reader sees it

void check_column(const h5::File& file, const std::string& name, h5::Element element, const TileRows& rows,
                  const std::vector<TileRecord>& tiles, std::size_t k, Places& places) {
  const StoredColumn column(file, name, element, rows);
  std::vector<double> summaries;
  for (const TileRecord& tile : tiles)
    summaries.insert(summaries.end(), tile.chunks[k].summary.begin(), tile.chunks[k].summary.end());
  const std::size_t numbers = tiles.front().chunks[k].summary.size();
  if (StoredColumn::summaries(file, name, numbers, rows) != summaries) throw IntegrityError(name + " has other summaries of its tiles");
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const ChunkRecord& chunk = tiles[i].chunks[k];
    if (column.digest(i) != chunk.digest) throw IntegrityError(name + " has another digest of a tile");
    const h5::ChunkPlace place{places.addresses[i], chunk.length, chunk.form};
    places.addresses[i] += chunk.length;
    if (rows.extent().empty()) continue;  // no chunk but a number, which was read with its digest
    if (column.dataset().place_of_chunk(places.starts[i]) != place)
      throw IntegrityError(fmt::format("{} has the chunk of tile {} elsewhere", name, i));
  }
}

void check_as_reader(const std::filesystem::path& path, const Grid& grid, Places places,
                     const std::vector<TileRecord>& tiles) {
  const h5::File file = open_portrait(path);
  read_grid(file);
  read_facts(file);
  read_row_of_uint64(file, schema::tile_digests_of(schema::kTile));
  const TileRows rows(grid);
  std::size_t k = 0;
  for (const Measure measure : grid.measures)
    check_column(file, std::string(to_string(measure)), schema::element_of(grid.precision), rows, tiles, k++,
                 places);
  check_column(file, schema::kStatus, h5::Element::uint8, rows, tiles, k, places);
}

}  // namespace

void finish_portrait(const std::filesystem::path& path, std::uint64_t end, const Grid& grid,
                     const Provenance& provenance, const RunFacts& facts, const std::vector<TileRecord>& tiles) {
  const TileRows rows(grid);
  PORTRAIT_CHECK_EQ(std::uint64_t{tiles.size()}, rows.tile_count());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    PORTRAIT_CHECK_EQ(tiles[i].number, std::uint64_t{i});
    PORTRAIT_CHECK_EQ(tiles[i].chunks.size(), grid.measures.size() + 1);
  }
  const Places places = places_of(rows, tiles);
  FileInTheMaking making(path, end);
  write_all(making.file, grid, provenance, facts, places, tiles);
  making.close();
  try {
    check_as_reader(path, grid, places, tiles);
  } catch (const IntegrityError& error) {
    throw StoreError(fmt::format("{}: it does not read back as written: {}", path.string(), error.what()));
  }
}

}  // namespace portrait
