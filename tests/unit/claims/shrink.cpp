// Cases of claims: written and read back, shrunk to their end.
#include "claims/shrink.hpp"

#include "io/error.hpp"
#include "support/catch.hpp"

using namespace bitshade::claims;

namespace {

const shape footprint{{"x", quantity::share, 1, 6},
                      {"t"},
                      {"splits", quantity::grid, 1, 3},
                      {"count", quantity::whole}};

}  // namespace

TEST_CASE("random cases are read back from their own text") {
  random_stream random(3, 0);
  for (int i = 0; i < 300; ++i) {
    const sample s = draw(footprint, random);
    INFO(text_of(s));
    CHECK(parse_sample(footprint, text_of(s)) == s);
    for (const number& x : s.list("x")) CHECK((x >= number(0) && x <= number(1)));
  }
}

TEST_CASE("a case is taken exactly, and refused with its own words") {
  const sample s = parse_sample(footprint, "x=0,0.1,1 t=2/3 splits=0.5 count=3");
  CHECK(s.list("x")[1] == number(1, 10));
  CHECK(s["t"] == number(2, 3));
  CHECK(s.real("splits") == 0.5);
  using bitshade::usage_error;
  CHECK_THROWS_WITH(parse_sample(footprint, "y=0"), Catch::Contains("nothing here is called 'y'"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=0 splits=2/3 count=1"), Catch::Contains("2^-24"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=two splits=1/2 count=1"), Catch::Contains("two"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=1/0 splits=1/2 count=1"), Catch::Contains("1/0"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=2 splits=1/2 count=1"), Catch::Contains("[0,1]"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=0 splits=1/2"), Catch::Contains("count takes 1"));
  CHECK_THROWS_WITH(parse_sample(footprint, "x=0 x=1 splits=1/2 count=1"),
                    Catch::Contains("twice"));
  CHECK_THROWS_AS(parse_sample(footprint, "x="), usage_error);
}

TEST_CASE("every simpler number is simpler, of the same kind, and they end") {
  random_stream random(5, 0);
  for (int i = 0; i < 200; ++i) {
    const sample s = draw(footprint, random);
    for (std::size_t k = 0; k < footprint.size(); ++k)
      for (const number& x : s.at_index(k))
        for (const number& y : simpler_numbers(x, footprint[k].what)) {
          INFO(text_of(x) << " to " << text_of(y));
          CHECK((y.below() < x.below() || (y.below() == x.below() && y.above() < x.above())));
          if (footprint[k].what == quantity::grid) CHECK((y * number(1 << 24)).whole());
        }
  }
}

TEST_CASE("a mean above 3/5 shrinks to one texel of the simplest such depth") {
  random_stream random(7, 0);
  for (int i = 0; i < 40; ++i) {
    const auto high = [](const sample& s) {
      number sum;
      for (const number& x : s.list("x")) sum += x;
      return sum / number(s.list("x").size()) > number(3, 5) && s["t"] > number(1, 7);
    };
    const sample start = draw(footprint, random);
    if (!high(start)) continue;
    const shrunk_sample end = shrink(start, high);
    INFO(text_of(start));
    CHECK(end.to_the_end);
    CHECK(text_of(end.smallest) == "x=1 t=1 splits=0 count=1");
  }
}

TEST_CASE("shrinking stops at its budget, with a case that is still wanted") {
  random_stream random(9, 0);
  const sample start = draw(footprint, random);
  const auto wanted = [&](const sample& s) { return s.list("x").size() == start.list("x").size(); };
  const shrunk_sample end = shrink(start, wanted, 5);
  CHECK(end.tried <= 5);
  CHECK(wanted(end.smallest));
  CHECK_FALSE(simplicity_of(start) < simplicity_of(end.smallest));
}
