#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "claims/report.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

std::string section(const verdict_heading& heading, std::span<const claim_report> all) {
  const verdict wanted = heading.found;
  std::string list;
  for (const claim_report& r : all) {
    if (r.found.result() != wanted) continue;
    list += "- **" + std::string(r.what.id) + "** " + r.what.sentence;
    if (wanted != verdict::holds) list += " *" + verdict_sentence(r.found) + ".*";
    list += '\n';
  }
  return list.empty()
             ? ""
             : std::string("## ") + heading.title + "\n" + heading.words + "\n\n" + list + '\n';
}

std::string count_of(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

/// "4 hold, 12 hold under a condition, 2 fail".
std::string counts_text(std::span<const claim_report> all, const std::string& source) {
  std::size_t counts[4] = {};
  for (const claim_report& r : all)
    if (std::string_view(r.what.source).starts_with(source))
      ++counts[static_cast<std::size_t>(r.found.result())];
  const std::string words[4] = {
      count_of(counts[0], "holds as it stands", "hold as they stand"),
      count_of(counts[1], "holds under a condition", "hold under a condition"),
      count_of(counts[2], "fails", "fail"),
      counts[3] == 0 ? "" : std::to_string(counts[3]) + " cannot be decided here"};
  std::string text;
  for (std::size_t v = 0; v < 4; ++v)
    if (counts[v] > 0) text += (text.empty() ? "" : ", ") + words[v];
  return text;
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

std::vector<std::string> summary_sentences(std::span<const claim_report> all) {
  std::vector<std::string> said;
  said.push_back("Of " + count_of(all.size(), "claim ", "claims ") + counts_text(all, "") + ".");
  std::vector<std::string> sources;
  std::size_t bounds = 0, kept = 0, examples = 0, ended = 0;
  for (const claim_report& r : all) {
    const std::string_view source = r.what.source;
    const std::string key(source.substr(0, source.find(']') + 1));
    if (std::find(sources.begin(), sources.end(), key) == sources.end()) sources.push_back(key);
    for (const bound& b : r.found.bounds) ++bounds, kept += b.kept() ? 1 : 0;
    for (const counterexample& c : r.found.counterexamples) ++examples, ended += c.to_the_end;
  }
  for (const std::string& source : sources)
    said.push_back(source + ": " + counts_text(all, source) + ".");
  said.push_back("Of " + count_of(bounds, "predicted bound ", "predicted bounds ") +
                 std::to_string(kept) + (kept == 1 ? " was kept." : " were kept."));
  said.push_back("Of " + count_of(examples, "counterexample ", "counterexamples ") +
                 "that the search met, " + std::to_string(ended) +
                 " could be shrunk until no simpler case was left.");
  return said;
}

std::span<const verdict_heading> verdict_headings() {
  static constexpr std::array all{
      verdict_heading{verdict::holds, "Where the sources are right",
                      "No case and no figure of the run speaks against these."},
      verdict_heading{
          verdict::holds_if, "Where they need a condition",
          "As they stand these are refuted, by a counterexample or by figures; under the "
          "condition found they hold."},
      verdict_heading{verdict::fails, "Where they err",
                      "Refuted, and no condition was found that saves them."},
      verdict_heading{verdict::undecidable, "What cannot be decided here",
                      "Figures were taken, but they are not what the sources speak of."}};
  return all;
}

std::string markdown_of(std::span<const claim_report> all, const report_origin& origin) {
  std::string out =
      "# The claims of the sources, put to the test\n\n"
      "Each claim was measured, and its verdict computed from the figures, by\n\n    " +
      origin.command + "\n\nwith bitshade " + origin.version + " on " + origin.machine +
      ".\nExact arithmetic says what is true of the method; formats come on top. Figures marked * "
      "are\n"
      "times, which differ from run to run; everything else depends on the seed alone. "
      "`scripts/claims` makes this page anew.\n\n";
  for (const std::string& said : summary_sentences(all)) out += "- " + said + '\n';
  out += '\n';
  for (const verdict_heading& heading : verdict_headings()) out += section(heading, all);
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

nlohmann::ordered_json json_of(std::span<const replayed_case> all) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [statement, given, found] : all)
    list.push_back({{"statement", statement->says},
                    {"case", text_of(given)},
                    {"admissible", found.admissible},
                    {"refuted", found.admissible && found.refutes},
                    {"numbers", numbers_json(found.numbers)}});
  return list;
}

}  // namespace bitshade::claims
