/// A grid file as a grid. The format: grids/README.md.
///
/// throws    InputError for everything that is wrong with the file, with line and column:
///           `grid.toml:12:1: unknown key "kapa" (did you mean "kappa"?)`; nothing is guessed or passed over
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.h"
#include "grids/grid.h"

namespace portrait {

Grid read_grid(const std::filesystem::path& path);

/// The same for a text at hand; `source_name` stands for it in messages. Any bytes give a grid or an InputError.
Grid parse_grid(std::string text, std::string source_name);

}  // namespace portrait
