#include "report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/text.hpp"

namespace bitshade {
namespace {

constexpr double left = 76, right = 20, top = 16, bottom = 52;
constexpr double width = 640, height = 360;

std::string number(double v) {  // a coordinate: two decimals suffice
  const double rounded = std::round(v * 100) / 100;
  return shortest(rounded == 0 ? 0 : rounded);
}

std::string open(const std::string& name, double w, double h) {
  return "<svg viewBox=\"0 0 " + number(w) + " " + number(h) + "\" role=\"img\" aria-label=\"" +
         escaped(name) + "\">";
}

std::string text(double x, double y, const std::string& words, const std::string& anchor = "middle",
                 const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         more + ">" + escaped(words) + "</text>";
}

std::string rule(double x1, double y1, double x2, double y2, const std::string& kind) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" class=\"" + kind + "\"/>";
}

std::string colour_class(int colour) {
  return colour < 0 ? "cm" : "c" + std::to_string(colour % 6);
}

/// Marks differ in shape too, for eyes and printers that see no colours.
std::string mark(double x, double y, int colour, const std::string& tip) {
  constexpr double r = 4.5;
  std::string shape;
  const auto polygon = [&](std::initializer_list<std::array<double, 2>> corners) {
    shape = "<polygon points=\"";
    for (const auto& c : corners) shape += number(x + c[0] * r) + "," + number(y + c[1] * r) + " ";
    shape.back() = '"';
  };
  switch (colour < 0 ? 5 : colour % 6) {
    case 0:
      shape = "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"4.5\"";
      break;
    case 1:
      polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
      break;
    case 2:
      polygon({{0, -1.25}, {1.15, 0.9}, {-1.15, 0.9}});
      break;
    case 3:
      polygon({{0, -1.35}, {1.35, 0}, {0, 1.35}, {-1.35, 0}});
      break;
    case 4:
      polygon({{0, 1.25}, {1.15, -0.9}, {-1.15, -0.9}});
      break;
    default:
      polygon({{-1.2, -0.35}, {1.2, -0.35}, {1.2, 0.35}, {-1.2, 0.35}});
      break;
  }
  return shape + " class=\"mark " + colour_class(colour) + "\">" +
         (tip.empty() ? "" : "<title>" + escaped(tip) + "</title>") +
         (shape.starts_with("<circle") ? "</circle>" : "</polygon>");
}

/// Where values lie between two ends, with ticks that people read easily.
class scale {
 public:
  scale(const axis& a, std::vector<double> values, double from, double to)
      : log_(a.logarithmic), from_(from), to_(to) {
    values.insert(values.end(), a.ticks.begin(), a.ticks.end());
    if (log_) {
      low_ = std::numeric_limits<double>::infinity();
      high_ = 0;
      for (const double v : values) {
        zero_ = zero_ || v <= 0;
        if (v > 0) low_ = std::min(low_, v), high_ = std::max(high_, v);
      }
      if (high_ == 0) low_ = high_ = 1;
      if (a.ticks.empty()) {
        low_ = std::floor(std::log10(low_));
        high_ = std::max(std::ceil(std::log10(high_)), low_ + 1);
        const int step = high_ - low_ > 8 ? 2 : 1;
        for (double e = low_; e <= high_; e += step) ticks_.push_back({place_log(e), power(e)});
      } else {
        low_ = std::log10(low_) - 0.06, high_ = std::log10(high_) + 0.06;
        for (const double t : a.ticks) ticks_.push_back({place_log(std::log10(t)), shortest(t)});
      }
      if (zero_) ticks_.push_back({from_, "0"});
      return;
    }
    low_ = 0;
    high_ = values.empty() ? 1 : *std::max_element(values.begin(), values.end());
    if (!(high_ > 0)) high_ = 1;
    double step = std::pow(10, std::floor(std::log10(high_)));
    while (high_ / step < 4) step /= 2;
    high_ = std::ceil(high_ / step) * step;
    for (double t = 0; t <= high_ * 1.0001; t += step) ticks_.push_back({place(t), tidy(t)});
  }

  double place(double v) const {
    if (log_) return v <= 0 ? from_ : place_log(std::log10(v));
    return from_ + (to_ - from_) * (v - low_) / (high_ - low_);
  }
  const std::vector<std::pair<double, std::string>>& ticks() const { return ticks_; }
  bool has_zero() const { return zero_; }

 private:
  double place_log(double e) const {
    const double begin = zero_ ? from_ + (to_ - from_) * 0.1 : from_;
    return begin + (to_ - begin) * (e - low_) / (high_ - low_);
  }
  /// A multiple of a round step without the dust of its sums: "0.3", not "0.30000000000000004".
  static std::string tidy(double t) {
    std::string text = brief(t, 4);
    if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }
  static std::string power(double e) {
    if (e == 0) return "1";
    if (e == -1) return "0.1";
    if (e == 1) return "10";
    static constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴",
                                                             "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out = e < 0 ? "10⁻" : "10";
    for (const char c : std::to_string(static_cast<int>(std::fabs(e))))
      out += raised[static_cast<std::size_t>(c - '0')];
    return out;
  }

  bool log_, zero_ = false;
  double from_, to_, low_ = 0, high_ = 1;
  std::vector<std::pair<double, std::string>> ticks_;
};

std::string legend(const std::vector<series>& lines, double y) {
  std::string out;
  double x = left;
  for (const series& s : lines) {
    if (x + 24 + 7 * static_cast<double>(columns(s.name)) > width - right && x > left)
      x = left, y += 20;
    out += mark(x + 6, y - 4, s.colour, "") + text(x + 16, y, s.name, "start");
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

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string svg(const plot& p) {
  const double head = 20.0 * legend_rows(p.lines) + 4;
  const double y0 = head + height - bottom, y1 = head + top, x1 = width - right;
  std::vector<double> xs, ys;
  for (const series& s : p.lines)
    for (const auto& [x, y] : s.points) xs.push_back(x), ys.push_back(y);
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
  for (const series& s : p.lines) {
    if (s.line && s.points.size() > 1) {
      out += "<polyline class=\"line " + colour_class(s.colour) + "\" points=\"";
      for (const auto& [px, py] : s.points)
        out += number(x.place(px)) + "," + number(y.place(py)) + " ";
      out.back() = '"';
      out += "/>";
    }
    for (std::size_t i = 0; i < s.points.size(); ++i)
      out += mark(x.place(s.points[i].first), y.place(s.points[i].second), s.colour,
                  i < s.labels.size() ? s.labels[i] : "");
  }
  return out + "</svg>";
}

std::string svg(const bar_chart& chart) {
  std::size_t longest = 0;
  double most = 0;
  for (const bar& b : chart.bars) {
    longest = std::max(longest, columns(b.label));
    double sum = 0;
    for (const double v : b.parts) sum += v;
    most = std::max(most, sum);
  }
  const double from = 12 + 7.2 * static_cast<double>(longest), to = width - 84;
  const double head = chart.parts.size() > 1 ? 28 : 6, lane = 22;
  const double foot = head + lane * static_cast<double>(chart.bars.size());
  const scale x({"", false, {}}, {most}, from, to);
  std::string out = open(chart.name, width, foot + 44);
  if (chart.parts.size() > 1) {
    double at = from;
    for (std::size_t i = 0; i < chart.parts.size(); ++i) {
      out += "<rect x=\"" + number(at) + "\" y=\"5\" width=\"12\" height=\"12\" class=\"area c" +
             std::to_string(i) + "\"/>" + text(at + 18, 16, chart.parts[i], "start");
      at += 44 + 7 * static_cast<double>(columns(chart.parts[i]));
    }
  }
  for (const auto& [at, label] : x.ticks())
    out += rule(at, head, at, foot, "grid") + text(at, foot + 18, label);
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const bar& b = chart.bars[i];
    const double y = head + lane * static_cast<double>(i);
    out += text(from - 8, y + 15, b.label, "end");
    double sum = 0;
    for (std::size_t k = 0; k < b.parts.size(); ++k) {
      const double begin = x.place(sum), end = x.place(sum += b.parts[k]);
      out += "<rect x=\"" + number(begin) + "\" y=\"" + number(y + 3) + "\" width=\"" +
             number(end - begin) + "\" height=\"" + number(lane - 6) + "\" class=\"area c" +
             std::to_string(k % 6) + "\"/>";
    }
    out += text(x.place(sum) + 6, y + 15, b.value, "start");
  }
  out += rule(from, head, from, foot, "axis");
  return out + text((from + to) / 2, foot + 38, chart.unit, "middle", " class=\"title\"") +
         "</svg>";
}

std::string svg(const depth_chart& chart) {
  const double half = 110, middle = 16 + half, x1 = width - right, lane = 18;
  const double foot = middle + half + 8 + lane * static_cast<double>(chart.splits.size());
  double most = 1;
  for (const auto* counts : {&chart.occluders, &chart.receivers})
    for (const double v : *counts) most = std::max(most, v);
  const auto place = [&](double depth) { return left + (x1 - left) * depth; };
  // Counts span decades: their logarithm is drawn, one count a first step.
  const auto reach = [&](double count) {
    return count <= 0 ? 0 : half * (1 + std::log10(count)) / (1 + std::log10(most));
  };
  std::string out = open(chart.name, width, foot + 48);
  const auto bars = [&](const std::vector<double>& counts, int way, const std::string& colour) {
    const double w = (x1 - left) / static_cast<double>(std::max<std::size_t>(1, counts.size()));
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double h = reach(counts[i]);
      if (h <= 0) continue;
      out += "<rect x=\"" + number(left + w * static_cast<double>(i)) + "\" y=\"" +
             number(way > 0 ? middle - h : middle) + "\" width=\"" + number(w) + "\" height=\"" +
             number(h) + "\" class=\"area " + colour + "\"/>";
    }
  };
  for (int i = 0; i <= 10; ++i)
    out += rule(place(i / 10.0), 16, place(i / 10.0), foot, "grid") +
           text(place(i / 10.0), foot + 18,
                i == 0    ? "0"
                : i == 10 ? "1"
                          : "0." + std::to_string(i));
  bars(chart.occluders, 1, "c0");
  bars(chart.receivers, -1, "c1");
  out += rule(left, middle, x1, middle, "axis");
  out += text(left - 8, middle - half / 2, "occluders", "end") +
         text(left - 8, middle + half / 2, "receivers", "end");
  for (std::size_t n = 0; n < chart.splits.size(); ++n) {
    const double y = middle + half + 8 + lane * static_cast<double>(n);
    const auto& [label, splits] = chart.splits[n];
    out +=
        text(left - 8, y + 13, label, "end") + rule(left, y + lane / 2, x1, y + lane / 2, "grid");
    for (const double s : splits) {
      const double x = place(s);
      out += "<rect x=\"" + number(x - 1.5) + "\" y=\"" + number(y + 2) +
             "\" width=\"3\" height=\"14\" class=\"split\"><title>" + escaped(brief(s, 4)) +
             "</title></rect>";
    }
  }
  return out +
         text((left + x1) / 2, foot + 40,
              "depth: 0 at the light, 1 at the far end (bars: logarithm of the count)", "middle",
              " class=\"title\"") +
         "</svg>";
}

}  // namespace bitshade
