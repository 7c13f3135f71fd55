// What a run of claims found, for a browser.
#include "claims/report.hpp"
#include "io/text.hpp"
#include "report/html_table.hpp"
#include "report/plot.hpp"

namespace bitshade::claims {
namespace {

std::string item(const std::string& text) { return "<li>" + text + "</li>"; }

std::string list_of(std::span<const claim_report> all, const verdict_heading& heading) {
  std::string list;
  for (const claim_report& r : all) {
    if (r.found.result() != heading.found) continue;
    const std::string id = r.what.id;
    list += item("<a href=\"#" + id + "\">" + id + "</a> " + escaped(r.what.sentence) +
                 (heading.found == verdict::holds
                      ? ""
                      : " <em>" + escaped(verdict_sentence(r.found)) + ".</em>"));
  }
  return list.empty() ? ""
                      : "<h2>" + escaped(heading.title) + "</h2><p>" + escaped(heading.words) +
                            "</p><ul>" + list + "</ul>\n";
}

std::string figures_table(const outcome& found) {
  std::string rows;
  for (const figure& f : found.figures)
    rows += table_row(word_cell(f.name + (f.timed ? " *" : "")) +
                      number_cell(f.value, brief_or_whole(f.value, 3)) + word_cell(f.unit));
  return rows.empty()
             ? ""
             : sortable_table({{"measured", "* a time", true}, {"value", ""}, {"unit", "", true}},
                              rows);
}

std::string bounds_table(const outcome& found) {
  std::string rows;
  for (const bound& b : found.bounds)
    rows += table_row(word_cell(b.text) + number_cell(b.measured, brief_or_whole(b.measured, 3)) +
                      number_cell(b.predicted, brief_or_whole(b.predicted, 3)) +
                      word_cell(b.kept() ? "kept" : "exceeded"));
  return rows.empty()
             ? ""
             : sortable_table(
                   {{"predicted bound", "", true}, {"measured", ""}, {"limit", ""}, {"", "", true}},
                   rows);
}

std::string checks_list(const outcome& found) {
  std::string list;
  const auto line = [](const check& c) {
    return item((c.held ? "yes: " : "<strong>no</strong>: ") + escaped(c.text));
  };
  for (const check& c : found.claimed) list += line(c);
  std::string out = list.empty() ? "" : "<ul>" + list + "</ul>";
  if (found.conditional.empty()) return out;
  list.clear();
  for (const check& c : found.conditional) list += line(c);
  return out + "<p>Provided that " + escaped(found.condition) + ":</p><ul>" + list + "</ul>";
}

std::string example_of(const claim_report& r, const counterexample& c) {
  std::string numbers;
  for (const named_number& n : c.result)
    numbers += (numbers.empty() ? "" : ", ") + escaped(n.name) + " " +
               brief(static_cast<double>(n.value), 4);
  return "<p>Counterexample: " + numbers + ".<br><code class=\"command\">bitshade claims " +
         std::string(r.what.id) + " --replay \"" + escaped(c.numbers) + "\"</code></p>";
}

std::string details_of(const claim_report& r) {
  std::string out = "<section id=\"" + std::string(r.what.id) + "\"><h3>" + r.what.id + ": " +
                    escaped(verdict_sentence(r.found)) + "</h3><p>" + escaped(r.what.sentence) +
                    " " + escaped(r.what.source) + "</p><p class=\"soft\">" +
                    escaped(r.what.experiment) + "</p>";
  out += figures_table(r.found) + bounds_table(r.found) + checks_list(r.found);
  for (const counterexample& c : r.found.counterexamples) out += example_of(r, c);
  for (const std::string& remark : r.found.remarks) out += "<p>" + escaped(remark) + "</p>";
  return out + "</section>\n";
}

}  // namespace

std::string html_of(std::span<const claim_report> all) {
  std::string out = "<main><section><ul class=\"findings\">";
  for (const std::string& said : summary_sentences(all)) out += item(escaped(said));
  out += "</ul>\n";
  for (const verdict_heading& heading : verdict_headings()) out += list_of(all, heading);
  out += "</section>\n<h2>Every claim, with its figures</h2>\n";
  for (const claim_report& r : all) out += details_of(r);
  return out + "</main>\n";
}

}  // namespace bitshade::claims
