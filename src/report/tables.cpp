#include <algorithm>
#include <set>

#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/summary.hpp"
#include "report/text_table.hpp"

namespace bitshade {
namespace {

/// Lines of a table that a reader still follows.
constexpr std::size_t most_lines = 48;

std::string layers_of(const row& r) {
  return r.technique == "lvsm" ? std::to_string(r.layers) : "-";
}

std::string milliseconds(double seconds) { return brief(seconds * 1e3, 3); }

}  // namespace

std::string text_tables(std::span<const row> all) {
  if (all.empty()) return "";
  const std::vector<row> rows = telling_rows(all, most_lines);
  std::vector<text_line> methods{{"name", "N", "rmse", "largest", "p99.9", "mean", "vs pcf"}};
  std::set<std::string> seen;
  for (const row& r : rows) {
    if (!seen.insert(method_of(r)).second) continue;
    const measures& m = r.figures;
    methods.push_back({r.technique, layers_of(r), brief(m.method.rmse), brief(m.method.largest),
                       brief(m.method.p999), brief(m.method.signed_mean),
                       brief(m.method_pcf.rmse)});
  }
  std::string out =
      "Method error: the technique in exact arithmetic against the geometric truth\n" +
      text_table(methods, {0}) + '\n';

  const std::vector<std::string> settings = settings_of(rows);
  const bool numbered = std::any_of(settings.begin(), settings.end(),
                                    [](const std::string& s) { return !s.empty(); });
  std::vector<text_line> formats{{"name", "N", "format", "rmse", "largest", "p99.9", "bleed%",
                                  "acne%", "B/tx", "ms/map", "ns"}};
  if (numbered) formats.front().insert(formats.front().begin(), "#");
  std::string legend;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const row& r = rows[i];
    const measures& m = r.figures;
    const bool exact = r.format == "exact";
    text_line l{r.technique,
                layers_of(r),
                r.format,
                exact ? "0" : brief(m.format.rmse, 2),
                exact ? "0" : brief(m.format.largest, 2),
                exact ? "0" : brief(m.format.p999, 2),
                percent(m.bleed_area),
                percent(m.acne_area),
                r.bytes_per_texel == 0 ? "-" : std::to_string(r.bytes_per_texel),
                milliseconds(r.map_seconds),
                brief(r.nanoseconds_per_sample(), 3)};
    if (numbered) l.insert(l.begin(), std::to_string(i + 1));
    formats.push_back(l);
    if (settings[i].empty()) continue;
    const std::string head = pad_left(std::to_string(i + 1), 4) + "  ";
    std::size_t n = 0;
    for (const std::string& text : wrap(settings[i], 80 - head.size()))
      legend += (n++ == 0 ? head : std::string(head.size(), ' ')) + text + '\n';
  }
  out += "Format error: the technique in the format against itself in exact arithmetic\n" +
         text_table(formats, numbered ? std::set<std::size_t>{1, 3} : std::set<std::size_t>{0, 2});
  if (rows.size() < all.size())
    out += "These are the " + std::to_string(rows.size()) + " of " + std::to_string(all.size()) +
           " configurations with the least total error;\nresults.csv holds all of them.\n";
  if (!legend.empty()) out += "\nWhat tells configurations of one name apart:\n" + legend;
  out +=
      "\nbleed%, acne%: share of receivers that should be dark and are not, or lit and\n"
      "are not, by more than 1/255. B/tx: bytes per texel, all layers. ns: per sample.\n"
      "Times are native arithmetic; those of exact are the exact arithmetic's own.\n";
  return out;
}

std::vector<effect_summary> effects_of(std::span<const row> rows) {
  std::vector<effect_summary> all;
  for (const row& r : rows)
    for (const effect& e : r.effects) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const effect_summary& s) {
        return s.name == e.name && s.evidence == e.evidence && s.needed == e.simulated();
      });
      const std::string label =
          r.technique + (r.technique == "lvsm" ? " " + layers_of(r) : "") + " " + r.format;
      if (same == all.end())
        all.push_back({e.name, e.simulated(), {label}, e.evidence});
      else if (std::find(same->by.begin(), same->by.end(), label) == same->by.end())
        same->by.push_back(label);
    }
  std::vector<std::string> order;  // as the plan names them
  for (const effect_summary& e : all)
    if (std::find(order.begin(), order.end(), e.name) == order.end()) order.push_back(e.name);
  std::stable_sort(all.begin(), all.end(), [&](const effect_summary& a, const effect_summary& b) {
    return std::find(order.begin(), order.end(), a.name) <
           std::find(order.begin(), order.end(), b.name);
  });
  return all;
}

std::string text_effects(std::span<const row> rows) {
  std::string out = "Effects: what this scene calls for, and what was left out\n";
  std::string before;
  for (const effect_summary& e : effects_of(rows)) {
    const std::string name = e.name == before ? "" : e.name;
    before = e.name;
    std::string who = e.by.size() == rows.size() ? ""
                      : e.by.size() > 3          ? std::to_string(e.by.size()) + " configurations"
                                                 : "";
    if (e.by.size() != rows.size() && e.by.size() <= 3)
      for (const std::string& label : e.by) who += (who.empty() ? "" : ", ") + label;
    const std::string head = "  " + pad_right(name, 24) + (e.needed ? " yes  " : " no   ");
    std::size_t n = 0;
    for (const std::string& text :
         wrap(e.evidence + (who.empty() ? "" : " (" + who + ")"), 80 - columns(head)))
      out += (n++ == 0 ? head : std::string(columns(head), ' ')) + text + '\n';
  }
  return out;
}

}  // namespace bitshade
