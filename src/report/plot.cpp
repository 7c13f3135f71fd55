#include "report/plot.hpp"

#include "io/text.hpp"
#include "report/svg_parts.hpp"

namespace bitshade {
namespace {

using namespace svg_parts;

std::string legend(const std::vector<series>& lines, double y) {
  std::string out;
  double x = left;
  for (const series& s : lines) {
    if (x + 24 + 7 * static_cast<double>(columns(s.name)) > width - right && x > left)
      x = left, y += 20;
    out += s.marks ? mark(x + 6, y - 4, s.colour, "")
                   : rule(x - 2, y - 4, x + 12, y - 4, "line " + colour_class(s.colour));
    out += text(x + 16, y, s.name, "start");
    x += 36 + 7 * static_cast<double>(columns(s.name));
  }
  return out;
}

int legend_rows(const std::vector<series>& lines) {
  int rows = 1;
  double x = left;
  for (const series& s : lines) {
    const double w = 7 * static_cast<double>(columns(s.name));
    if (x + 24 + w > width - right && x > left) x = left, ++rows;
    x += 36 + w;
  }
  return rows;
}

}  // namespace

std::string svg(const plot& p) {
  const double head = 20.0 * legend_rows(p.lines) + 4;
  const double y0 = head + height - bottom, y1 = head + top, x1 = width - right;
  std::vector<double> xs, ys;
  for (const series& s : p.lines)
    for (const auto& [x, y] : s.points) xs.push_back(x), ys.push_back(y);
  for (const series& s : p.lines)
    for (const auto& [low, high] : s.spread) xs.push_back(low), xs.push_back(high);
  for (const auto& [at, name] : p.levels) ys.push_back(at);
  const scale x(p.x, xs, left, x1), y(p.y, ys, y0, y1);
  std::string out = open(p.name, width, head + height) + legend(p.lines, 16);
  for (const auto& [at, label] : y.ticks())
    out += rule(left, at, x1, at, "grid") + text(left - 8, at + 4, label, "end");
  for (const auto& [at, label] : x.ticks())
    out += rule(at, y0, at, y1, "grid") + text(at, y0 + 18, label);
  out += rule(left, y0, x1, y0, "axis") + rule(left, y0, left, y1, "axis");
  out += text((left + x1) / 2, y0 + 40, p.x.title, "middle", " class=\"title\"");
  const double middle = (y0 + y1) / 2;
  out += text(16, middle, p.y.title, "middle",
              " class=\"title\" transform=\"rotate(-90 16 " + number(middle) + ")\"");
  for (const auto& [at, name] : p.levels)
    out += rule(left, y.place(at), x1, y.place(at), "compare-with") +
           text(x1 - 4, y.place(at) - 5, name, "end", " class=\"title\"");
  for (const series& s : p.lines) {
    if (s.line && s.points.size() > 1) {
      out += "<polyline class=\"line " + colour_class(s.colour) + "\" points=\"";
      for (const auto& [px, py] : s.points)
        out += number(x.place(px)) + "," + number(y.place(py)) + " ";
      out.back() = '"';
      out += "/>";
    }
    for (std::size_t i = 0; i < s.spread.size() && i < s.points.size(); ++i) {
      const double at = y.place(s.points[i].second);
      out += rule(x.place(s.spread[i].first), at, x.place(s.spread[i].second), at,
                  "spread " + colour_class(s.colour));
    }
    for (std::size_t i = 0; s.marks && i < s.points.size(); ++i)
      out += mark(x.place(s.points[i].first), y.place(s.points[i].second), s.colour,
                  i < s.labels.size() ? s.labels[i] : "");
  }
  return out + "</svg>";
}

}  // namespace bitshade
