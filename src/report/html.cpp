#include "report/html.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "io/text.hpp"
#include "report/figures.hpp"
#include "report/html_table.hpp"
#include "report/labels.hpp"
#include "report/page.hpp"
#include "report/plot.hpp"
#include "report/summary.hpp"
#include "run/study.hpp"

namespace bitshade {
namespace {

std::string layers_cell(const row& r) {
  return r.technique == "lvsm" ? number_cell(r.layers, std::to_string(r.layers))
                               : number_cell(1, "–");
}

std::string method_table(const report_section& s) {
  std::string body;
  std::set<std::string> seen;
  for (const row& r : s.rows) {
    if (!seen.insert(method_of(r)).second) continue;
    const measures& m = r.figures;
    body += table_row(word_cell(r.technique) + layers_cell(r) + level_cell(m.method.rmse) +
                      level_cell(m.method.largest) + level_cell(m.method.p999) +
                      number_cell(m.method.signed_mean, brief(m.method.signed_mean)) +
                      level_cell(m.method_pcf.rmse) + level_cell(m.method_pcf.largest));
  }
  return sortable_table({{"technique", "", true},
                         {"layers", ""},
                         {"RMSE", "root of the mean squared error"},
                         {"largest", "at the worst pixel"},
                         {"99.9 %", "99.9 % of the pixels have at most this error"},
                         {"mean", "signed: positive is too light"},
                         {"RMSE, PCF", "against percentage-closer filtering of the same map"},
                         {"largest, PCF", "against percentage-closer filtering of the same map"}},
                        body);
}

std::string format_table(const report_section& s) {
  const std::vector<std::string> settings = settings_of(s.rows);
  const bool told = std::any_of(settings.begin(), settings.end(),
                                [](const std::string& text) { return !text.empty(); });
  std::string body;
  for (std::size_t i = 0; i < s.rows.size(); ++i) {
    const row& r = s.rows[i];
    const measures& m = r.figures;
    body += table_row(word_cell(r.technique) + layers_cell(r) + word_cell(r.format) +
                      (told ? word_cell(settings[i]) : "") + level_cell(m.format.rmse) +
                      level_cell(m.format.largest) + level_cell(m.format.p999) +
                      level_cell(m.total.rmse) + number_cell(m.bleed_area, percent(m.bleed_area)) +
                      number_cell(m.acne_area, percent(m.acne_area)) +
                      number_cell(static_cast<double>(m.violations), std::to_string(m.violations)) +
                      (r.bytes_per_texel == 0
                           ? number_cell(1e9, "–")
                           : number_cell(r.bytes_per_texel, std::to_string(r.bytes_per_texel))) +
                      number_cell(r.map_seconds, brief(r.map_seconds * 1e3)) +
                      number_cell(r.nanoseconds_per_sample(), brief(r.nanoseconds_per_sample())) +
                      number_cell(r.emulation_seconds, brief(r.emulation_seconds * 1e3)));
  }
  std::vector<table_column> heads{
      {"technique", "", true},
      {"layers", ""},
      {"format", "", true},
      {"RMSE", "of the format alone"},
      {"largest", "of the format alone, at the worst pixel"},
      {"99.9 %", "99.9 % of the pixels have at most this format error"},
      {"total RMSE", "technique and format against the geometric truth"},
      {"bleed %", "share of receivers that are dark in truth and lit by more than 1/255"},
      {"acne %", "share of receivers that are lit in truth and darker by more than 1/255"},
      {"below PCF", "pixels where the upper bound does not hold"},
      {"B/texel", "bytes per texel, all layers and channels"},
      {"ms/map", "generation of the map, native arithmetic"},
      {"ns/sample", "shading, native arithmetic"},
      {"emulation",
       "milliseconds that rounding to the format cost here; a device does not pay it"}};
  if (told)
    heads.insert(heads.begin() + 3, {"settings", "what tells it from others of its name", true});
  return sortable_table(heads, body);
}

std::string effects_list(const report_section& s) {
  std::string out = "<dl class=\"effects\">";
  std::string before;
  for (const effect_summary& e : effects_of(s.rows)) {
    if (e.name != before) {
      if (!before.empty()) out += "</dd>";
      out += "<dt>" + escaped(e.name) + "</dt><dd>";
    } else {
      out += "<br>";
    }
    before = e.name;
    std::string by;
    for (std::size_t i = 0; i < e.by.size() && i < 4; ++i) by += (i ? ", " : "") + e.by[i];
    if (e.by.size() > 4) by += " and " + std::to_string(e.by.size() - 4) + " more";
    by = e.by.size() == s.rows.size() ? "" : " <span class=\"by\">(" + escaped(by) + ")</span>";
    out += std::string("<span class=\"badge ") + (e.needed ? "yes\">needed" : "\">left out") +
           "</span>" + escaped(e.evidence) + by;
  }
  return out + "</dd></dl>\n";
}

std::string notes_of(const report_section& s) {
  std::vector<std::string> notes;
  const std::vector<std::string> labels = distinct_labels(s.rows);
  for (std::size_t i = 0; i < s.rows.size(); ++i)
    for (const std::string& n : s.rows[i].notes) {
      const std::string text = labels[i] + ": " + n;
      if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
    }
  if (notes.empty()) return "";
  std::string out = "<h3>Notes</h3><ul>";
  for (const std::string& n : notes) out += "<li>" + escaped(n) + "</li>";
  return out + "</ul>\n";
}

std::string still(const report_section& s, const std::string& kind, const std::string& title,
                  const std::string& text) {
  const auto found = s.pictures.find(kind);
  if (found == s.pictures.end()) return "";
  return "<figure><img class=\"still\" alt=\"" + escaped(title) + "\" src=\"" +
         data_uri(found->second) + "\">" + caption(title, text, s.command) + "</figure>\n";
}

std::string section(const report_section& s, std::size_t number) {
  std::string out = "<section id=\"input-" + std::to_string(number) + "\"><h2>" +
                    escaped(s.input.name) + "</h2>\n";
  const auto info = nlohmann::json::parse(s.input.description, nullptr, false);
  if (info.is_object() && info.contains("summary"))
    out += "<p class=\"soft\">" + escaped(info["summary"]) +
           (info.contains("seed") ? " Seed " + info["seed"].dump() + "." : "") + "</p>\n";
  out += "<ul class=\"findings\">";
  for (const std::string& f : findings(s.rows)) out += "<li>" + escaped(f) + "</li>";
  for (const report_part& p : s.parts)
    if (!p.finding.empty()) out += "<li>" + escaped(p.finding) + "</li>";
  out += "</ul>\n" + still(s, "shaded", "The scene.",
                           "Lit by the light under study, with the "
                           "geometric truth as its shadow.");
  for (const report_part& p : s.parts)
    out += "<h3>" + escaped(p.title) + "</h3>" +
           (p.text.empty() ? "" : "<p>" + escaped(p.text) + "</p>") + p.body;
  out +=
      "<h3>Format error, and what each configuration costs</h3>"
      "<p>The technique in the format, against itself in exact arithmetic: what the numbers alone "
      "do. Click a heading to sort.</p>" +
      format_table(s);
  out +=
      "<h3>Method error</h3><p>The technique in exact arithmetic, against the truth: what no "
      "format can mend. The geometric truth is the part of the filter's footprint that does not "
      "hide the receiver's tangent plane; PCF is percentage-closer filtering of the same depth map "
      "with the same kernel.</p>" +
      method_table(s);
  out += "<h3>Pictures</h3>" + slider_of(s);
  out += "<h3>Plots</h3>" + plots_of(s);
  out +=
      "<h3>Effects: what this scene calls for</h3><p>An effect is simulated only where it can "
      "change a pixel; leaving it out gives the same bits, which <code>--verify-plan</code> "
      "shows.</p>" +
      effects_list(s) + notes_of(s);
  return out + "</section>\n";
}

}  // namespace

std::string html_page(const report_head& head, const std::string& title, const std::string& body) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         escaped(title) + "</title>\n<style>" + std::string(page_style()) +
         "</style></head>\n<body>\n<header><h1>" + escaped(title) +
         "</h1>\n<p class=\"soft\">" + escaped(head.subject) +
         "</p>\n<code class=\"command\">" +
         escaped(head.command) + "</code>\n</header>\n" + body +
         "<footer><h2>About this report</h2><p>bitshade " + escaped(head.version) +
         ", built with " + escaped(head.compiler) + ". Times were taken on " +
         escaped(head.machine) + "." +
         (head.seed.empty() ? ""
                            : " Seed " + escaped(head.seed) +
                                  " for whatever is random in the scenes.") +
         " Everything but the times is the same on every machine, for any number of threads. The "
         "figures stand in " +
         escaped(head.files) + ".</p></footer>\n<script>" +
         std::string(page_script()) + "</script>\n</body></html>\n";
}

std::string html_report(const report_head& head, const std::vector<report_section>& sections) {
  std::string title = "bitshade:", body;
  for (std::size_t i = 0; i < sections.size(); ++i)
    title += (i ? ", " : " ") + sections[i].input.name;
  if (sections.size() > 1) {
    body += "<nav><p>";
    for (std::size_t i = 0; i < sections.size(); ++i)
      body += "<a href=\"#input-" + std::to_string(i) + "\">" + escaped(sections[i].input.name) +
              "</a>";
    body += "</p></nav>\n";
  }
  body += "<main>\n";
  for (std::size_t i = 0; i < sections.size(); ++i) body += section(sections[i], i);
  return html_page(head, title, body + "</main>\n");
}

}  // namespace bitshade
