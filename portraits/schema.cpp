#include "portraits/schema.h"

#include <sstream>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait::schema {

std::string tile_digests_of(std::string_view column) { return fmt::format("{}/{}", kTileDigests, column); }

std::string tile_summaries_of(std::string_view column) { return fmt::format("{}/{}", kTileSummaries, column); }

h5::Layout axis_layout(std::uint64_t size) { return {h5::Element::real64, {size}, {}}; }

h5::Layout fixed_layout() { return {h5::Element::real64, {}, {}}; }

h5::Layout tile_digest_layout(std::uint64_t tiles) { return {h5::Element::uint64, {tiles}, {}}; }

h5::Layout tile_summary_layout(std::uint64_t tiles, std::uint64_t numbers) {
  return {h5::Element::real64, {tiles, numbers}, {}};
}

h5::Layout column_layout(const TileRows& rows, h5::Element element) {
  return {element, rows.extent(), rows.tile_extent()};
}

h5::Element element_of(Precision precision) {
  return precision == Precision::real64 ? h5::Element::real64 : h5::Element::real32;
}

std::string precision_text(Precision precision) { return precision == Precision::real64 ? "double" : "single"; }

std::string horizon_text(const Horizon& horizon) {
  return horizon.automatic ? "auto" : number_text(horizon.dead_times);
}

std::string names_text(const std::vector<std::string_view>& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

std::vector<std::string> names_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> names;
  for (std::string name; stream >> name;) names.push_back(name);
  return names;
}

}  // namespace portrait::schema
