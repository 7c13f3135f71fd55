#include "report/html_table.hpp"

#include <algorithm>
#include <cmath>

#include "io/text.hpp"
#include "report/plot.hpp"

namespace bitshade {

std::string word_cell(const std::string& text) {
  return "<td class=\"word\">" + escaped(text) + "</td>";
}

std::string number_cell(double value, const std::string& shown) {
  return "<td data-value=\"" + shortest(value) + "\">" + escaped(shown) + "</td>";
}

std::string level_cell(double error) {
  const double share = error <= 0 ? 0 : std::clamp((7 + std::log10(error)) / 7, 0.02, 1.0);
  return "<td class=\"level\" data-value=\"" + shortest(error) +
         "\" style=\"--level:" + std::to_string(static_cast<int>(share * 100 + 0.5)) + "%\">" +
         brief(error) + "</td>";
}

std::string table_row(const std::string& cells) { return "<tr>" + cells + "</tr>\n"; }

std::string sortable_table(const std::vector<table_column>& heads, const std::string& rows) {
  std::string out = "<div class=\"scroll\"><table class=\"sorts\"><thead><tr>";
  for (const table_column& c : heads)
    out += "<th scope=\"col\"" + std::string(c.word ? " class=\"word\"" : "") + " title=\"" +
           escaped(c.tip) + "\"><button type=\"button\">" + escaped(c.head) + "</button></th>";
  return out + "</tr></thead><tbody>" + rows + "</tbody></table></div>\n";
}

}  // namespace bitshade
