/// Which settings of a tile are admissible, with as little reading as can tell.
#pragma once

#include <cstdint>
#include <vector>

#include "portraits/query/candidates.h"

namespace portrait {

class Admission {
 public:
  Admission(const Sheet& sheet, const std::vector<Constraint>& where) : sheet_(sheet), where_(where) {}

  /// What is known of a tile before it is read.
  struct Glance {
    bool is_counted = false;              ///< total and left_out have it already
    bool possible = false;                ///< some setting may be admissible
    std::vector<const Constraint*> open;  ///< those that hold in a part of it, perhaps
    bool whole() const { return is_counted && possible && open.empty(); }  ///< every setting of right status
  };

  /// Counts the tile where its summary can; false when nothing more of it matters.
  bool glance(std::uint64_t tile, Counted& counted, Glance& glance) const;

  /// Reads the tile and keeps the positions of those that meet every constraint. REQUIRES: glance of this tile.
  void choose(std::uint64_t tile, const Glance& glance, TilePage& page, Counted& counted,
              std::vector<std::size_t>& chosen) const;

 private:
  const Sheet& sheet_;
  const std::vector<Constraint>& where_;
};

}  // namespace portrait
