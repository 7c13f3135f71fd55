#include "report/pareto.hpp"

#include <algorithm>
#include <array>

#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/text_table.hpp"
#include "run/study.hpp"

namespace bitshade {
namespace {

constexpr std::array<std::string_view, 7> names{"total-rmse",  "total-p999",  "total-largest",
                                                "format-rmse", "format-p999", "format-largest",
                                                "bleed-area"};

std::string mark_of(const pareto_front& f, std::size_t i) {
  return std::string(f.by_time[i] < 0 ? "T" : "-") + (f.by_bytes[i] < 0 ? "B" : "-");
}

/// "by NAME in time and bytes", or nothing on both fronts.
std::string beaten(const pareto_front& f, std::size_t i) {
  const auto name = [&](int by) { return f.labels[static_cast<std::size_t>(by)]; };
  if (f.by_time[i] < 0 && f.by_bytes[i] < 0) return "";
  if (f.by_time[i] == f.by_bytes[i]) return "by " + name(f.by_time[i]) + " in time and bytes";
  std::string text;
  if (f.by_time[i] >= 0) text = "by " + name(f.by_time[i]) + " in time";
  if (f.by_bytes[i] >= 0)
    text += (text.empty() ? "" : ", ") + ("by " + name(f.by_bytes[i])) + " in bytes";
  return text;
}

}  // namespace

std::span<const std::string_view> measure_names() { return names; }

double measured(const row& r, std::string_view measure) {
  const auto at = std::find(names.begin(), names.end(), measure);
  const measures& m = r.figures;
  switch (at - names.begin()) {
    case 0:
      return m.total.rmse;
    case 1:
      return m.total.p999;
    case 2:
      return m.total.largest;
    case 3:
      return m.format.rmse;
    case 4:
      return m.format.p999;
    case 5:
      return m.format.largest;
    case 6:
      return m.bleed_area;
    default:
      throw usage_error("--measure: there is no '" + std::string(measure) + "'; " +
                        suggest(measure, names));
  }
}

std::vector<int> beaten_by(std::span<const std::pair<double, double>> points) {
  const auto beats = [&](std::size_t i, std::size_t j) {
    return points[i].first <= points[j].first && points[i].second <= points[j].second &&
           points[i] != points[j];
  };
  std::vector<bool> front(points.size(), true);
  for (std::size_t j = 0; j < points.size(); ++j)
    for (std::size_t i = 0; i < points.size() && front[j]; ++i) front[j] = !beats(i, j);
  std::vector<int> by(points.size(), -1);
  for (std::size_t j = 0; j < points.size(); ++j)
    for (std::size_t i = 0; i < points.size() && !front[j]; ++i) {
      if (!front[i] || !beats(i, j)) continue;
      const auto before = static_cast<std::size_t>(std::max(by[j], 0));
      if (by[j] < 0 || points[i] < points[before]) by[j] = static_cast<int>(i);
    }
  return by;
}

pareto_front pareto_of(std::span<const row> rows, const std::string& measure) {
  pareto_front f;
  f.measure = measure;
  std::vector<std::pair<double, double>> times, bytes;
  for (const row& r : rows) {
    if (r.bytes_per_texel == 0) continue;
    f.rows.push_back(r);
    times.emplace_back(measured(r, measure), r.natural.relative.median);
    bytes.emplace_back(measured(r, measure), r.bytes_per_texel);
  }
  f.labels = distinct_labels(f.rows);
  f.by_time = beaten_by(times);
  f.by_bytes = beaten_by(bytes);
  return f;
}

std::string text_pareto(const pareto_front& f) {
  std::vector<text_line> lines{{"configuration", "error", "map", "shade", "frame", "+-", "B/tx",
                                "MB", "reads", "pass", "", "emul*"}};
  std::vector<std::string> beaten_lines;
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const row& r = f.rows[i];
    const natural_times& n = r.natural;
    const double unit = n.relative.median > 0 ? (n.map.median + n.shade.median) / n.relative.median
                                              : 1;  // seconds of the reference
    lines.push_back(
        {f.labels[i].size() <= 22 ? f.labels[i] : label_of(r) + " #" + std::to_string(i + 1),
         brief(measured(r, f.measure), 3), brief(n.relative_map, 2), brief(n.relative_shade, 2),
         brief(n.relative.median, 3) + (n.natural ? "" : "?"),
         brief((n.relative.high - n.relative.low) / 2, 1), std::to_string(r.bytes_per_texel),
         brief(r.device.bytes_per_frame / 1e6, 3), brief(r.device.fetches_per_sample, 2),
         std::to_string(r.device.passes), mark_of(f, i), brief(r.emulation_seconds / unit, 2)});
    const std::string by = beaten(f, i);
    if (!by.empty()) beaten_lines.push_back(f.labels[i] + ": " + by);
  }
  std::string out = "Error (" + f.measure + ") against time at the storage's natural speed\n" +
                    text_table(lines, {0, 10});
  out +=
      "\nmap, shade, frame: 1.0 is a frame of a single-layer VSM in binary32, run natively\n"
      "beside each; medians, +- half the quartiles' distance. MB: read and written a\n"
      "frame. reads: filtered reads a sample. T, B: on the front of time, of bytes a\n"
      "texel. ?: no natural storage here; time is that of native arithmetic alone.\n"
      "emul*: what emulating the format costs this program, in the same unit. No device\n"
      "pays it; no other column holds it.\n";
  bool first = true;
  for (const std::string& line : beaten_lines) {
    if (first) out += "\nBeaten: no more error for no more cost\n";
    first = false;
    std::size_t n = 0;
    for (const std::string& text : wrap(line, 76)) out += (n++ == 0 ? "  " : "    ") + text + '\n';
  }
  return out;
}

nlohmann::ordered_json json_pareto(const pareto_front& f) {
  auto all = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const auto by = [&](int other) -> nlohmann::ordered_json {
      if (other < 0) return nullptr;
      return f.rows[static_cast<std::size_t>(other)].key;
    };
    all.push_back({{"key", f.rows[i].key},
                   {"label", f.labels[i]},
                   {"error", measured(f.rows[i], f.measure)},
                   {"relative_time", f.rows[i].natural.relative.median},
                   {"front_of_time", f.by_time[i] < 0},
                   {"front_of_bytes", f.by_bytes[i] < 0},
                   {"beaten_in_time_by", by(f.by_time[i])},
                   {"beaten_in_bytes_by", by(f.by_bytes[i])}});
  }
  return {{"measure", f.measure}, {"configurations", all}};
}

}  // namespace bitshade
