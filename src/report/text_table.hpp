// Tables on a terminal.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace bitshade {

using text_line = std::vector<std::string>;

/// Lines of equally many entries, the first the heading.
///
/// Columns are as wide as their widest entry, `words` to the left and numbers to the right; two
/// blanks between them, or one where two would not fit a page of 80.
std::string text_table(const std::vector<text_line>& lines, const std::set<std::size_t>& words);

}  // namespace bitshade
