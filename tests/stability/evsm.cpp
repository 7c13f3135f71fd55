// Hard cases 15 and 34: exponential warps at their caps, and two components at a depth edge.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/texture/blur.hpp"
#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// Half near, half far, receivers in between and on both.
frame edge(float near, float far) {
  frame scene;
  scene.name = "edge";
  scene.depth = image<float>(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) scene.depth.at(x, y) = x < 8 ? near : far;
  }
  scene.view_width = 64;
  scene.view_height = 1;
  for (int i = 0; i < 64; ++i) {
    receiver r;
    r.u = static_cast<float>(i) / 64;
    r.v = 0.5F;
    r.t = std::array{near, (near + far) / 2, far, 1.0F}[static_cast<std::size_t>(i) % 4];
    r.surface = 1;
    scene.receivers.push_back(r);
  }
  return scene;
}

/// Every texel and every blurred sum of one format, all arithmetic in the format itself.
template <class F>
void check_finite(double c) {
  using number = real<F>;
  const evsm_constants k{c, c, 0};
  const kernel blur = gaussian_kernel(9, 2);
  image<number> map(33, 1, 4);
  for (int x = 0; x < 33; ++x) {
    const number depth = x % 8 < 4 ? number(1) : number(x / 33.0);
    map.at(x, 0, 0) = positive_warp(depth, k);
    map.at(x, 0, 1) = map.at(x, 0, 0) * map.at(x, 0, 0);
    map.at(x, 0, 2) = negative_warp(depth, k);
    map.at(x, 0, 3) = map.at(x, 0, 2) * map.at(x, 0, 2);
  }
  std::vector<number> row(map.row_size());
  blur_row_x<number>(map, blur, address::clamp, 0, row);
  for (std::size_t i = 0; i < row.size(); ++i) {
    CAPTURE(c, i, static_cast<double>(map.texels[i]), static_cast<double>(row[i]));
    REQUIRE(std::isfinite(static_cast<double>(map.texels[i])));
    REQUIRE(std::isfinite(static_cast<double>(row[i])));
  }
}

}  // namespace

TEST_CASE("hard case 15: nothing is infinite below the cap, in each format's own arithmetic") {
  check_finite<binary16>(5.54);
  check_finite<binary32>(42);
  check_finite<binary32>(44.3);
  check_finite<binary64>(350);
  check_finite<bfloat16>(exponent_cap(bfloat16::value, 2, 24));
  check_finite<fp8_e5m2>(exponent_cap(fp8_e5m2::value, 2, 24));
  check_finite<tf32>(exponent_cap(tf32::value, 2, 24));
}

TEST_CASE("hard case 15: runs below the cap give light in [0,1], above it a clear error") {
  const struct {
    const char* format;
    double below, above;
  } cases[] = {{"half", 5.54, 5.55},      {"binary32", 42, 45},   {"binary32", 44.3, 44.4},
               {"bfloat16", 44, 44.4},    {"binary64", 350, 355}, {"fp8_e5m2", 5, 5.6},
               {"fixed16.16", 5.19, 5.2}, {"fp8_e4m3", 2.8, 3.06}};
  const frame scene = edge(0.125F, 1.0F);
  for (const auto& c : cases)
    for (const technique method : {technique::evsm2, technique::evsm4}) {
      configuration how;
      how.method = method;
      how.format = c.format;
      how.exponent = how.negative_exponent = c.below;
      CAPTURE(c.format, c.below);
      for (const double p : run_pipeline(scene, how, make_plan(scene, how)).visibility) {
        REQUIRE((p >= 0 && p <= 1));
      }
      how.exponent = c.above;
      std::string message;
      try {
        run_pipeline(scene, how, make_plan(scene, how));
      } catch (const usage_error& e) {
        message = e.what();
      }
      CAPTURE(message);
      REQUIRE(message.find("overflows when squared in " + how.format) != std::string::npos);
      REQUIRE(message.find("at most") != std::string::npos);
    }
}

TEST_CASE("hard case 15: formats that end at 1 take any exponent, by a shift") {
  const frame scene = edge(0.25F, 0.75F);
  for (const char* format : {"unorm8", "unorm16", "snorm16", "ufixed0.16"})
    for (const double exponent : {1.0, 5.55, 45.0, 300.0}) {
      configuration how;
      how.method = technique::evsm4;
      how.format = format;
      how.exponent = how.negative_exponent = exponent;
      CAPTURE(format, exponent);
      for (const double p : run_pipeline(scene, how, make_plan(scene, how)).visibility) {
        REQUIRE((p >= 0 && p <= 1));
      }
    }
}

TEST_CASE("hard case 34: two components at a depth edge; four are the cure") {
  // Half of the filter sees an occluder at 0.2, half the far background; the receiver is between.
  // The background drags the mean of w+ past the receiver: all light, where half is right.
  const auto check = [](auto zero, double c, double tolerance) {
    using T = decltype(zero);
    const evsm_constants k{c, c, 0};
    const T near = static_cast<T>(0.2), far = static_cast<T>(1), t = static_cast<T>(0.6);
    const T half = static_cast<T>(0.5);
    const auto mean = [&](auto warp, bool squared) {
      const T a = warp(near, k), b = warp(far, k);
      return squared ? half * (a * a) + half * (b * b) : half * a + half * b;
    };
    const auto positive = [](const T& x, const evsm_constants& e) { return positive_warp(x, e); };
    const auto negative = [](const T& x, const evsm_constants& e) { return negative_warp(x, e); };
    const T two = evsm_positive_bound(mean(positive, false), mean(positive, true), t, k, 0.0);
    const T other = evsm_negative_bound(mean(negative, false), mean(negative, true), t, k, 0.0);
    CAPTURE(c, static_cast<double>(two), static_cast<double>(other));
    CHECK(static_cast<double>(two) == 1);
    CHECK(std::fabs(static_cast<double>(evsm_bound(two, other)) - 0.5) <= tolerance);
  };
  // (4) with alpha = 1/2, dx = e^(-0.2 c) and dy = -e^(-0.6 c): 1/2 + e^(-0.4 c) and less.
  check(0.0, 5, std::exp(-2.0));
  check(0.0, 20, std::exp(-8.0));
  check(0.0f, 20, std::exp(-8.0) + 1e-5);
  check(real<binary16>(0.0), 5, std::exp(-2.0) + 0.01);
  check(real<bfloat16>(0.0), 20, std::exp(-8.0) + 0.02);
}
