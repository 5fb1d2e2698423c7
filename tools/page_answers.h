/// What the page asks of a portrait and gets, as JSON; nothing here knows of sockets.
///
/// A request is an object; what it may hold stands in docs/page.md. Numbers that JSON has none for are null (NaN), "inf"
/// and "-inf". A request that does not fit throws InputError, with the place in the text that was typed.
/// threads   any number at a time
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

#include "portraits/query/column_cache.h"
#include "portraits/query/query.h"
#include "portraits/reader.h"
#include "tools/output.h"

namespace portrait::tools {

class PageAnswers {
 public:
  PageAnswers(const std::string& path, std::size_t memory) : portrait_(path), cache_(portrait_, memory) {}

  const Grid& grid() const { return portrait_.grid(); }

  /// Plant, axes, measures with their units, where the file comes from.
  Json info() const;

  /// A plane of the portrait and the answer to the question at once:
  ///     4 bytes   length n of the head, little endian
  ///     n bytes   head, JSON, padded with spaces to a multiple of 4: nx, ny, optimum, admissible, ...
  ///     float32   nx * ny values of the colour, row by row
  ///     uint8     nx * ny states: status + 8 when admissible
  std::string view(const Json& request) const;

  /// Everything about one setting, and the values of expressions there: {"number": N, "expressions": [..]}.
  Json setting(const Json& request) const;
  /// Its responses and Nyquist curve, simulated now.
  Json simulate(const Json& request) const;
  /// The settings in the plane of two expressions, and the Pareto front.
  Json front(const Json& request) const;
  /// Tuning rules under the question, with their regret; where the two expressions are given, their place in that plane.
  Json rules(const Json& request) const;
  /// 101 quantiles, 0 to 100 %, of an expression over the settled settings; of a large portrait over a part of them.
  Json quantiles(const Json& request) const;

 private:
  Answer answer(const Question& question, const Json& request) const;

  PortraitReader portrait_;
  ColumnCache cache_;
  mutable std::mutex mutex_;
  mutable std::string answered_;  ///< the last question, as it came
  mutable std::optional<Answer> last_;
};

}  // namespace portrait::tools
