#include <algorithm>

#include "claims/report.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

constexpr std::size_t page = 80, margin = 5;

std::string indented(const std::string& text, std::size_t column = margin,
                     const std::string& head = "") {
  std::string out;
  for (const std::string& line : wrap(text, page - column)) {
    const bool first = out.empty();
    out += first ? pad_right(head, column) : std::string(column, ' ');
    out += line + '\n';
  }
  return out;
}

/// "2/3 = 0.667", or the decimal alone where the fraction is long.
std::string exactly(const number& x) {
  const std::string fraction = text_of(x), decimal = brief(static_cast<double>(x), 4);
  if (fraction.size() > 24) return decimal;
  return x.whole() ? fraction : fraction + " = " + decimal;
}

std::string named_numbers(const std::vector<named_number>& numbers, std::size_t column) {
  std::size_t width = 0;
  for (const named_number& n : numbers) width = std::max(width, columns(n.name));
  std::string out;
  for (const named_number& n : numbers)
    out += std::string(column, ' ') + pad_right(n.name, width) + "  " + exactly(n.value) + '\n';
  return out;
}

/// A name and a value: names wrap, values stand in one column.
std::string table_line(const std::string& name, const std::string& value) {
  constexpr std::size_t right = 24, left = page - margin - right - 1;
  std::string out;
  const auto lines = wrap(name, left);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out += std::string(margin, ' ');
    out += i + 1 < lines.size() ? lines[i] : pad_right(lines[i], left) + ' ' + value;
    out += '\n';
  }
  return out;
}

std::string value_of(const figure& f) {
  return pad_left(brief_or_whole(f.value, 3), 8) + (f.unit.empty() ? "" : " " + f.unit) +
         (f.timed ? " *" : "");
}

std::string checks_of(const std::vector<check>& checks) {
  std::string out;
  for (const check& c : checks)
    out += indented(c.text, margin + 6, c.held ? "     yes" : "     no");
  return out;
}

std::string one_line(const std::string& text, std::size_t width) {
  const auto lines = wrap(text, width);
  if (lines.size() <= 1) return text;
  return wrap(text, width - 3).front() + " ..";
}

}  // namespace

std::string verdict_sentence(const outcome& found) {
  const verdict v = found.result();
  const std::string name(name_of(v));
  switch (v) {
    case verdict::holds_if:
      return name + " " + found.condition;
    case verdict::undecidable:
      return name + ": " + found.undecidable;
    case verdict::fails: {
      for (const check& c : found.claimed)
        if (!c.held) return name + ": not so: " + c.text;
      return name;
    }
    case verdict::holds:
      break;
  }
  return name;
}

std::string text_of(const claim_report& r) {
  const outcome& found = r.found;
  std::string out = indented(r.what.sentence, margin, r.what.id);
  out += indented(r.what.source) + '\n' + indented(r.what.experiment) + '\n';
  for (const figure& f : found.figures) out += table_line(f.name, value_of(f));
  if (!found.bounds.empty()) {
    out += '\n' + indented("Predicted bounds, measured at most:");
    for (const bound& b : found.bounds)
      out += table_line(b.text, pad_left(brief_or_whole(b.measured, 3), 8) +
                                    (b.kept() ? " <= " : " >  ") + brief_or_whole(b.predicted, 3));
  }
  for (const counterexample& c : found.counterexamples) {
    out += '\n' + indented("counterexample " + c.numbers);
    out += named_numbers(c.result, margin + 2);
    out += indented("found as " + c.start, margin + 2, "");
    out +=
        indented(std::to_string(c.steps) + " steps simpler" +
                     (c.to_the_end ? "; no simpler case is left" : "; the search's budget ended"),
                 margin + 2);
    out += indented(
        "again: bitshade claims " + std::string(r.what.id) + " --replay \"" + c.numbers + "\"",
        margin + 2);
  }
  out += '\n' + checks_of(found.claimed);
  if (!found.conditional.empty()) {
    out += indented("Provided that " + found.condition + ":");
    out += checks_of(found.conditional);
  }
  for (const std::string& remark : found.remarks) out += indented(remark);
  out += indented("Verdict: " + verdict_sentence(found) + ".");
  return out;
}

std::string summary_text(std::span<const claim_report> all) {
  std::string out = "id   verdict           claim\n" + std::string(page, '-') + '\n';
  std::size_t counts[4] = {};
  for (const claim_report& r : all) {
    const verdict v = r.found.result();
    ++counts[static_cast<std::size_t>(v)];
    out += pad_right(r.what.id, 5) + pad_right(std::string(name_of(v)), 18) +
           one_line(r.what.sentence, page - 23) + '\n';
  }
  out += std::string(page, '-') + '\n';
  for (const verdict v : {verdict::holds, verdict::holds_if, verdict::fails, verdict::undecidable})
    out += std::string(v == verdict::holds ? "" : ", ") + std::string(name_of(v)) + ": " +
           std::to_string(counts[static_cast<std::size_t>(v)]);
  return out + '\n';
}

std::string text_of(std::span<const replayed_case> all) {
  std::string out;
  for (const auto& [statement, given, found] : all) {
    out += (out.empty() ? text_of(given) + "\n\n" : "\n") + indented(statement->says, 0);
    out += named_numbers(found.numbers, 2);
    out += !found.admissible ? "  This case is none that the statement speaks of.\n"
           : found.refutes   ? "  Refuted by this case.\n"
                             : "  This case agrees.\n";
  }
  return out;
}

}  // namespace bitshade::claims
