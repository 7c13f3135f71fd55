// Text for people and for files: wrapping, padding, numbers. Independent of the locale.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bitshade {

/// Columns that a terminal spends on UTF-8 text: one a code point (no wide characters here).
std::size_t columns(std::string_view text);

/// `text` broken at blanks into lines of at most `width` columns; a longer word has its own line.
std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// `text` padded with blanks to `width` columns, on the right or on the left.
std::string pad_right(std::string_view text, std::size_t width);
std::string pad_left(std::string_view text, std::size_t width);

/// Shortest decimal that reads back as the same number: for files.
std::string shortest(double value);

/// `value` with `digits` significant digits, plain where that is short, else as 1.2e-05: for
/// people.
std::string brief(double value, int digits = 3);

/// The same, but whole numbers below 10^7 as they are: for columns that hold counts as well.
std::string brief_or_whole(double value, int digits = 3);

/// A share of 1 in per cent: "0", "<0.01", "0.37", "12.4".
std::string percent(double share);

/// `text` split at `separator`; empty parts are kept.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace bitshade
