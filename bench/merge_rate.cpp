/// merge_rate [SETTINGS [FOLDER]]
///
/// How fast two shards of a grid become one portrait and how fast that is verified, in MB/s of the file, how fast the
/// program exports it, in MB/s of the table, and in how much memory. Values are made up: half of the columns smooth but
/// otherwise random, a quarter constant, a quarter NaN. Each step runs in a process of its own, so that its peak is its own.
/// The merged file is compared with what went in, and the tables' numbers of rows with what they must be.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/memory.h"
#include "engine/base/version.h"
#include "grids/grid_file.h"
#include "portraits/merge.h"
#include "portraits/reader.h"
#include "portraits/run_writer.h"
#include "portraits/verify.h"

namespace portrait {
namespace {

constexpr std::uint64_t kRow = kTileSettings;
constexpr int kShards = 2;

Grid grid_of(std::uint64_t settings) {
  return parse_grid(fmt::format("plant = \"dipdt\"\nn = 1\nhorizon = 51\n[parameters]\n"
                                "kappa = {{ from = 0.05, to = 0.35, count = {} }}\n"
                                "tau_i = {{ from = 6, to = 40, count = {} }}\ndelta = 0.7\ntau_f = 0.1\n",
                                std::max<std::uint64_t>(2, settings / kRow), kRow),
                    "merge_rate");
}

/// A few different tiles, to be stored over and over.
std::vector<MeasureColumns> sample_tiles(const Grid& grid) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<MeasureColumns> tiles(8, MeasureColumns(grid.measures, kRow));
  for (MeasureColumns& tile : tiles) {
    for (std::size_t k = 0; k < tile.values.size(); ++k)
      for (std::size_t i = 0; i < kRow && k % 4 != 3; ++i)
        tile.values[k][i] = k % 4 == 1 ? static_cast<double>(k) : 2 + std::sin(0.003 * static_cast<double>(i)) + 1e-6 * unit(random);
    tile.status.assign(kRow, Status::settled);
  }
  return tiles;
}

void write_shard(const std::filesystem::path& path, const Grid& grid, int number) {
  const std::vector<MeasureColumns> samples = sample_tiles(grid);
  RunWriter run(path, grid, {"merge_rate", "none"}, {number, kShards}, RunStart::fresh);
  for (const std::uint64_t tile : run.tiles_to_do()) run.write(run.encode(tile, samples[tile % samples.size()]));
  run.commit();
}

struct Cost {
  double seconds = 0, megabytes = 0;  ///< by the clock; most memory at once
};

/// In a process of its own.
Cost cost_of(const char* what, const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    try {
      work();
      _exit(0);
    } catch (const std::exception& error) {
      fmt::print(stderr, "merge_rate: {}: {}\n", what, error.what());
      _exit(1);
    }
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(fmt::format("{} failed", what));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return {took.count(), static_cast<double>(usage.ru_maxrss) / 1024};
}

void check(const std::filesystem::path& path, const Grid& grid) {
  const std::vector<MeasureColumns> samples = sample_tiles(grid);
  const PortraitReader portrait(path);
  const std::uint64_t tiles = portrait.settings() / kRow;
  std::vector<double> values;
  for (const std::uint64_t tile : {std::uint64_t{0}, std::uint64_t{1}, tiles / 2, tiles - 1})
    for (std::size_t k = 0; k < grid.measures.size(); ++k) {
      portrait.read(grid.measures[k], tile * kRow, kRow, values);
      const std::vector<double>& wanted = samples[tile % samples.size()].values[k];
      for (std::size_t i = 0; i < kRow; ++i)
        if (values[i] != wanted[i] && !(std::isnan(values[i]) && std::isnan(wanted[i])))
          throw std::runtime_error(fmt::format("{} is not what was written", to_string(grid.measures[k])));
    }
}

/// `portrait export`, the program, with some options; the table's size in MB.
struct Exported {
  Cost cost;
  double table = 0;
};

Exported exported(const std::filesystem::path& portrait, const std::string& table, std::vector<std::string> options) {
  const std::filesystem::path path = portrait.parent_path() / table;
  std::vector<std::string> words = {PORTRAIT_PROGRAM, "export", portrait.string(), "-o", path.string(), "--force", "--quiet"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Cost cost = cost_of("export", [&] {
    execv(PORTRAIT_PROGRAM, pointers.data());
    throw std::runtime_error("cannot run " PORTRAIT_PROGRAM);
  });
  const double size = static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
  std::filesystem::remove(path);
  std::filesystem::remove(path.string() + ".json");
  return {cost, size};
}

void print(const char* what, const Cost& cost, double file) {
  fmt::print("{:<22}{:>9.2f} s{:>9.0f} MB/s{:>9.0f} MB of memory\n", what, cost.seconds, file / cost.seconds, cost.megabytes);
}

void measure(std::uint64_t settings, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "merge_rate.h5";
  std::filesystem::remove(path);
  const RunFolder run = RunFolder::of_target(path);
  std::filesystem::remove_all(run.path());
  const Grid grid = grid_of(settings);
  Cost written;
  for (int number = 1; number <= kShards; ++number) {
    const Cost cost = cost_of("a shard", [&] { write_shard(path, grid, number); });
    written = {written.seconds + cost.seconds, std::max(written.megabytes, cost.megabytes)};
  }
  const Cost merged = cost_of("merge", [&] { merge_runs({run}, path, Existing::refuse, {0, 1}, "merge_rate"); });
  std::filesystem::remove_all(run.path());
  const double file = static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
  const Cost verified = cost_of("verify", [&] { verify(path); });
  check(path, grid);
  const std::string half = "IAE_w <= 2";  // of settings: it is 2 and a sine
  const Exported everything = exported(path, "merge_rate.npy", {});
  const Exported text = exported(path, "merge_rate.csv", {"--measures", "IAE_w,Ms"});
  const Exported found = exported(path, "merge_rate.npy", {"--where", half});
  const Exported found_text = exported(path, "merge_rate.csv", {"--where", half, "--measures", "IAE_w,Ms"});
  const double row = 8.0 * static_cast<double>(grid.axes.size() + grid.measures.size()) + 1;
  const double wanted = static_cast<double>(setting_count(grid)) * row * 1e-6;
  if (std::abs(everything.table - wanted) > 0.01 || found.table < 0.3 * wanted || found.table > 0.7 * wanted)
    throw std::runtime_error("the exported table has not the rows that it must have");
  fmt::print("{}: {} settings, {} measures, {:.0f} MB in the file\n", program_version(), setting_count(grid),
             grid.measures.size(), file);
  print("write, two shards", written, file);
  print("merge", merged, file);
  print("verify", verified, file);
  print("export, NPY", everything.cost, everything.table);
  print("export, CSV", text.cost, text.table);
  print("export of half, NPY", found.cost, found.table);
  print("export of half, CSV", found_text.cost, found_text.table);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace portrait

int main(int count, char** words) try {
  portrait::keep_freed_memory();
  const std::uint64_t settings = count > 1 ? std::strtoull(words[1], nullptr, 10) : 10'000'000;
  portrait::measure(settings, count > 2 ? words[2] : ".");
} catch (const std::exception& error) {
  fmt::print(stderr, "merge_rate: {}\n", error.what());
  return 1;
}
