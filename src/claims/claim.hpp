// A claim of the sources, what was measured of it, and the verdict that the figures give.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "claims/hunt.hpp"

namespace bitshade::claims {

class laboratory;

/// One measured number.
struct figure {
  std::string name;
  double value = 0;
  std::string unit;
  bool timed = false;  ///< differs from run to run
};

/// A statement that figures decide.
struct check {
  std::string text;
  bool held = false;
};

/// A measured figure beside what theory (docs/theory.md) predicts as its limit.
struct bound {
  std::string text;
  double measured = 0, predicted = 0;

  bool kept() const { return measured <= predicted; }
};

/// A case that refutes a statement, as numbers that --replay takes.
struct counterexample {
  std::string numbers;  ///< "x=0,1 t=2/3 splits=1/2"
  std::string start;    ///< what the search had found before it was shrunk
  int steps = 0;
  bool to_the_end = false;
  std::vector<named_number> result;
};

enum class verdict { holds, holds_if, fails, undecidable };
std::string_view name_of(verdict v);

/// What a run of a claim brought.
///
/// `claimed` is the claim as it stands, `conditional` what is left of it under `condition`.
struct outcome {
  std::vector<figure> figures;
  std::vector<bound> bounds;
  std::vector<check> claimed;
  std::vector<check> conditional;
  std::string condition;
  std::string undecidable;  ///< why it cannot be decided here, if it cannot
  std::vector<counterexample> counterexamples;
  std::vector<std::string> remarks;  ///< what the figures do not say by themselves

  /// Undecidable where said so; holds where all that is claimed held; holds if the condition, where
  /// all that is conditional held; else fails.
  verdict result() const;

  void add(std::string name, double value, std::string unit = "", bool timed = false);
  void claim(std::string text, bool held) { claimed.push_back({std::move(text), held}); }
  void provided(std::string text, bool held) { conditional.push_back({std::move(text), held}); }
  void limit(std::string text, double measured, double predicted);
  /// The figure of that name. Throws std::out_of_range where there is none: for tests.
  double operator[](std::string_view name) const;

  /// What a hunt brought: rate and largest excess as figures, its counterexample, and whether there
  /// was none.
  bool none_in(const hunt_result& hunt, const std::string& name);
};

/// One row of the table of claims.
struct claim {
  const char* id;
  const char* sentence;    ///< what is claimed
  const char* source;      ///< by whom: a key of docs/bibliography.md
  const char* experiment;  ///< what is done about it
  outcome (*measure)(laboratory&);
  std::vector<const trial*> trials = {};  ///< what --replay may bring a case of
};

/// All claims, C1 to C29.
const std::vector<claim>& all_claims();
/// The claims of those ids, all where there are none, in the table's order, each once.
///
/// Failure  usage_error that names the ids there are.
std::vector<claim> claims_named(const std::vector<std::string>& ids);

/// A case that was given back, under one of the statements that it is a case of.
struct replayed_case {
  const trial* statement;
  sample given;
  evaluation found;
};
/// Evaluates a case as --replay names it under every statement of a claim that has such cases.
///
/// Failure  usage_error where the claim has no single cases, or none of that kind.
std::vector<replayed_case> replay(const claim& c, const method& m, std::string_view numbers);

}  // namespace bitshade::claims
