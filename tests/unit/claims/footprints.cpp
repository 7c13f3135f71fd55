// The claims that exact footprints decide: their verdicts and their counterexamples.
#include <algorithm>

#include "claims/laboratory.hpp"
#include "claims/shrink.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::claims;

namespace {

/// Of the random cases and of the pictures.
constexpr double small = 0.05;

outcome outcome_of(const std::string& id, std::uint64_t seed = 1) {
  laboratory lab(library_method(), {seed, small, small, 1});
  return claims_named({id}).front().measure(lab);
}

/// What comes of refuting cases with `texels` texels whose denominators sum to at most `most`: the
/// simplest, by brute force over every case of C5 without a floor.
std::vector<sample> refuting_cases(const claim& c5, int most) {
  std::vector<number> fractions;
  for (int d = 1; d <= 4; ++d)
    for (int n = 0; n <= d; ++n)
      if (number(n, d).below() == number(d)) fractions.emplace_back(n, d);
  const trial& t = *c5.trials.front();
  std::vector<sample> found;
  for (const number& a : fractions)
    for (const number& b : fractions)
      for (const number& at : fractions)
        for (const number& split : {number(1, 2), number(1, 4), number(3, 4)}) {
          sample s(t.names);
          s.list("x") = {a, b};
          s.list("t") = {at};
          s.list("splits") = {split};
          s.list("floor") = {0};
          if (simplicity_of(s).denominators > number(most)) continue;
          const evaluation e = t.evaluate(library_method(), s);
          if (e.admissible && e.refutes) found.push_back(s);
        }
  return found;
}

}  // namespace

TEST_CASE("claims on footprints stand as they were found") {
  struct row {
    const char* id;
    verdict found;
    std::size_t counterexamples;
  };
  for (const auto& [id, found, counterexamples] :
       {row{"C1", verdict::holds_if, 2}, row{"C2", verdict::holds, 0}, row{"C3", verdict::holds, 0},
        row{"C4", verdict::holds_if, 1}, row{"C5", verdict::holds_if, 2},
        row{"C6", verdict::holds_if, 2}, row{"C7", verdict::holds_if, 1},
        row{"C8", verdict::holds_if, 2}, row{"C9", verdict::holds_if, 1},
        row{"C19", verdict::holds_if, 1}, row{"C27", verdict::holds_if, 1}}) {
    const outcome out = outcome_of(id);
    INFO(id);
    CHECK(out.result() == found);
    CHECK(out.counterexamples.size() == counterexamples);
    for (const bound& b : out.bounds) {
      INFO(b.text << ": " << b.measured << " against " << b.predicted);
      CHECK(b.kept());
    }
    for (const counterexample& c : out.counterexamples) CHECK(c.to_the_end);
  }
}

TEST_CASE("C5's counterexample is found from any seed, and shrinks to the known one") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const outcome out = outcome_of("C5", seed);
    REQUIRE_FALSE(out.counterexamples.empty());
    const claim c5 = claims_named({"C5"}).front();
    const sample s = parse_sample(c5.trials.front()->names, out.counterexamples.front().numbers);
    INFO(out.counterexamples.front().numbers << ", from " << out.counterexamples.front().start);
    auto x = s.list("x");
    std::sort(x.begin(), x.end());
    CHECK(x == std::vector<number>{0, 1});
    CHECK(s["splits"] == number(1, 2));
    CHECK(s["t"] == number(2, 3));
    CHECK(s["floor"] == number(0));
  }
}

TEST_CASE("no case that is simpler than C5's counterexample refutes it") {
  // Single texels have no variance, so that no case with fewer numbers is one.
  const claim c5 = claims_named({"C5"}).front();
  const sample known = parse_sample(c5.trials.front()->names, "x=0,1 t=2/3 splits=1/2 floor=0");
  CHECK(simplicity_of(known).denominators == number(8));
  const auto all = refuting_cases(c5, 8);
  CHECK_FALSE(all.empty());
  for (const sample& s : all) {
    INFO(text_of(s));
    CHECK_FALSE(simplicity_of(s) < simplicity_of(known));
  }
}

TEST_CASE(
    "every counterexample refutes a statement, with the same numbers, when it is given back") {
  for (const char* id : {"C1", "C4", "C5", "C6", "C7", "C8", "C9", "C16", "C19", "C27"}) {
    const claim c = claims_named({id}).front();
    for (const counterexample& said : outcome_of(id).counterexamples) {
      INFO(id << " " << said.numbers);
      bool refuted = false;
      for (const replayed_case& r : replay(c, library_method(), said.numbers)) {
        CHECK(text_of(r.given) == said.numbers);
        if (!r.found.admissible || !r.found.refutes) continue;
        bool same = r.found.numbers.size() == said.result.size();
        for (std::size_t i = 0; same && i < said.result.size(); ++i)
          same = r.found.numbers[i].value == said.result[i].value;
        refuted = refuted || same;
      }
      CHECK(refuted);
    }
  }
}

TEST_CASE("ids are chosen in the table's order, and unknown ones refused by name") {
  CHECK(all_claims().size() == 29);
  for (std::size_t i = 0; i < 29; ++i) CHECK(all_claims()[i].id == "C" + std::to_string(i + 1));
  const auto two = claims_named({"C12", "C5", "C12"});
  REQUIRE(two.size() == 2);
  CHECK(std::string(two.front().id) == "C5");
  CHECK_THROWS_WITH(claims_named({"C30"}), Catch::Contains("C1 to C29; did you mean 'C3'?"));
}
