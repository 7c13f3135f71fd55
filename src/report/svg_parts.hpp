// What plots and charts are drawn of: text, rules, marks and scales, as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/plot.hpp"

namespace bitshade::svg_parts {

/// The margins and the size of a drawing, in its own units.
inline constexpr double left = 76, right = 20, top = 16, bottom = 52;
inline constexpr double width = 640, height = 360;

/// A coordinate: two decimals suffice.
std::string number(double v);
std::string open(const std::string& name, double w, double h);
std::string text(double x, double y, const std::string& words, const std::string& anchor = "middle",
                 const std::string& more = "");
std::string rule(double x1, double y1, double x2, double y2, const std::string& kind);
/// The page's class of a series' colour; -1 is the text's.
std::string colour_class(int colour);
/// Marks differ in shape too, for eyes and printers that see no colours.
std::string mark(double x, double y, int colour, const std::string& tip);

/// Where values lie between two ends, with ticks that people read easily.
class scale {
 public:
  scale(const axis& a, std::vector<double> values, double from, double to);

  double place(double v) const;
  const std::vector<std::pair<double, std::string>>& ticks() const { return ticks_; }
  bool has_zero() const { return zero_; }

 private:
  double place_log(double e) const;

  bool log_, zero_ = false;
  double from_, to_, low_ = 0, high_ = 1;
  std::vector<std::pair<double, std::string>> ticks_;
};

}  // namespace bitshade::svg_parts
