// Bar charts and histograms of depth.
#include <algorithm>
#include <cmath>

#include "io/text.hpp"
#include "report/svg_parts.hpp"

namespace bitshade {

using namespace svg_parts;

namespace {
/// Columns of a bar's label that leave room for the bar.
constexpr std::size_t widest_label = 44;
}  // namespace

std::string svg(const bar_chart& chart) {
  std::size_t longest = 0;
  double most = 0;
  for (const bar& b : chart.bars) {
    longest = std::max(longest, std::min(columns(b.label), widest_label));
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
    const bool whole = columns(b.label) <= widest_label;
    out +=
        text(from - 8, y + 15, whole ? b.label : b.label.substr(0, widest_label - 1) + "…", "end");
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
