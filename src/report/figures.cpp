#include "report/figures.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "io/base64.hpp"
#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/maps.hpp"
#include "report/plot.hpp"
#include "run/study.hpp"

namespace bitshade {
namespace {

std::vector<std::string> formats_of(const report_section& s) {
  std::vector<std::string> formats;
  for (const row& r : s.rows)
    if (std::find(formats.begin(), formats.end(), r.format) == formats.end())
      formats.push_back(r.format);
  return formats;
}

/// Bars and pictures that a page shows of a section; of more rows those of least total error.
constexpr std::size_t most_bars = 48, most_pictures = 48;

/// The end of a caption where not everything is shown.
std::string of_all(std::size_t shown, std::size_t all) {
  if (shown == all) return "";
  return " Shown are the " + std::to_string(shown) + " of " + std::to_string(all) +
         " configurations with the least total error.";
}

/// The least of the points above each x, in rising order: of several settings the best.
void keep_least(series& line) {
  std::vector<std::size_t> order(line.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair(line.points[i], i) < std::pair(line.points[j], j);
  });
  series kept{line.name, line.colour, line.line, {}, {}};
  for (const std::size_t i : order) {
    if (!kept.points.empty() && kept.points.back().first == line.points[i].first) continue;
    kept.points.push_back(line.points[i]);
    kept.labels.push_back(line.labels[i]);
  }
  line = kept;
}

/// Format error against layers, with the method's own error for comparison.
std::string error_against_layers(const report_section& s) {
  std::set<double> counts;
  for (const row& r : s.rows)
    if (r.technique == "lvsm") counts.insert(r.layers);
  if (counts.size() < 2) return "";
  plot p;
  p.name = "Error against the number of layers, a line a format";
  p.x = {"layers", true, {counts.begin(), counts.end()}};
  p.y = {"error (RMSE of visibility)", true, {}};
  series method{"method (exact)", -1, true, {}, {}};
  std::set<std::string> done;
  int colour = 0;
  for (const std::string& format : formats_of(s)) {
    series line{format, colour, true, {}, {}};
    for (const row& r : s.rows) {
      if (r.technique != "lvsm" || r.format != format) continue;
      if (done.insert(method_of(r)).second) {
        method.points.push_back({r.layers, r.figures.method.rmse});
        method.labels.push_back("method, " + std::to_string(r.layers) +
                                " layers: " + brief(r.figures.method.rmse));
      }
      if (format == "exact") continue;
      line.points.push_back({r.layers, r.figures.format.rmse});
      line.labels.push_back(label_of(r) + ": " + brief(r.figures.format.rmse));
    }
    keep_least(line);
    if (!line.points.empty()) p.lines.push_back(line), ++colour;
  }
  keep_least(method);
  p.lines.push_back(method);
  return figure(svg(p),
                caption("What layers buy.",
                        "Solid: what each format adds to a layered variance shadow map, against "
                        "the same technique in "
                        "exact arithmetic. Dashed: what the method itself is wrong by, against the "
                        "geometric truth. "
                        "Below 1/255 = 0.0039 an error is smaller than a step of an 8-bit display.",
                        s.command));
}

/// Total error against bytes per texel.
std::string error_against_bytes(const report_section& s) {
  plot p;
  p.name = "Format error against bytes per texel";
  std::set<double> sizes;
  int colour = 0;
  std::vector<std::string> techniques;
  for (const row& r : s.rows)
    if (std::find(techniques.begin(), techniques.end(), r.technique) == techniques.end())
      techniques.push_back(r.technique);
  for (const std::string& technique : techniques) {
    series line{technique, colour++, false, {}, {}};
    for (const row& r : s.rows) {
      if (r.technique != technique || r.bytes_per_texel == 0) continue;
      sizes.insert(r.bytes_per_texel);
      line.points.push_back({r.bytes_per_texel, r.figures.format.p999});
      line.labels.push_back(label_of(r) + ": " + std::to_string(r.bytes_per_texel) + " bytes, " +
                            brief(r.figures.format.p999));
    }
    if (!line.points.empty()) p.lines.push_back(line);
  }
  if (sizes.size() < 2) return "";
  p.x = {"bytes per texel (all layers)", true, {sizes.begin(), sizes.end()}};
  p.y = {"format error (99.9th percentile)", true, {}};
  return figure(svg(p), caption("What bytes buy.",
                                "Each mark is a configuration; point at one for its name. Down and "
                                "to the left is better: less "
                                "error in less memory.",
                                s.command));
}

std::string area_bars(const report_section& s) {
  bar_chart chart;
  chart.name = "Bleed area and acne area of every configuration";
  chart.unit = "share of receivers (%)";
  chart.parts = {"bleeds: dark in truth, lit here", "acne: lit in truth, dark here"};
  const std::vector<row> rows = telling_rows(s.rows, most_bars);
  const std::vector<std::string> labels = distinct_labels(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const row& r = rows[i];
    chart.bars.push_back(
        {labels[i],
         {r.figures.bleed_area * 100, r.figures.acne_area * 100},
         r.figures.bleed_area + r.figures.acne_area == 0
             ? "none"
             : percent(r.figures.bleed_area) + " + " + percent(r.figures.acne_area)});
  }
  return figure(svg(chart), caption("Where a user would see it.",
                                    "Share of receivers whose visibility is wrong by more than "
                                    "1/255 although the truth is fully "
                                    "dark (bleeding) or fully lit (acne)." +
                                        of_all(rows.size(), s.rows.size()),
                                    s.command));
}

std::string time_bars(const report_section& s) {
  bar_chart chart;
  chart.name = "Time to make and to sample each map";
  chart.unit = "milliseconds, native arithmetic on this machine's processor";
  chart.parts = {"generation of the map", "shading of the view"};
  const std::vector<row> rows = telling_rows(s.rows, most_bars);
  const std::vector<std::string> labels = distinct_labels(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const row& r = rows[i];
    if (r.format == "exact") continue;  // its own arithmetic, not a device's
    chart.bars.push_back({labels[i],
                          {r.map_seconds * 1e3, r.shade_seconds * 1e3},
                          brief((r.map_seconds + r.shade_seconds) * 1e3)});
  }
  if (chart.bars.empty()) return "";
  return figure(svg(chart), caption("What it costs in time.",
                                    "Once per configuration, without the cost of emulating a "
                                    "format; read ratios, not absolute "
                                    "times. Exact arithmetic is left out: no device runs it." +
                                        of_all(rows.size(), s.rows.size()),
                                    s.command));
}

std::string depth_histogram(const report_section& s) {
  const auto info = nlohmann::json::parse(s.input.description, nullptr, false);
  if (!info.is_object() || !info.contains("occluder_histogram")) return "";
  depth_chart chart;
  chart.name = "Histogram of occluder and receiver depths, with the layers' boundaries";
  chart.occluders = info.value("occluder_histogram", std::vector<double>{});
  chart.receivers = info.value("receiver_histogram", std::vector<double>{});
  std::set<std::string> seen;
  for (const row& r : s.rows) {
    if (r.technique != "lvsm" || r.layers < 2 || r.splits.size() < 3) continue;
    const std::string label = "N = " + std::to_string(r.layers);
    if (!seen.insert(label + r.configuration.substr(r.configuration.find("splits"))).second)
      continue;
    if (chart.splits.size() < 12) chart.splits.push_back({label, r.splits});
  }
  return figure(svg(chart), caption("Where the depths are, and where the layers.",
                                    "Above the line the depth map's texels, below it the "
                                    "receivers. Ticks in the lanes are the "
                                    "boundaries of the layers.",
                                    s.command));
}

}  // namespace

std::string figure(const std::string& inside, const std::string& caption_text) {
  return "<figure>\n<div class=\"plot\">" + inside + "</div>\n" + caption_text + "</figure>\n";
}

std::string data_uri(const std::string& png) { return "data:image/png;base64," + base64(png); }

std::string caption(const std::string& title, const std::string& text, const std::string& command) {
  return "<figcaption><b>" + escaped(title) + "</b> " + escaped(text) + "<code class=\"command\">" +
         escaped(command) + "</code></figcaption>";
}

std::string plots_of(const report_section& s) {
  return error_against_layers(s) + error_against_bytes(s) + area_bars(s) + time_bars(s) +
         depth_histogram(s);
}

std::string slider_of(const report_section& s) {
  nlohmann::ordered_json data;
  data["none"] = "";
  auto& cells = data["cells"] = nlohmann::ordered_json::array();
  const auto info = nlohmann::json::parse(s.input.description, nullptr, false);
  int w = 0, h = 0;
  if (info.is_object() && info.contains("view")) w = info["view"][0], h = info["view"][1];
  if (w > 0 && h > 0) {
    const std::vector<double> none(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    data["none"] = data_uri(encode_png(error_map(none, none, w, h)));
  }
  const auto truth = [&](const std::string& kind, const std::string& label) {
    const auto found = s.pictures.find(kind);
    if (found == s.pictures.end()) return;
    cells.push_back({{"label", label},
                     {"command", s.command},
                     {"pictures", {{"visibility", data_uri(found->second)}}}});
  };
  truth("truth", "geometric truth");
  truth("truth-pcf", "percentage-closer truth");
  const std::size_t first = cells.size();
  const std::vector<row> rows = telling_rows(s.rows, most_pictures);
  const std::vector<std::string> labels = distinct_labels(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const row& r = rows[i];
    const auto pictures = s.cells.find(r.key);
    if (pictures == s.cells.end()) continue;
    nlohmann::ordered_json files = nlohmann::ordered_json::object();
    for (const auto& [kind, png] : pictures->second) files[kind] = data_uri(png);
    const auto command = s.commands.find(r.key);
    cells.push_back({{"label", labels[i]},
                     {"command", command == s.commands.end() ? s.command : command->second},
                     {"pictures", files}});
  }
  if (cells.size() == first) return "";

  const auto options = [&](std::size_t chosen) {
    std::string out;
    for (std::size_t i = 0; i < cells.size(); ++i)
      out += "<option value=\"" + std::to_string(i) + "\"" + (i == chosen ? " selected" : "") +
             ">" + escaped(cells[i]["label"]) + "</option>";
    return out;
  };
  std::string json = data.dump();
  // "</script" may not stand inside a script element.
  for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos;)
    json.replace(at, 2, "<\\/");
  return "<figure class=\"slider\">\n<div class=\"choices\">"
         "<label>left <select name=\"a\">" +
         options(0) +
         "</select></label>"
         "<label>right <select name=\"b\">" +
         options(first) +
         "</select></label>"
         "<label>show <select name=\"kind\"><option value=\"visibility\">visibility</option>"
         "<option value=\"error\">error against the truth</option>"
         "<option value=\"format-error\">error of the format "
         "alone</option></select></label></div>\n"
         "<div class=\"compare\"><img class=\"b\" alt=\"\"><img class=\"a over\" alt=\"\">"
         "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" "
         "aria-label=\"boundary between the left and the right picture\">"
         "<span class=\"edge\"></span><span class=\"tag a\"></span><span class=\"tag "
         "b\"></span></div>\n"
         "<figcaption><b>Two configurations side by side.</b> Drag the line. In error maps blue is "
         "too dark, orange too light, near-white right to within 1e-4; the scale is logarithmic "
         "and "
         "the same in every map.<code class=\"command\"></code><code class=\"command\"></code>"
         "</figcaption>\n<script type=\"application/json\">" +
         json + "</script></figure>\n";
}

}  // namespace bitshade
