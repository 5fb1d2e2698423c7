/// Words of the user against words we know: the nearest one, and numbers as people write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace portrait {

/// Number of single-letter insertions, deletions, substitutions and swaps of neighbours between two words
/// (optimal string alignment), letter case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word nearest to `word`, when near enough to be a slip of the pen: at most a third of its letters
/// (and at least one) differ. Of several equally near the first.
std::optional<std::string_view> nearest_word(std::string_view word, const std::vector<std::string_view>& known);

/// " (did you mean "kappa"?)", or " (known: a, b, c)" when no known word is near.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& known);

/// "a, b, c"
std::string joined(const std::vector<std::string_view>& words);

/// The whole text as one number ("1", "-2.5e-3", "inf"); nothing for anything else, NaN included.
std::optional<double> parse_number(std::string_view text);

/// Shortest text that reads back as the same double; "inf", "-inf", "nan".
std::string number_text(double value);

}  // namespace portrait
