// Tables of report.html: a click on a heading sorts.
#pragma once

#include <string>
#include <vector>

namespace bitshade {

struct table_column {
  std::string head;
  std::string tip;    ///< what the heading means, for whoever points at it
  bool word = false;  ///< text, to the left; else a number, to the right
};

/// Cells of a row. A number sorts by its value, whatever it is shown as.
std::string word_cell(const std::string& text);
std::string number_cell(double value, const std::string& shown);
/// An error with a bar behind it: logarithmic from 1e-7 to 1.
std::string level_cell(double error);

/// A row of cells.
std::string table_row(const std::string& cells);

/// A table that scrolls sideways where the window is narrower; `rows` are table_row()s.
std::string sortable_table(const std::vector<table_column>& heads, const std::string& rows);

}  // namespace bitshade
