// report.html: one file that needs nothing else.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "run/database.hpp"

namespace bitshade {

/// A part of a section that a question of its own adds: accuracy against time, blame, precision.
struct report_part {
  std::string title;
  std::string text;  ///< what is seen, in words
  std::string body;  ///< HTML: sortable_table()s (html_table.hpp) and figure()s (figures.hpp)
  std::string finding = {};  ///< one sentence for the summary; empty: it adds none
  std::string name = {};     ///< of `data` among an input's parts in results.json
  std::string data = {};     ///< the figures as JSON; empty: they are in the rows
};

/// One input of a study with everything that is shown of it.
struct report_section {
  input_description input;
  std::vector<row> rows;
  picture_files pictures;                       ///< of the input: truth, shaded, depth
  std::map<std::string, picture_files> cells;   ///< of the cells, by key
  std::map<std::string, std::string> commands;  ///< that reproduce a cell's pictures, by key
  std::string command;                          ///< that reproduces the figures
  std::vector<report_part> parts = {};          ///< after the findings, in this order
};

/// What heads a report.
struct report_head {
  std::string command;  ///< as the user typed it
  std::string version;
  std::string compiler;
  std::string machine;
  std::string seed = {};  ///< of whatever is random in the inputs; empty: nothing is known of it
  std::string subject = "What number formats cost these shadow maps, in error and in time.";
  std::string files = "results.csv and results.json beside this page, and in results.sqlite";
};

/// A page of its own around `body`: heading, style, script, and where its figures come from.
std::string html_page(const report_head& head, const std::string& title, const std::string& body);

/// A page with a summary in words, tables, plots and pictures; light and dark, for screens of any
/// width and for paper. The same arguments give the same bytes.
std::string html_report(const report_head& head, const std::vector<report_section>& sections);

}  // namespace bitshade
