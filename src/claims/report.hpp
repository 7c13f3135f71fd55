// What a run of claims found, for a terminal, a page and a program.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

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
  std::string command, version, machine;
};

/// "holds if no floor acts": the verdict and what it hangs on, as one sentence.
std::string verdict_sentence(const outcome& found);

/// A block of at most 80 columns.
std::string text_of(const claim_report& r);
/// A line a claim.
std::string summary_text(std::span<const claim_report> all);
/// A page in Markdown: first where the sources are right, where they need a condition, where they
/// err; then every claim with its figures.
std::string markdown_of(std::span<const claim_report> all, const report_origin& origin);
nlohmann::ordered_json json_of(std::span<const claim_report> all, const report_origin& origin);

/// The numbers of a case that was given back.
std::string text_of(const sample& given, const evaluation& e);
nlohmann::ordered_json json_of(const sample& given, const evaluation& e);

}  // namespace bitshade::claims
