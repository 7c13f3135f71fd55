#include "bitshade/study/configuration.hpp"

#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("techniques are known by name, and only by their own") {
  for (const auto name : technique_names) CHECK(name_of(technique_named(name)) == name);
  CHECK_THROWS_AS(technique_named("vsn"), std::invalid_argument);
}

TEST_CASE("a key holds what decides the bits, and nothing else") {
  configuration a, b;
  b.layers = 4;  // a VSM has no layers
  CHECK(a.key() == b.key());
  a.method = b.method = technique::lvsm;
  CHECK(a.key() != b.key());
  a.layers = 4;
  CHECK(a.key() == b.key());
  b.splits = split_rule::manual;
  b.manual_splits = {0.25, 0.5, 0.75};
  CHECK(b.key() ==
        "lvsm format=unorm16 layers=4 splits=0.25,0.5,0.75 overlap=0.01 blur=9/2 "
        "min-variance=1e-05 filter=bilinear");
}

TEST_CASE("contradicting fields are refused with a sentence") {
  configuration good;
  CHECK_NOTHROW(good.validate());
  const auto refused = [](auto change) {
    configuration c;
    change(c);
    CHECK_THROWS_AS(c.validate(), std::invalid_argument);
  };
  refused([](configuration& c) { c.layers = 0; });
  refused([](configuration& c) { c.blur_taps = 4; });
  refused([](configuration& c) { c.blur_sigma = 0; });
  refused([](configuration& c) { c.min_variance = -1; });
  refused([](configuration& c) { c.overlap = 0.6; });
  refused([](configuration& c) { c.bleeding_reduction = 1; });
  refused([](configuration& c) {
    c.splits = split_rule::manual;
    c.layers = 3;
    c.manual_splits = {0.5, 0.25};
  });
  refused([](configuration& c) {
    c.splits = split_rule::manual;
    c.layers = 2;
    c.manual_splits = {0.5, 0.75};
  });
}
