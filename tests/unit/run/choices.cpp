// What a configuration may choose beside technique and format: generation, lookup, bounds, powers.
#include <bit>
#include <cmath>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/shadow/bleeding.hpp"
#include "run/lloyd.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

const std::vector<std::string> formats{"unorm8",   "unorm16",  "snorm16",  "half",
                                       "bfloat16", "binary32", "binary64", "exact"};

cell run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how));
}

void check_same(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i, a[i], b[i]);
    REQUIRE(std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i]));
  }
}

configuration layered(int layers, const std::string& format) {
  configuration how;
  how.method = technique::lvsm;
  how.format = format;
  how.layers = layers;
  how.overlap = 0.03;
  return how;
}

}  // namespace

TEST_CASE("one pass and a post-process give the same light, bit for bit, in every format") {
  const auto scene = test::small_frame(27, 21, 200, 8);
  for (const auto& format : formats) {
    for (const int layers : {1, 2, 3, 6}) {
      for (const bool slope : {false, true}) {
        configuration how = layered(layers, format);
        how.slope_term = slope;
        const auto alone = run(scene, how);
        how.one_pass = true;
        const auto together = run(scene, how);
        CAPTURE(format, layers, slope);
        check_same(together.visibility, alone.visibility);
        // Pairs fill four components; of an odd number the last pair is half empty.
        if (format != "exact") {
          CHECK(together.bytes_per_texel * layers == alone.bytes_per_texel * ((layers + 1) / 2 * 2));
        }
      }
    }
  }
}

TEST_CASE("an index computed directly is the searched one among 2^k uniform layers") {
  const auto scene = test::small_frame(17, 15, 400, 9);
  for (const int layers : {2, 4, 8, 64}) {
    configuration how = layered(layers, "unorm16");
    const auto searched = run(scene, how);
    how.direct_index = true;
    const auto direct = run(scene, how);
    CHECK(direct.layer == searched.layer);
    check_same(direct.visibility, searched.visibility);
  }
  for (int n = 1; n <= 256; ++n) {  // a tie goes to the nearer layer, t = 1 to the last one
    CHECK(uniform_layer_of(1.0, n) == n - 1);
    CHECK(uniform_layer_of(0.0, n) == 0);
    if ((n & (n - 1)) == 0 && n > 1) CHECK(uniform_layer_of(1.0 / n, n) == 0);
  }
}

TEST_CASE("a nearer layer never gives less light, so the darkest of them is the own or darker") {
  const auto scene = test::small_frame(23, 19, 300, 10);
  for (const auto& format : formats) {
    configuration how = layered(4, format);
    const auto own = run(scene, how).visibility;
    how.lookup = layer_lookup::nearer;
    const auto nearer = run(scene, how).visibility;
    how.lookup = layer_lookup::every;
    const auto every = run(scene, how).visibility;
    std::size_t darker = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i] != own[i]) continue;
      CAPTURE(format, i);
      REQUIRE(nearer[i] <= own[i]);
      REQUIRE(every[i] <= nearer[i]);
      darker += nearer[i] < own[i] ? 1 : 0;
    }
    CHECK(darker > 0);
  }
}

TEST_CASE("a deep map is percentage-closer filtering, but for the rounding of its shares") {
  const auto scene = test::small_frame(25, 20, 200, 12);
  configuration deep;
  deep.method = technique::deep;
  configuration pcf;
  pcf.method = technique::pcf;
  deep.format = pcf.format = "exact";
  check_same(run(scene, deep).visibility, run(scene, pcf).visibility);
  for (const std::string format : {"unorm8", "unorm16", "half", "binary64"}) {
    deep.format = pcf.format = format;
    const auto a = run(scene, deep), b = run(scene, pcf);
    const auto code = *parse_encoding(format);
    // Half a step of the shares' format at 1, and a few roundings of binary32 or binary64.
    const double step = code.kind == family::binary
                            ? 1.0 / static_cast<double>(std::uint64_t{2} << code.fraction_bits)
                            : decode(code, 1) / 2;
    const double bound = step + (format == "binary64" ? 0x1p-46 : 0x1p-17);
    for (std::size_t i = 0; i < a.visibility.size(); ++i) {
      if (a.visibility[i] != a.visibility[i]) continue;
      CAPTURE(format, i, a.visibility[i], b.visibility[i]);
      REQUIRE(std::fabs(a.visibility[i] - b.visibility[i]) <= bound);
    }
    CHECK(a.bytes_per_texel > 2);
  }
}

TEST_CASE("less bleeding by a power: the form over the run's own light, in its arithmetic") {
  const auto scene = test::small_frame(15, 12, 120, 13);
  for (const auto& format : formats) {
    configuration how = layered(2, format);
    const auto plain = run(scene, how).visibility;
    how.bleeding_power = 1.3;
    how.bleeding_lift = 0.65;
    const auto lifted = run(scene, how).visibility;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (plain[i] != plain[i]) continue;
      const double expected = std::fmin(1, std::pow(plain[i], 1.3) + 0.65);
      CAPTURE(format, plain[i], lifted[i]);
      // Binary32 rounds the power and the sum once each.
      REQUIRE(std::fabs(lifted[i] - expected) <= 0x1p-23);
      REQUIRE((lifted[i] >= static_cast<double>(0.65F) - 0x1p-24 && lifted[i] <= 1));
    }
  }
}

TEST_CASE("four moments: Hausdorff's bound is no lighter, either basis gives the same in exact") {
  const auto scene = test::small_frame(16, 14, 120, 14);
  configuration how;
  how.method = technique::msm;
  how.format = "exact";
  how.moment_bias = 0;
  const auto wide = run(scene, how).visibility;
  const auto truth = truth_pcf(scene, how);
  how.bound = moment_bound::hausdorff;
  const auto sharp = run(scene, how).visibility;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    if (wide[i] != wide[i]) continue;
    CAPTURE(i, wide[i], sharp[i], truth[i]);
    REQUIRE(sharp[i] <= wide[i]);
    REQUIRE(sharp[i] >= truth[i] - 0x1p-53);
  }
  how.optimised_basis = false;
  check_same(run(scene, how).visibility, sharp);
}

TEST_CASE("splits closer than the least width are merged, and their layers with them") {
  const auto scene = test::small_frame(15, 12, 60, 15);
  configuration how = layered(4, "unorm16");
  how.splits = split_rule::manual;
  how.manual_splits = {0.25, 0.26, 0.75};
  CHECK(make_plan(scene, how).splits.size() == 5);
  how.min_width = 0.02;
  const auto plan = make_plan(scene, how);
  REQUIRE(plan.splits.size() == 4);
  CHECK(plan.splits[1] == 0.25);
  CHECK(plan.splits[2] == 0.75);
}

TEST_CASE("Lloyd's choices reach the relaxation, and what its sums lose is told") {
  // 64 x 64 samples lie between 65 x 65 texels: every level of the reduction halves evenly.
  const auto scene = test::small_frame(65, 65, 400, 16);
  configuration how = layered(4, "unorm16");
  how.splits = split_rule::lloyd;
  const auto usual = make_plan(scene, how);
  CHECK(usual.notes.empty());
  for (const auto* sums : {"binary64", "binary32"}) {  // they keep every weight of this map
    how.lloyd.sums = sums;
    const auto rounded = make_plan(scene, how);
    REQUIRE(rounded.splits.size() == usual.splits.size());
    for (std::size_t i = 0; i < usual.splits.size(); ++i) {
      CHECK(rounded.splits[i] == Approx(usual.splits[i]).margin(1e-4));
    }
  }
  how.lloyd.sums = "exact";
  how.lloyd.most_frames = 1;
  const auto stopped = make_plan(scene, how);
  REQUIRE(stopped.notes.size() == 1);
  CHECK(stopped.notes[0].find("before they came to rest") != std::string::npos);
  CHECK(stopped.splits != usual.splits);

  how.lloyd = {};
  for (const auto& c : compare_with_optimum(scene, how, 1)) {
    CAPTURE(c.name, c.cost, c.least, c.result.frames);
    CHECK(c.least <= c.cost);
    CHECK(c.cost <= lloyd_field(scene, how, 1).cost({0.25, 0.5, 0.75}));
    CHECK(c.result.frames < how.lloyd.most_frames);
  }
}
