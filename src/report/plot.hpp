// Small plots as inline SVG: axes with units, series told apart by colour and by mark.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bitshade {

/// A line, or points alone, in one of the page's colours (class c0 .. c5, cm for the method); from
/// the seventh on the marks are hollow.
struct series {
  std::string name;
  int colour = 0;  ///< index into categories(); -1: the text's colour, dashed
  bool line = true;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string> labels;                     ///< a tooltip a point; may be empty
  std::vector<std::pair<double, double>> spread = {};  ///< of x about each point; may be empty
  bool marks = true;
};

struct axis {
  std::string title;          ///< with the unit
  bool logarithmic = false;   ///< zero has a place of its own below the smallest decade
  std::vector<double> ticks;  ///< where given, the only ticks
};

struct plot {
  std::string name;  ///< says what the picture shows, to readers that cannot see it
  axis x, y;
  std::vector<series> lines;
  std::vector<std::pair<double, std::string>> levels = {};  ///< values of y to compare with, named
};

/// Lines or points over two axes.
std::string svg(const plot& p);

/// One bar: its parts are stacked and take the colours 0, 1, ….
struct bar {
  std::string label;
  std::vector<double> parts;
  std::string value;  ///< written at its end
};

/// Horizontal bars, one below the other.
struct bar_chart {
  std::string name;
  std::string unit;
  std::vector<std::string> parts;  ///< the legend; one part has none
  std::vector<bar> bars;
};
std::string svg(const bar_chart& chart);

/// Two histograms over [0,1] (occluders up, receivers down) and splits as ticks in lanes below.
struct depth_chart {
  std::string name;
  std::vector<double> occluders, receivers;  ///< counts a bin; same number of bins
  std::vector<std::pair<std::string, std::vector<double>>> splits;
};
std::string svg(const depth_chart& chart);

/// Text that HTML and SVG show as it stands.
std::string escaped(const std::string& text);

}  // namespace bitshade
