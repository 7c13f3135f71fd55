#include "report/text_table.hpp"

#include <algorithm>

#include "io/text.hpp"

namespace bitshade {

std::string text_table(const std::vector<text_line>& lines, const std::set<std::size_t>& words) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const text_line& l : lines)
    for (std::size_t i = 0; i < l.size(); ++i) widths[i] = std::max(widths[i], columns(l[i]));
  std::size_t width = 0;
  for (const std::size_t w : widths) width += w;
  const std::size_t gap = width + 2 * (widths.size() - 1) > 80 ? 1 : 2;
  std::string out;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::string text;
    for (std::size_t i = 0; i < lines[n].size(); ++i) {
      if (i != 0) text.append(gap, ' ');
      text +=
          words.contains(i) ? pad_right(lines[n][i], widths[i]) : pad_left(lines[n][i], widths[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    out += text + '\n';
    if (n == 0) out += std::string(width + gap * (widths.size() - 1), '-') + '\n';
  }
  return out;
}

}  // namespace bitshade
