// The claims that exact footprints decide: their verdicts, their counterexamples, and how both turn
// when a technique is changed for the worse.
#include <algorithm>

#include "bitshade/shadow/moments.hpp"
#include "claims/laboratory.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::claims;

namespace {

constexpr double small = 0.05;

outcome outcome_of(const std::string& id, const method& m = library_method(),
                   std::uint64_t seed = 1) {
  laboratory lab(m, {seed, small, 1});
  return claims_named({id}).front().measure(lab);
}

bool all_held(const std::vector<check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const check& c) { return c.held; });
}

number unclamped(const number& x, const interval& layer) {
  return (x - number(layer.near)) / number(layer.far - layer.near);
}
number unscaled_floor(double variance, const interval&) { return number(variance); }
int farther_on_ties(const number& t, std::span<const double> splits) {
  int i = 0;
  while (i < static_cast<int>(splits.size()) - 2 &&
         number(splits[static_cast<std::size_t>(i) + 1]) <= t)
    ++i;
  return i;
}
number least_of(std::span<const number> values) {
  return *std::min_element(values.begin(), values.end());
}
number without_floor(const mean_variance<number>& at, const number& t, const number&) {
  return chebyshev<number>(at, t, 0);
}
std::vector<interval> never_overlapping(std::span<const double> splits, double) {
  return layer_intervals(splits, 0);
}
number doubled(const number& p, const number&) { return std::min(number(1), p + p); }

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
    const outcome out = outcome_of("C5", library_method(), seed);
    REQUIRE_FALSE(out.counterexamples.empty());
    const claim c5 = claims_named({"C5"}).front();
    const sample s = parse_sample(c5.replayed->names, out.counterexamples.front().numbers);
    INFO(out.counterexamples.front().numbers << ", from " << out.counterexamples.front().start);
    auto x = s.list("x");
    std::sort(x.begin(), x.end());
    CHECK(x == std::vector<number>{0, 1});
    CHECK(s["splits"] == number(1, 2));
    CHECK(s["t"] == number(2, 3));
    CHECK(s["floor"] == number(0));
  }
}

TEST_CASE("what a claim calls a counterexample refutes it when it is given back") {
  for (const char* id : {"C1", "C4", "C5", "C6", "C7", "C8", "C9", "C19", "C27"}) {
    const outcome out = outcome_of(id);
    const claim c = claims_named({id}).front();
    REQUIRE(c.replayed != nullptr);
    // The first one is of the trial that is replayed.
    const sample s = parse_sample(c.replayed->names, out.counterexamples.front().numbers);
    const evaluation e = c.replayed->evaluate(library_method(), s);
    INFO(id << " " << text_of(s));
    CHECK((e.admissible && e.refutes));
    REQUIRE(e.numbers.size() == out.counterexamples.front().result.size());
    for (std::size_t i = 0; i < e.numbers.size(); ++i)
      CHECK(e.numbers[i].value == out.counterexamples.front().result[i].value);
  }
}

TEST_CASE("a technique changed for the worse turns verdicts") {
  struct sabotage {
    const char* what;
    void (*apply)(method&);
    std::vector<const char*> turned;
  };
  const std::vector<sabotage> all{
      {"no clamp in the warp", [](method& m) { m.warp = unclamped; }, {"C4", "C7"}},
      {"floor not scaled", [](method& m) { m.floor = unscaled_floor; }, {"C9", "C27"}},
      {"ties go to the farther layer",
       [](method& m) { m.layer_of = farther_on_ties; },
       {"C6", "C8"}},
      {"least in place of mean", [](method& m) { m.filter = least_of; }, {"C1", "C2", "C3"}},
      {"no floor", [](method& m) { m.chebyshev = without_floor; }, {"C7"}},
      {"no overlap", [](method& m) { m.intervals = never_overlapping; }, {"C10"}},
      {"reduction that adds light", [](method& m) { m.reduce = doubled; }, {"C25"}}};
  for (const sabotage& s : all) {
    method worse = library_method();
    s.apply(worse);
    for (const char* id : s.turned) {
      const outcome sound = outcome_of(id), broken = outcome_of(id, worse);
      INFO(s.what << ", " << id << ": " << name_of(broken.result()));
      CHECK(all_held(sound.conditional));
      CHECK((broken.result() != sound.result() || !all_held(broken.conditional)));
    }
  }
}

TEST_CASE("ids are chosen in the table's order, and unknown ones refused by name") {
  CHECK(all_claims().size() == 29);
  for (std::size_t i = 0; i < 29; ++i) CHECK(all_claims()[i].id == "C" + std::to_string(i + 1));
  const auto two = claims_named({"C12", "C5", "C12"});
  REQUIRE(two.size() == 2);
  CHECK(std::string(two.front().id) == "C5");
  CHECK_THROWS_WITH(claims_named({"C30"}), Catch::Contains("C1 to C29"));
}
