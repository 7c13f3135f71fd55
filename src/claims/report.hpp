// What a run of claims found, for a terminal, a page and a program.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "claims/claim.hpp"

namespace bitshade::claims {

/// A claim and what came of it.
struct claim_report {
  claim what;
  outcome found;
  double seconds = 0;
};

/// What heads a page: how to get it again.
struct report_origin {
  std::string command, version, machine, seed;
};

/// "holds if no floor acts": the verdict and what it hangs on, as one sentence.
std::string verdict_sentence(const outcome& found);

/// A block of at most 80 columns.
std::string text_of(const claim_report& r);
/// A line a claim.
std::string summary_text(std::span<const claim_report> all);
/// The run in a few sentences: verdicts in all and by source, bounds kept, counterexamples shrunk.
std::vector<std::string> summary_sentences(std::span<const claim_report> all);
/// What a verdict says of the sources: "Where the sources are right". In the order of pages.
struct verdict_heading {
  verdict found;
  const char* title;
  const char* words;  ///< what the verdict means
};
std::span<const verdict_heading> verdict_headings();
/// A page in Markdown: a summary in words, where the sources are right, where they need a
/// condition, where they err; then every claim with its figures.
std::string markdown_of(std::span<const claim_report> all, const report_origin& origin);
/// The same as the body of a page for a browser (report/html.hpp).
std::string html_of(std::span<const claim_report> all);
nlohmann::ordered_json json_of(std::span<const claim_report> all, const report_origin& origin);

/// What a case that was given back shows, statement by statement.
std::string text_of(std::span<const replayed_case> all);
nlohmann::ordered_json json_of(std::span<const replayed_case> all);

}  // namespace bitshade::claims
