/// What a portrait file is made of: the names in it, its version, and the layout of its datasets.
/// FORMAT.md says the same to people; tests/portraits/format_test.cpp holds the two together.
#pragma once

#include <string>
#include <string_view>

#include "grids/grid.h"
#include "portraits/h5.h"
#include "portraits/tile_rows.h"

namespace portrait::schema {

/// A reader takes any file of its own major version. Minor: something was added. Patch: words only.
inline constexpr int kMajor = 2;
inline constexpr const char* kVersion = "2.2.0";
inline constexpr const char* kName = "portrait";

inline constexpr const char* kStatus = "status";
inline constexpr const char* kDigest = "xxh3_64";                ///< attribute of every dataset
inline constexpr const char* kTileDigests = "tile_digests";      ///< group: a digest per tile and column
inline constexpr const char* kTileSummaries = "tile_summaries";  ///< group: range or counts per tile and column
inline constexpr const char* kTile = "tile";                     ///< dimension of both
inline constexpr const char* kRange = "range";                   ///< second dimension of a measure's summaries
inline constexpr const char* kOutcome = "outcome";               ///< of the status's

/// "tile_digests/IAE_w"
std::string tile_digests_of(std::string_view column);
/// "tile_summaries/IAE_w"
std::string tile_summaries_of(std::string_view column);

h5::Layout axis_layout(std::uint64_t size);
h5::Layout fixed_layout();
h5::Layout tile_digest_layout(std::uint64_t tiles);
h5::Layout tile_summary_layout(std::uint64_t tiles, std::uint64_t numbers);
/// Of a measure or the status: the whole grid, a chunk per tile; one plain number for a grid without axes.
h5::Layout column_layout(const TileRows& rows, h5::Element element);

h5::Element element_of(Precision precision);
/// "double" or "single", as in grid files.
std::string precision_text(Precision precision);
/// "auto" or the number of dead times.
std::string horizon_text(const Horizon& horizon);

/// "a b c": lists of names are kept as CF keeps them.
std::string names_text(const std::vector<std::string_view>& names);
std::vector<std::string> names_in(const std::string& text);

}  // namespace portrait::schema
