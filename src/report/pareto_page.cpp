// The part of a report that shows accuracy against time and bytes.
#include <algorithm>

#include "io/text.hpp"
#include "report/figures.hpp"
#include "report/html_table.hpp"
#include "report/pareto.hpp"
#include "report/plot.hpp"

namespace bitshade {
namespace {

/// The plot of one cost; `cost` gives a row's, with its spread where there is one.
template <class Cost>
std::string plot_of(const pareto_front& f, const std::vector<int>& by, axis x,
                    const std::string& name, bool spreads, Cost cost) {
  plot p;
  p.name = name;
  p.x = std::move(x);
  p.y = {"error (" + f.measure + ")", true, {}};
  std::vector<std::string> techniques;
  for (const row& r : f.rows)
    if (std::find(techniques.begin(), techniques.end(), r.technique) == techniques.end())
      techniques.push_back(r.technique);
  series front{"the front", -1, true, {}, {}, {}, false};
  int colour = 0;
  for (const std::string& technique : techniques) {
    series points{technique, colour++, false, {}, {}};
    for (std::size_t i = 0; i < f.rows.size(); ++i) {
      const row& r = f.rows[i];
      if (r.technique != technique) continue;
      const spread c = cost(r);
      const double error = measured(r, f.measure);
      points.points.emplace_back(c.median, error);
      points.labels.push_back(f.labels[i] + ": error " + brief(error) + ", cost " +
                              brief(c.median) + (by[i] < 0 ? ", on the front" : ""));
      if (spreads) points.spread.emplace_back(c.low, c.high);
      if (by[i] < 0) front.points.emplace_back(c.median, error);
    }
    p.lines.push_back(points);
  }
  std::sort(front.points.begin(), front.points.end());
  p.lines.push_back(front);
  return svg(p);
}

std::string table_of(const pareto_front& f) {
  std::string body;
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const row& r = f.rows[i];
    const natural_times& n = r.natural;
    const auto number = [](double v, int digits = 3) { return number_cell(v, brief(v, digits)); };
    const auto by = [&](int other) {
      return word_cell(other < 0 ? "on the front" : f.labels[static_cast<std::size_t>(other)]);
    };
    body +=
        table_row(word_cell(f.labels[i]) + level_cell(measured(r, f.measure)) +
                  number(n.relative_map.median) + number(deviation(n.relative_map), 1) +
                  number(n.relative_shade.median) + number(deviation(n.relative_shade), 1) +
                  number(n.relative.median) + number(deviation(n.relative), 1) + number(n.map.median * 1e3) +
                  number(n.shade.median * 1e3) + number(r.bytes_per_texel) +
                  number(r.device.bytes_per_frame / 1e6) + number(r.device.fetches_per_sample) +
                  number(r.device.passes) + by(f.by_time[i]) + by(f.by_bytes[i]) +
                  word_cell(n.natural ? "as stored" : "native arithmetic alone") +
                  number(r.emulation_seconds * 1e3));
  }
  return sortable_table(
      {{"configuration", "", true},
       {"error", f.measure},
       {"map", "generation of the map, in frames of the reference"},
       {"±", "half the distance of its quartiles"},
       {"shade", "shading of the view, in frames of the reference"},
       {"±", "half the distance of its quartiles"},
       {"frame", "both; 1.0 is a single-layer VSM in binary32, run beside it"},
       {"±", "half the distance of its quartiles"},
       {"ms, map", "median"},
       {"ms, shade", "median"},
       {"B/texel", "all layers and channels"},
       {"MB/frame", "read and written by the passes and by the samples"},
       {"reads", "filtered reads of up to four channels a sample"},
       {"passes", "that make the map"},
       {"beaten in time by", "no more error for no more time", true},
       {"beaten in bytes by", "no more error for no more bytes a texel", true},
       {"texels", "in memory as their format's bits, or not", true},
       {"emulation only, ms",
        "what emulating the format costs this program; no device pays it, and no other column "
        "holds it"}},
      body);
}

std::string front_in_words(const pareto_front& f) {
  const auto list = [&](const std::vector<int>& by) {
    std::string names;
    for (std::size_t i = 0; i < by.size(); ++i)
      if (by[i] < 0) names += (names.empty() ? "" : "; ") + f.labels[i];
    return names;
  };
  return "Nothing has less error (" + f.measure + ") for no more time than: " + list(f.by_time) +
         "; nor for no more bytes a texel than: " + list(f.by_bytes) + ".";
}

}  // namespace

report_part html_pareto(const pareto_front& f, const std::string& command) {
  report_part part;
  part.title = "Accuracy against time";
  part.finding = front_in_words(f);
  part.text =
      "Every configuration ran with its texels in memory as the format's own bits, decoded when "
      "loaded and encoded when stored. Times are multiples of a frame of a single-layer VSM in "
      "binary32, run natively beside each: medians, with quartiles as bars.";
  if (const std::string doubt = doubt_of(f); !doubt.empty()) part.text += " " + doubt;
  part.body =
      figure(plot_of(f, f.by_time, {"time of a frame (1 = native binary32 VSM)", true, {}},
                     "Error against time, a mark a configuration", true,
                     [](const row& r) { return r.natural.relative; }),
             caption("What accuracy costs in time.",
                     "Down and to the left is better. Nothing beats what the dashed line joins. "
                     "Point at a mark for its name.",
                     command)) +
      figure(plot_of(f, f.by_bytes, {"bytes per texel, all layers", true, {}},
                     "Error against bytes per texel, a mark a configuration", false,
                     [](const row& r) {
                       const double bytes = r.bytes_per_texel;
                       return spread{bytes, bytes, bytes};
                     }),
             caption("What accuracy costs in memory.",
                     "The same configurations against the "
                     "size of a texel of the map.",
                     command)) +
      table_of(f);
  return part;
}

}  // namespace bitshade
