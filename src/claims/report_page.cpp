#include <nlohmann/json.hpp>

#include "claims/report.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

std::string section(const std::string& title, verdict wanted, std::span<const claim_report> all) {
  std::string list;
  for (const claim_report& r : all) {
    if (r.found.result() != wanted) continue;
    list += "- **" + std::string(r.what.id) + "** " + r.what.sentence;
    if (wanted != verdict::holds) list += " *" + verdict_sentence(r.found) + ".*";
    list += '\n';
  }
  return list.empty() ? "" : "## " + title + "\n" + list + '\n';
}

/// A text as a table's cell.
std::string cell_text(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

std::string block(const claim_report& r) {
  const outcome& found = r.found;
  std::string out = "### " + std::string(r.what.id) + ": " + verdict_sentence(found) + "\n" +
                    r.what.sentence + " " + r.what.source + "\n\n" + r.what.experiment + "\n\n";
  if (!found.figures.empty()) {
    out += "| measured | |\n|---|---|\n";
    for (const figure& f : found.figures)
      out += "| " + cell_text(f.name) + (f.timed ? " *" : "") + " | " + brief_or_whole(f.value, 3) +
             (f.unit.empty() ? "" : " " + f.unit) + " |\n";
    out += '\n';
  }
  if (!found.bounds.empty()) {
    out += "| predicted bound | measured | limit |\n|---|---|---|\n";
    for (const bound& b : found.bounds)
      out += "| " + cell_text(b.text) + " | " + brief_or_whole(b.measured, 3) + " | " +
             brief_or_whole(b.predicted, 3) + (b.kept() ? "" : " **exceeded**") + " |\n";
    out += '\n';
  }
  for (const check& c : found.claimed)
    out += std::string("- ") + (c.held ? "yes" : "**no**") + ": " + c.text + '\n';
  for (const check& c : found.conditional)
    out +=
        std::string("- ") + (c.held ? "yes" : "**no**") + ", under the condition: " + c.text + '\n';
  if (!found.claimed.empty()) out += '\n';
  for (const counterexample& c : found.counterexamples) {
    out += "Counterexample: `bitshade claims " + std::string(r.what.id) + " --replay \"" +
           c.numbers + "\"` gives";
    const char* separator = " ";
    for (const named_number& n : c.result) {
      out += separator + n.name + " " + brief(static_cast<double>(n.value), 4);
      separator = ", ";
    }
    out += ".\n\n";
  }
  for (const std::string& remark : found.remarks) out += remark + "\n\n";
  return out;
}

nlohmann::ordered_json numbers_json(const std::vector<named_number>& numbers) {
  auto list = nlohmann::ordered_json::array();
  for (const named_number& n : numbers)
    list.push_back(
        {{"name", n.name}, {"exact", text_of(n.value)}, {"value", static_cast<double>(n.value)}});
  return list;
}

nlohmann::ordered_json checks_json(const std::vector<check>& checks) {
  auto list = nlohmann::ordered_json::array();
  for (const check& c : checks) list.push_back({{"text", c.text}, {"held", c.held}});
  return list;
}

}  // namespace

std::string markdown_of(std::span<const claim_report> all, const report_origin& origin) {
  std::string out =
      "# The claims of the sources, put to the test\n\n"
      "Each claim was measured, and its verdict computed from the figures, by\n\n    " +
      origin.command + "\n\nwith bitshade " + origin.version + " on " + origin.machine +
      ". Exact arithmetic says what is true of the method; formats come on top. Figures marked * "
      "are\n"
      "times, which differ from run to run; everything else depends on the seed alone.\n\n";
  out += section("Where the sources are right", verdict::holds, all);
  out += section("Where they need a condition", verdict::holds_if, all);
  out += section("Where they err", verdict::fails, all);
  out += section("What cannot be decided here", verdict::undecidable, all);
  out += "## Every claim, with its figures\n";
  for (const claim_report& r : all) out += block(r);
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

nlohmann::ordered_json json_of(std::span<const claim_report> all, const report_origin& origin) {
  auto list = nlohmann::ordered_json::array();
  for (const claim_report& r : all) {
    const outcome& found = r.found;
    auto figures = nlohmann::ordered_json::array(), bounds = figures, examples = figures;
    for (const figure& f : found.figures)
      figures.push_back(
          {{"name", f.name}, {"value", f.value}, {"unit", f.unit}, {"timed", f.timed}});
    for (const bound& b : found.bounds)
      bounds.push_back({{"text", b.text},
                        {"measured", b.measured},
                        {"predicted", b.predicted},
                        {"kept", b.kept()}});
    for (const counterexample& c : found.counterexamples)
      examples.push_back({{"replay", c.numbers},
                          {"found_as", c.start},
                          {"steps", c.steps},
                          {"to_the_end", c.to_the_end},
                          {"numbers", numbers_json(c.result)}});
    list.push_back({{"id", r.what.id},
                    {"claim", r.what.sentence},
                    {"source", r.what.source},
                    {"experiment", r.what.experiment},
                    {"verdict", name_of(found.result())},
                    {"sentence", verdict_sentence(found)},
                    {"condition", found.condition},
                    {"figures", figures},
                    {"bounds", bounds},
                    {"claimed", checks_json(found.claimed)},
                    {"conditional", checks_json(found.conditional)},
                    {"counterexamples", examples},
                    {"remarks", found.remarks},
                    {"seconds", r.seconds}});
  }
  return {{"command", origin.command},
          {"version", origin.version},
          {"machine", origin.machine},
          {"claims", list}};
}

nlohmann::ordered_json json_of(const sample& given, const evaluation& e) {
  return {{"case", text_of(given)},
          {"admissible", e.admissible},
          {"refutes", e.admissible && e.refutes},
          {"numbers", numbers_json(e.numbers)}};
}

}  // namespace bitshade::claims
