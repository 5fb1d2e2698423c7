/// What the tests of this folder share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "grids/grid_file.h"

namespace portrait {

/// A grid file with every kind of axis, the one that grids/README.md opens with.
inline const std::string kExample = R"(title   = "DIPDT, PID, first-order filter"
plant   = "dipdt"                 # dipdt | ipdt | fotd | jotd
n       = 1                       # filter order; 0: ideal derivative of the output
prefilter = "full"                # full | pi | none
horizon = 51                      # dead times, or "auto"
precision = "double"              # or "single"
# measures = ["IAE_w", "IAE_d", "TV2_uw", "Ms"]     # default: all

[parameters]                      # a number is fixed, anything else is an axis, in this order
kappa = { from = 0.05, to = 0.35, step = 0.01 }     # both ends belong to the grid
delta = { from = 0.35, to = 1.05, count = 15 }
tau_i = [6, 8, 10, 14, 20, inf]
tau_f = { from = 0.01, to = 1, count = 9, scale = "log" }
b = 0
c = 0
)";

/// A dipdt grid whose axes have these sizes (at most four), the values 1, 2, 3, ...
inline Grid grid_of(const std::vector<std::uint64_t>& sizes) {
  constexpr Parameter kNames[] = {Parameter::kappa, Parameter::delta, Parameter::tau_i, Parameter::tau_f};
  Grid grid;
  grid.family = {Plant::dipdt, 1, Prefilter::full};
  for (std::size_t k = 0; k < sizes.size(); ++k)
    grid.axes.push_back(sizes[k] == 1 ? Axis::list(kNames[k], {1})
                                      : Axis::linear(kNames[k], 1, static_cast<double>(sizes[k]), sizes[k]));
  for (std::size_t k = sizes.size(); k < 4; ++k) grid.fixed.push_back({kNames[k], 1});
  return grid;
}

inline Grid parsed(const std::string& text) { return parse_grid(text, "grid.toml"); }

/// The message of the InputError that the text ends in, "" when it is a grid.
inline std::string complaint(const std::string& text) {
  try {
    parsed(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The .toml files of a folder of the sources, by name.
inline std::vector<std::filesystem::path> toml_files(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PORTRAIT_SOURCE_DIR) / folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace portrait
