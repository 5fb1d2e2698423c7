/// What a run folder is of: the grid file verbatim, and all that decides the bits of its results. Two runs whose
/// identities are equal give the same portrait; what one began another may go on with, on any machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "grids/grid.h"
#include "portraits/facts.h"

namespace portrait {

struct RunManifest {
  // The identity: any difference and the results need not be the same bits.
  std::string grid_text;       ///< the grid file, byte for byte
  std::string schema_version;  ///< of the file to be made
  std::string program;         ///< version and commit
  std::string method;          ///< engine and instruction set
  // For the record.
  std::string command_line, date;
  std::uint64_t settings = 0, tiles = 0;
};

RunManifest manifest_of(const Grid& grid, const Provenance& provenance);

/// XXH3 of the identity.
std::uint64_t fingerprint(const RunManifest& manifest);

/// What differs between two identities, a line each; empty: nothing does.
std::string difference(const RunManifest& kept, const RunManifest& now);

std::string json_text(const RunManifest& manifest);
/// Throws IntegrityError when the file is no manifest or its fingerprint is another.
RunManifest read_manifest(const std::filesystem::path& path);

}  // namespace portrait
