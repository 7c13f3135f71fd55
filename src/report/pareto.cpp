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

struct named_measure {
  std::string_view name;
  double (*of)(const measures&);
};
constexpr std::array<named_measure, 7> named{{
    {"total-rmse", [](const measures& m) { return m.total.rmse; }},
    {"total-p999", [](const measures& m) { return m.total.p999; }},
    {"total-largest", [](const measures& m) { return m.total.largest; }},
    {"format-rmse", [](const measures& m) { return m.format.rmse; }},
    {"format-p999", [](const measures& m) { return m.format.p999; }},
    {"format-largest", [](const measures& m) { return m.format.largest; }},
    {"bleed-area", [](const measures& m) { return m.bleed_area; }},
}};

/// "by NAME in time and bytes", or nothing on both fronts.
std::string beaten(const pareto_front& f, std::size_t i) {
  const auto name = [&](int by) { return f.labels[static_cast<std::size_t>(by)]; };
  if (f.by_time[i] < 0 && f.by_bytes[i] < 0) return "";
  const std::string close = within_spread(f, i) ? " (within the spread)" : "";
  if (f.by_time[i] == f.by_bytes[i])
    return "by " + name(f.by_time[i]) + " in bytes and time" + close;
  std::string text;
  if (f.by_time[i] >= 0) text = "by " + name(f.by_time[i]) + " in time" + close;
  if (f.by_bytes[i] >= 0)
    text += (text.empty() ? "" : ", ") + ("by " + name(f.by_bytes[i])) + " in bytes";
  return text;
}

}  // namespace

double deviation(const spread& s) { return (s.high - s.low) / 2; }

double reference_seconds(const natural_times& n) {
  return n.relative.median > 0 ? (n.map.median + n.shade.median) / n.relative.median : 1;
}

bool within_spread(const pareto_front& f, std::size_t i) {
  if (f.by_time[i] < 0) return false;
  const spread& other = f.rows[static_cast<std::size_t>(f.by_time[i])].natural.relative;
  return other.high >= f.rows[i].natural.relative.low;
}

std::string doubt_of(const pareto_front& f) {
  const auto far_apart = [](const row& r) {
    const spread& t = r.natural.relative;
    return t.high > 1.5 * t.low;
  };
  const auto count = std::count_if(f.rows.begin(), f.rows.end(), far_apart);
  if (2 * static_cast<std::size_t>(count) < f.rows.size()) return "";
  return "The machine was busy: in " + std::to_string(count) + " of " +
         std::to_string(f.rows.size()) +
         " configurations the upper quartile of the time is over 1.5 times the lower one. Run it "
         "again on a quiet machine, or with more --repeats.";
}

double measured(const row& r, std::string_view measure) {
  std::vector<std::string_view> names;
  for (const named_measure& m : named) {
    if (m.name == measure) return m.of(r.figures);
    names.push_back(m.name);
  }
  throw usage_error("--measure: there is no '" + std::string(measure) + "'; " +
                    suggest(measure, names));
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
  std::vector<text_line> times{
      {"configuration", "error", "map", "+-", "shade", "+-", "frame", "+-", "", "emulation*"}},
      counts{{"configuration", "error", "B/texel", "MB/frame", "reads", "passes", ""}};
  std::string beaten_list;
  bool all_natural = true;
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const row& r = f.rows[i];
    const natural_times& n = r.natural;
    const std::string name =
        f.labels[i].size() <= 28 ? f.labels[i] : label_of(r) + " #" + std::to_string(i + 1);
    const std::string error = brief(measured(r, f.measure), 3);
    all_natural = all_natural && n.natural;
    times.push_back({name + (n.natural ? "" : " ?"), error, brief(n.relative_map.median, 2),
                     brief(deviation(n.relative_map), 1), brief(n.relative_shade.median, 2),
                     brief(deviation(n.relative_shade), 1), brief(n.relative.median, 3),
                     brief(deviation(n.relative), 1), f.by_time[i] < 0 ? "front" : "",
                     brief(r.emulation_seconds / reference_seconds(n), 2)});
    counts.push_back({name, error, std::to_string(r.bytes_per_texel),
                      brief(r.device.bytes_per_frame / 1e6, 3),
                      brief(r.device.fetches_per_sample, 3), std::to_string(r.device.passes),
                      f.by_bytes[i] < 0 ? "front" : ""});
    const std::string by = beaten(f, i);
    if (by.empty()) continue;
    const std::string label = name == f.labels[i] ? name : name + " (" + f.labels[i] + ")";
    std::size_t line = 0;
    for (const std::string& text : wrap(label + ": " + by, 76))
      beaten_list += (line++ == 0 ? "  " : "    ") + text + '\n';
  }
  const auto paragraph = [](const std::string& words) {
    std::string out;
    for (const std::string& line : wrap(words, 80)) out += line + '\n';
    return out;
  };
  std::string out = "Error (" + f.measure + ") against time\n" + text_table(times, {0, 8}) + '\n';
  const natural_times& first = f.rows.front().natural;
  out += paragraph(
      "1.0 is a frame of a single-layer VSM in binary32, run natively beside each (" +
      brief(reference_seconds(first) * 1e3) +
      " ms here); medians, +- half the distance of the quartiles of " +
      std::to_string(first.repeats) +
      " runs. Texels lie in memory as their format's bits, encoded and decoded as a device does." +
      (all_natural ? ""
                   : " ?: this configuration has no such storage here; its time is that of native "
                     "arithmetic alone."));
  if (const std::string doubt = doubt_of(f); !doubt.empty()) out += paragraph(doubt);
  out += paragraph(
      "* What emulating the format costs this program, in the same unit. No device pays it; no "
      "other column holds it.");
  out +=
      "\nError (" + f.measure + ") against what a GPU feels\n" + text_table(counts, {0, 6}) + '\n';
  out += paragraph(
      "B/texel: all layers and channels. MB/frame: read and written by passes and samples, nothing "
      "cached. reads: filtered reads of up to four channels a sample. passes: that make the map. "
      "The front is that of error and bytes a texel.");
  if (!beaten_list.empty()) out += "\nBeaten: no more error for no more cost\n" + beaten_list;
  return out;
}

nlohmann::ordered_json json_pareto(const pareto_front& f) {
  auto all = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const auto by = [&](int other) -> nlohmann::ordered_json {
      if (other < 0) return nullptr;
      return f.rows[static_cast<std::size_t>(other)].key;
    };
    const auto time = [](const spread& t) -> nlohmann::ordered_json {
      return {{"median", t.median}, {"low", t.low}, {"high", t.high}};
    };
    const row& r = f.rows[i];
    const natural_times& n = r.natural;
    all.push_back({{"key", r.key},
                   {"label", f.labels[i]},
                   {"configuration", r.configuration},
                   {"error", measured(r, f.measure)},
                   {"natural_storage", n.natural},
                   {"repeats", n.repeats},
                   {"relative_map", time(n.relative_map)},
                   {"relative_shade", time(n.relative_shade)},
                   {"relative_time", time(n.relative)},
                   {"reference_seconds", reference_seconds(n)},
                   {"emulation_only_seconds", r.emulation_seconds},
                   {"bytes_per_texel", r.bytes_per_texel},
                   {"bytes_per_frame", r.device.bytes_per_frame},
                   {"fetches_per_sample", r.device.fetches_per_sample},
                   {"passes", r.device.passes},
                   {"front_of_time", f.by_time[i] < 0},
                   {"front_of_bytes", f.by_bytes[i] < 0},
                   {"beaten_in_time_by", by(f.by_time[i])},
                   {"beaten_within_the_spread", within_spread(f, i)},
                   {"beaten_in_bytes_by", by(f.by_bytes[i])}});
  }
  return {{"measure", f.measure}, {"configurations", all}};
}

}  // namespace bitshade
