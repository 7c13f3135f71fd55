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

TEST_CASE("a key holds how a map is filtered where that concerns the technique") {
  configuration plain, c;
  c.filtered = {4, blur_shape::box, blur_way::linear, 6, 3};
  CHECK(c.key() ==
        "vsm format=unorm16 msaa=4 blur=9/box blur-way=linear/6 lookups=3 min-variance=1e-05 "
        "filter=bilinear");
  c.filtered.way = blur_way::one_pass;
  CHECK(c.key().find(" blur-way=one-pass ") != std::string::npos);
  c.method = technique::pcf;
  CHECK(c.key() == "pcf format=unorm16 msaa=4 blur=9/box lookups=3");
  c.method = plain.method = technique::savsm;
  c.filtered.msaa = 1;
  CHECK(c.key() == plain.key());
  c.method = plain.method = technique::hard;
  c.filtered.msaa = 8;
  CHECK(c.key() == plain.key());
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
  refused([](configuration& c) { c.filtered.msaa = 3; });
  refused([](configuration& c) { c.filtered.lookups = 2; });
  refused([](configuration& c) { c.filtered.fraction_bits = 17; });
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
