// Hard cases 15, 16 and 35, and claim C27, through whole runs.
#include <bit>
#include <cmath>

#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

const std::vector<std::string> formats{"unorm8",   "unorm16",  "unorm24",  "snorm16", "half",
                                       "bfloat16", "binary32", "binary64", "exact"};

std::vector<double> run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how)).visibility;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return a.size() == b.size();
}

/// Every depth and receiver of a frame brought into [near, near + width], both powers of two or
/// sums of them, on a grid that binary32 keeps through the move.
frame squeezed(frame scene, float near, float width) {
  const auto move = [&](float x) { return near + width * (std::floor(x * 0x1p16F) * 0x1p-16F); };
  for (float& x : scene.depth.texels) x = move(x);
  for (receiver& r : scene.receivers) r.t = move(std::max(r.t, 0x1p-16F));
  return scene;
}

}  // namespace

TEST_CASE("C27: within one layer, an LVSM is the VSM of the stretched depths, in every format") {
  const auto scene = test::small_frame(40, 32, 600, 30);
  const auto whole = squeezed(scene, 0, 1);
  for (const auto& [near, width, layers] :
       {std::tuple{0.5F, 0.25F, 4}, {0.75F, 0.25F, 4}, {0.5F, 0.5F, 2}, {0.25F, 0.125F, 8}}) {
    const auto inside = squeezed(scene, near, width);
    for (const auto& format : formats) {
      configuration lvsm;
      lvsm.method = technique::lvsm;
      lvsm.format = format;
      lvsm.layers = layers;
      lvsm.overlap = 0;
      lvsm.min_variance = 1e-5 * width * width;  // (7): the same floor in the layer
      configuration vsm;
      vsm.format = format;
      CAPTURE(format, near, width);
      CHECK(same_bits(run(inside, lvsm), run(whole, vsm)));
      if (format == "exact") {
        // And the VSM of the same depths, unstretched, has the same light to the last bit.
        vsm.min_variance = lvsm.min_variance;
        CHECK(same_bits(run(inside, lvsm), run(inside, vsm)));
      }
    }
  }
}

TEST_CASE("hard case 35: where a layer is worse than no layers, and what cures it") {
  // Half the footprint at 0, half at 1, the receiver at 0.7.
  frame scene;
  scene.depth = image<float>(4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) scene.depth.at(x, y) = x < 2 ? 0.0F : 1.0F;
  }
  receiver r;
  r.u = r.v = 0.5F;
  r.t = 0.75F;
  r.surface = 1;
  scene.receivers = {r};
  scene.view_width = scene.view_height = 1;
  configuration how;
  how.format = "exact";
  how.min_variance = 0;
  how.overlap = 0;
  const double alone = run(scene, how)[0];
  CHECK(alone == 0.25 / (0.25 + 0.0625));  // 0.8
  how.method = technique::lvsm;
  how.layers = 2;
  CHECK(run(scene, how)[0] == 1);  // both depths lie on the layer's ends, their mean at t
  how.lookup = layer_lookup::every;
  CHECK(run(scene, how)[0] == 0.5);  // layer 1 knows the exact share
  for (const auto& format : formats) {
    how.format = format;
    // 1/2 is no unorm code: the mean of the stored ends is, however.
    CHECK(run(scene, how)[0] == 0.5);
  }
}

TEST_CASE("hard case 35: receivers before everything are lit in every layer and format") {
  auto scene = test::small_frame(24, 16, 200, 31);
  for (float& x : scene.depth.texels) x = std::max(x, 0.3F);
  for (receiver& r : scene.receivers) r.t = 0.25F * r.u;
  for (const auto& format : formats) {
    for (const auto method : {technique::vsm, technique::lvsm}) {
      configuration how;
      how.method = method;
      how.layers = method == technique::lvsm ? 5 : 1;
      how.format = format;
      for (const double p : run(scene, how)) CHECK((p != p || p == 1));
    }
  }
}

TEST_CASE("hard cases 15 and 16: exponents at their cap stay finite, above it are refused") {
  const auto scene = test::small_frame(40, 32, 400, 32);
  for (const auto& [format, fits, too_much] :
       {std::tuple{"half", 5.54, 5.55}, {"binary32", 42.0, 45.0}}) {
    for (const auto method : {technique::evsm2, technique::evsm4}) {
      configuration how;
      how.method = method;
      how.format = format;
      how.blur_taps = 25;
      how.blur_sigma = 8;
      how.exponent = how.negative_exponent = fits;
      CAPTURE(format);
      for (const double p : run(scene, how)) CHECK((p != p || (p >= 0 && p <= 1)));
      std::size_t seen = 0;
      const auto lit = run(scene, how);
      for (std::size_t i = 0; i < lit.size(); ++i) {
        if (scene.receivers[i].surface == 0) continue;
        CHECK(lit[i] == lit[i]);
        ++seen;
      }
      CHECK(seen > 300);
      how.exponent = too_much;
      CHECK_THROWS_AS(run(scene, how), usage_error);
    }
  }
}
