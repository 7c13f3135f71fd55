#include "report/svg_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/text.hpp"

namespace bitshade {

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

namespace svg_parts {
namespace {

/// A multiple of a round step without the dust of its sums and without idle zeros: "0.3", not
/// "0.30000000000000004"; "1e-3", not "1.000e-3".
std::string tidy(double t) {
  std::string text = brief(t, 4), power;
  if (const auto e = text.find('e'); e != std::string::npos)
    power = text.substr(e), text.erase(e);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text + power;
}

/// Room that a tick's label needs, in a drawing's units: wide along x, high along y.
double room_of(double from, double to) { return to > from ? 56 : 26; }

/// The largest of 1, 2 and 5 times a power of ten that is at most v, for v > 0.
double round_down(double v) {
  const double decade = std::pow(10, std::floor(std::log10(v)));
  const double digit = v / decade * (1 + 1e-12);
  return decade * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}
double round_up(double v) {
  const double down = round_down(v);
  if (down >= v * (1 - 1e-12)) return down;
  const double decade = std::pow(10, std::floor(std::log10(down) + 1e-9));
  const double digit = down / decade;
  return decade * (digit < 1.5 ? 2 : digit < 3 ? 5 : 10);
}

std::string power(double e) {
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

}  // namespace

std::string number(double v) {
  const double rounded = std::round(v * 100) / 100;
  return shortest(rounded == 0 ? 0 : rounded);
}

std::string open(const std::string& name, double w, double h) {
  return "<svg viewBox=\"0 0 " + number(w) + " " + number(h) + "\" role=\"img\" aria-label=\"" +
         escaped(name) + "\">";
}

std::string text(double x, double y, const std::string& words, const std::string& anchor,
                 const std::string& more) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         more + ">" + escaped(words) + "</text>";
}

std::string rule(double x1, double y1, double x2, double y2, const std::string& kind) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" class=\"" + kind + "\"/>";
}

std::string colour_class(int colour) {
  if (colour < 0) return "cm";
  return "c" + std::to_string(colour % 6) + (colour / 6 % 2 == 1 ? " hollow" : "");
}

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

scale::scale(const axis& a, std::vector<double> values, double from, double to)
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
    if (!a.ticks.empty()) {
      low_ = std::log10(low_) - 0.06, high_ = std::log10(high_) + 0.06;
      for (const double t : a.ticks) ticks_.push_back({place_log(std::log10(t)), shortest(t)});
    } else if (high_ < 100 * low_) {  // within two decades, their parts
      const double least = round_down(low_), most = round_up(std::max(high_, 1.5 * low_));
      low_ = std::log10(least), high_ = std::log10(most);
      for (double t = least; t < most * 1.5; t = round_up(t * 1.5))
        ticks_.push_back({place_log(std::log10(t)), tidy(t)});
    } else {
      low_ = std::floor(std::log10(low_));
      high_ = std::max(std::ceil(std::log10(high_)), low_ + 1);
      const int step = high_ - low_ > 8 ? 2 : 1;
      for (double e = low_; e <= high_; e += step) ticks_.push_back({place_log(e), power(e)});
    }
    if (zero_) ticks_.push_back({from_, "0"});
    return;
  }
  low_ = 0;
  high_ = values.empty() ? 1 : *std::max_element(values.begin(), values.end());
  if (!(high_ > 0)) high_ = 1;
  const double most = std::max(2.0, std::floor(std::fabs(to - from) / room_of(from, to)));
  const double step = round_up(high_ / most);
  high_ = std::ceil(high_ / step * (1 - 1e-12)) * step;
  for (int i = 0; i * step <= high_ * 1.0001; ++i) ticks_.push_back({place(i * step), tidy(i * step)});
}

double scale::place(double v) const {
  if (log_) return v <= 0 ? from_ : place_log(std::log10(v));
  return from_ + (to_ - from_) * (v - low_) / (high_ - low_);
}

double scale::place_log(double e) const {
  const double begin = zero_ ? from_ + (to_ - from_) * 0.1 : from_;
  return begin + (to_ - begin) * (e - low_) / (high_ - low_);
}

}  // namespace svg_parts
}  // namespace bitshade
