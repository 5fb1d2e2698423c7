/// store_rate [TILES [FOLDER]]
///
/// What storing a sweep costs, stage by stage, over tiles of 4096 settings with every measure: half of the columns
/// smooth but otherwise random, a quarter constant, a quarter NaN. First the file is read back and compared with
/// what went in. Then what each way of storing a chunk costs and gains, by how many of its values repeat the one
/// before.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "engine/base/memory.h"
#include "portraits/chunk_codec.h"
#include "portraits/digest.h"
#include "portraits/fletcher32.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "portraits/writer.h"

namespace portrait {
namespace {

using Clock = std::chrono::steady_clock;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Cost {
  double cpu = 0, wall = 0;
};

template <typename Work>
Cost cost_of(Work work) {
  const double cpu = cpu_seconds();
  const auto begin = Clock::now();
  work();
  return {cpu_seconds() - cpu, std::chrono::duration<double>(Clock::now() - begin).count()};
}

Grid grid_of(std::uint64_t tiles) {
  std::vector<double> rows(tiles), columns(kTileSettings);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = 0.05 + 0.001 * static_cast<double>(i);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = 6 + 0.01 * static_cast<double>(i);
  const auto all = standard_measures();
  return {.title = "store_rate",
          .family = {.plant = Plant::dipdt, .n = 1, .prefilter = Prefilter::full},
          .horizon = Horizon::fixed(51),
          .sampling = 0.1,
          .precision = Precision::real64,
          .measures = {all.begin(), all.end()},
          .axes = {Axis::list(Parameter::kappa, rows), Axis::list(Parameter::tau_i, columns)},
          .fixed = {{Parameter::delta, 0.7}, {Parameter::tau_f, 0.1}, {Parameter::b, 0}, {Parameter::c, 0}},
          .text = "# made by store_rate\n"};
}

/// Smooth over the tile, with a last half of the mantissa that nothing can foresee.
std::vector<double> smooth(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double phase = unit(random);
  std::vector<double> values(kTileSettings);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 2 + std::sin(phase + 0.003 * static_cast<double>(i)) + 1e-6 * unit(random);
  return values;
}

/// A few different tiles, to be stored over and over.
std::vector<MeasureColumns> sample_tiles(const Grid& grid) {
  std::mt19937_64 random(1);
  std::vector<MeasureColumns> tiles(8, MeasureColumns(grid.measures, kTileSettings));
  for (MeasureColumns& tile : tiles) {
    for (std::size_t k = 0; k < tile.values.size(); ++k) {
      if (k % 2 == 0) tile.values[k] = smooth(random);
      if (k % 4 == 1) tile.values[k].assign(kTileSettings, static_cast<double>(k));
    }
    tile.status.assign(kTileSettings, Status::settled);
  }
  return tiles;
}

void check_file(const std::filesystem::path& path, const std::vector<MeasureColumns>& tiles, const Grid& grid) {
  const PortraitReader portrait(path);
  std::vector<double> values;
  for (std::uint64_t tile = 0; tile < tiles.size(); ++tile)
    for (std::size_t k = 0; k < grid.measures.size(); ++k) {
      portrait.read(grid.measures[k], tile * kTileSettings, kTileSettings, values);
      if (std::memcmp(values.data(), tiles[tile].values[k].data(), values.size() * sizeof(double)) != 0)
        throw std::runtime_error(fmt::format("{} is not what was written", to_string(grid.measures[k])));
    }
}

void print_stage(const char* name, const Cost& cost, const Grid& grid) {
  const double settings = static_cast<double>(setting_count(grid));
  const double megabytes = settings * static_cast<double>(grid.measures.size()) * 8e-6;
  fmt::print("{:<34}{:>14.3f}{:>14.3f}{:>16.3f}{:>12.0f}\n", name, cost.cpu / settings * 1e6,
             cost.wall / settings * 1e6, cost.cpu / settings / static_cast<double>(grid.measures.size()) * 1e9,
             megabytes / cost.cpu);
}

void measure_stages(std::uint64_t tiles, const std::filesystem::path& folder) {
  const Grid grid = grid_of(tiles);
  const std::vector<MeasureColumns> samples = sample_tiles(grid);
  const std::filesystem::path path = folder / "store_rate.h5";
  PortraitWriter writer(path, grid, {"store_rate", "none"}, Existing::replace);
  Cost encode, write;
  const auto add = [](Cost& sum, const Cost& cost) { sum = {sum.cpu + cost.cpu, sum.wall + cost.wall}; };
  for (std::uint64_t tile = 0; tile < tiles; ++tile) {
    std::optional<EncodedTile> encoded;
    add(encode, cost_of([&] { encoded = writer.encode(tile, samples[tile % samples.size()]); }));
    add(write, cost_of([&] { writer.write(std::move(*encoded)); }));
  }
  const Cost publish = cost_of([&] { writer.publish({}); });
  const Cost verified = cost_of([&] { verify(path); });
  check_file(path, samples, grid);
  fmt::print(
      "{} settings, {} measures, {:.0f} MB of values, {:.0f} MB in the file\n\n{:<34}{:>14}{:>14}{:>16}{:>12}\n",
      setting_count(grid), grid.measures.size(),
      static_cast<double>(setting_count(grid) * grid.measures.size()) * 8e-6,
      static_cast<double>(std::filesystem::file_size(path)) * 1e-6, "stage", "CPU us/set.", "wall us/set.",
      "CPU ns/value", "MB/s");
  print_stage("encode (by the workers)", encode, grid);
  print_stage("write (by one at a time)", write, grid);
  print_stage("publish", publish, grid);
  print_stage("all", {encode.cpu + write.cpu + publish.cpu, encode.wall + write.wall + publish.wall}, grid);
  print_stage("(of publish: reading it all back)", verified, grid);
  std::filesystem::remove(path);
}

/// `repeating` of every 32 values are equal to the one before, in one run.
std::vector<std::byte> chunk_with(std::size_t repeating, std::mt19937_64& random) {
  std::vector<double> values = smooth(random);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % 32 < repeating && i > 0) values[i] = values[i - 1];
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

template <typename Work>
double microseconds_each(Work work) {
  constexpr int kTimes = 300;
  return cost_of([&] {
           for (int i = 0; i < kTimes; ++i) work();
         }).cpu /
         kTimes * 1e6;
}

/// As HDF5 does it itself.
std::vector<std::byte> shuffled_and_deflated(std::span<const std::byte> values) {
  std::vector<std::byte> shuffled(values.size()), stream(compressBound(values.size()));
  const std::size_t count = values.size() / 8;
  for (std::size_t byte = 0; byte < 8; ++byte)
    for (std::size_t i = 0; i < count; ++i) shuffled[byte * count + i] = values[i * 8 + byte];
  uLongf length = stream.size();
  if (compress2(reinterpret_cast<Bytef*>(stream.data()), &length, reinterpret_cast<const Bytef*>(shuffled.data()),
                shuffled.size(), 1) != Z_OK)
    throw std::runtime_error("zlib does not deflate");
  stream.resize(length);
  return stream;
}

void measure_chunks() {
  std::mt19937_64 random(2);
  fmt::print(
      "\na chunk of 4096 doubles, CPU us; plain: digest and checksum "
      "alone\n\n{:<10}{:>8}{:>10}{:>10}{:>8}{:>10}{:>10}{:>8}\n",
      "repeating", "plain", "runs", "back", "size", "zlib 1", "back", "size");
  for (const std::size_t repeating : {0U, 4U, 8U, 12U, 16U, 20U, 24U, 28U, 31U, 32U}) {
    const std::vector<std::byte> values = chunk_with(repeating, random);
    std::vector<std::byte> runs, back(values.size());
    std::uint64_t sink = 0;
    const double plain = microseconds_each([&] { sink += digest_of(values) + fletcher32(values); });
    const double ours = microseconds_each([&] { runs = deflated_chunk(values, 8); });
    const double ours_back = microseconds_each([&] { decode_chunk(runs, ChunkForm::deflated, 8, back); });
    if (back != values || sink == 0) throw std::runtime_error("a chunk does not come back");
    std::vector<std::byte> stream;
    const double theirs = microseconds_each([&] { stream = shuffled_and_deflated(values); });
    append_checksum(stream);
    const double theirs_back = microseconds_each([&] { decode_chunk(stream, ChunkForm::deflated, 8, back); });
    if (back != values) throw std::runtime_error("zlib's chunk does not come back");
    const auto part = [&](std::size_t size) {
      return static_cast<double>(size) / static_cast<double>(values.size());
    };
    fmt::print("{:>7}/32{:>8.1f}{:>10.1f}{:>10.1f}{:>8.2f}{:>10.1f}{:>10.1f}{:>8.2f}\n", repeating, plain, ours,
               ours_back, part(runs.size()), theirs, theirs_back, part(stream.size()));
  }
}

}  // namespace
}  // namespace portrait

int main(int count, char** words) try {
  portrait::keep_freed_memory();
  const std::uint64_t tiles = count > 1 ? std::strtoull(words[1], nullptr, 10) : 2000;
  portrait::measure_stages(tiles, count > 2 ? words[2] : ".");
  portrait::measure_chunks();
} catch (const std::exception& error) {
  fmt::print(stderr, "store_rate: {}\n", error.what());
  return 1;
}
