// Metric (13) by the letter: layers that do not clamp the depths beyond their ends.
#include <bit>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/measures.hpp"
#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

std::vector<double> run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how)).visibility;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

configuration layered(const std::string& format, int layers) {
  configuration how;
  how.method = technique::lvsm;
  how.layers = layers;
  how.format = format;
  how.warping = layer_warp::unclamped;
  return how;
}

}  // namespace

TEST_CASE("without the clamp a warp is the line: below 0 and past 1, as the metric says") {
  const interval layer{0.25, 0.75};
  CHECK(warp(0.0, layer, layer_warp::unclamped) == -0.5);
  CHECK(warp(0.25, layer, layer_warp::unclamped) == 0);
  CHECK(warp(1.0, layer, layer_warp::unclamped) == 1.5);
  CHECK(warp(0.0, layer) == 0);
  CHECK(warp(1.0, layer) == 1);
}

TEST_CASE("without the clamp and without rounding, layers of any splits are a VSM, bit for bit") {
  // Chebyshev's bound does not change along a line: all that layers gain, they gain by the clamp.
  const auto scene = test::small_frame(24, 20, 300, 91);
  for (const int layers : {2, 3, 8}) {
    for (const bool slope : {false, true}) {
      configuration how = layered("exact", layers), vsm;
      how.slope_term = vsm.slope_term = slope;
      vsm.format = "exact";
      CAPTURE(layers, slope);
      CHECK(same_bits(run(scene, how), run(scene, vsm)));
      how.warping = layer_warp::clamped;
      CHECK_FALSE(same_bits(run(scene, how), run(scene, vsm)));
    }
  }
}

TEST_CASE("without the clamp a format of wide range keeps the VSM, and one of [0,1] does not") {
  const auto scene = test::small_frame(24, 20, 300, 92);
  configuration exact = layered("exact", 4);
  const auto truth = run(scene, exact);
  const auto error = [&](const std::string& format) {
    return compare(run(scene, layered(format, 4)), truth).largest;
  };
  // A variance in binary64 errs by some 2^-50 of M2 <= 16, over a floor of 1.6e-4.
  CHECK(error("binary64") < 1e-9);
  CHECK(error("binary32") < 0.1);
  CHECK(error("unorm16") > 0.5);
  const auto cell = run_pipeline(scene, layered("unorm16", 4),
                                 make_plan(scene, layered("unorm16", 4)));
  bool told = false;
  for (const auto& note : cell.notes) told = told || note.find("unorm16 saturates") != note.npos;
  CHECK(told);
}

TEST_CASE("without the clamp, in every format: light in [0,1], packed or not, or a refusal") {
  const auto scene = test::small_frame(16, 12, 80, 93);
  for (const auto& format : {"unorm8", "unorm16", "snorm16", "half", "bfloat16", "e5m7", "binary32",
                             "fixed16.16", "exact"}) {
    for (const second_moment second :
         {second_moment::square, second_moment::square_of_stored, second_moment::centred}) {
      configuration how = layered(format, 4);
      how.second = second;
      const auto post_process = run(scene, how);
      for (const double p : post_process) CHECK((p != p || (p >= 0 && p <= 1)));
      how.one_pass = true;
      CHECK(same_bits(run(scene, how), post_process));
    }
  }
  // Depths of a layer 0.0001 wide reach 10,000: their square is no half, but a binary32.
  configuration thin = layered("half", 3);
  thin.splits = split_rule::manual;
  thin.manual_splits = {0.5, 0.5001};
  thin.overlap = 0;
  CHECK_THROWS_WITH(run(scene, thin), Catch::Contains("whose square overflows half"));
  thin.format = "binary32";
  CHECK_NOTHROW(run(scene, thin));
  thin.noise_floor = true;
  CHECK_THROWS_AS(run(scene, thin), usage_error);
}
