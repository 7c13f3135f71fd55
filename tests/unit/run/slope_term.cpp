// The slope term (12) through whole runs: with the chain rule for exponential warps, in summed-area
// tables, and beyond a layer's ends.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "bitshade/formats/name.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/exactly.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

using big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>,
                                          boost::multiprecision::et_off>;

constexpr float first = 0.25F, across = 0x1p-6F, down = 0x1p-7F;

/// A slanted plane, one receiver a texel, each behind the plane by the same distance.
frame slanted(float behind) {
  frame scene;
  scene.name = "slanted";
  scene.depth = image<float>(12, 10);
  scene.view_width = 12;
  scene.view_height = 10;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 12; ++x) {
      scene.depth.at(x, y) = first + across * static_cast<float>(x) + down * static_cast<float>(y);
      receiver r;
      r.u = std::floor((static_cast<float>(x) + 0.5F) / 12 * 0x1p24F) * 0x1p-24F;
      r.v = std::floor((static_cast<float>(y) + 0.5F) / 10 * 0x1p24F) * 0x1p-24F;
      r.t = scene.depth.at(x, y) + behind;
      r.surface = 1;
      scene.receivers.push_back(r);
    }
  }
  return scene;
}

/// One texel a light: what it stores is all that is seen.
configuration one_texel(technique method, const std::string& format) {
  configuration how;
  how.method = method;
  how.format = format;
  how.blur_taps = 0;
  how.filter = texel_filter::nearest;
  how.smallest_box = 1;
  how.min_variance = 0;
  how.slope_term = true;
  how.exponent = 5;
  how.negative_exponent = 3;
  return how;
}

bool inside(std::size_t i) { return i % 12 > 0 && i % 12 < 11 && i / 12 > 0 && i / 12 < 9; }

cell run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how));
}

/// Chebyshev's bound over a texel at x whose depths vary by the slopes' quarter: the warp's
/// derivative times theirs, in 120 digits.
big warped_light(const big& x, const big& t, double rate) {
  const big w = exp(big(rate) * x), steep = big(rate) * w;  // of e^(rate x), rate of either sign
  const big slopes = (big(across) * across + big(down) * down) / 4;
  const big variance = steep * steep * slopes, d = exp(big(rate) * t) - w;
  return variance / (variance + d * d);
}

}  // namespace

TEST_CASE("slope term of EVSM: the derivative of the warp times the depth's, in 120 digits") {
  for (const float behind : {0x1p-8F, 0x1p-5F, 0x1p-3F}) {
    const frame scene = slanted(behind);
    for (const technique method : {technique::evsm2, technique::evsm4}) {
      for (const auto& [format, tolerance] :
           {std::pair{"exact", 0x1p-53}, {"binary64", 1e-11}, {"binary32", 1e-3}}) {
        const auto got = run(scene, one_texel(method, format));
        for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
          if (!inside(i)) continue;
          const big x = scene.depth.texels[i], t = scene.receivers[i].t;
          big p = warped_light(x, t, 5);
          if (method == technique::evsm4) p = std::min(p, warped_light(x, t, -3));
          CAPTURE(std::string(name_of(method)), format, behind, i, got.visibility[i],
                  static_cast<double>(p));
          CHECK(std::fabs(got.visibility[i] - static_cast<double>(p)) <= tolerance);
          CHECK(got.visibility[i] > 0);  // without the term it would be a step
        }
      }
    }
  }
}

TEST_CASE("slope term of EVSM: no slope at a silhouette, and no room needed under the cap") {
  frame scene = slanted(0x1p-4F);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 12; ++x) scene.depth.at(x, y) = x < 6 ? 0.25F : 1.0F;
  }
  for (const auto& format : {"exact", "half", "unorm16"}) {
    configuration how = one_texel(technique::evsm4, format);
    const auto with = run(scene, how).visibility;
    how.slope_term = false;
    CHECK(with == run(scene, how).visibility);
  }
  // The steepest planes that end at depth 1, at the largest exponent.
  for (const float slope : {0x1p-4F, 0x1p-2F, 0.5F}) {
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 12; ++x) {
        scene.depth.at(x, y) = std::max(0.0F, 1 - slope * static_cast<float>((11 - x) + (9 - y)));
      }
    }
    for (const auto& format : {"half", "unorm16", "bfloat16"}) {
      configuration how = one_texel(technique::evsm4, format);
      const double cap = exponent_cap(*parse_encoding(format));
      how.exponent = how.negative_exponent = std::min(cap, 40.0);
      for (const double p : run(scene, how).visibility) CHECK((p >= 0 && p <= 1));
      // The sum itself never passes the square of the warp's largest value.
      const evsm_constants k{how.exponent, how.exponent, 0};
      const double most = positive_warp(1.0, k) * positive_warp(1.0, k);
      for (double x = 0; x <= 1; x += 0x1p-6) {
        const double w = positive_warp(x, k);
        double m2 = w * w;
        add_warped_slope(2 * 0.25 * (1 - x) * (1 - x), k.positive, w, m2);
        CHECK(m2 <= most * (1 + 1e-12));
      }
    }
  }
}

TEST_CASE("slope term of a summed-area table: each texel's, whatever the rectangle") {
  using q = exact_rational;
  const frame scene = slanted(0x1p-5F);
  for (const int box : {1, 3}) {
    configuration how = one_texel(technique::savsm, "exact");
    how.smallest_box = box;
    const auto got = run(scene, how), rounded = [&] {
      configuration half = how;
      half.format = "binary64";
      return run(scene, half);
    }();
    const q slopes = q(across) * q(across) + q(down) * q(down), d = q(0x1p-5F);
    // Over 3 x 3 texels the depths' own variance is 2/3 of the squared slopes.
    const q variance = slopes / q(4) + (box == 3 ? slopes * q(2) / q(3) : q(0));
    const double expected = test::nearest_double(variance / (variance + d * d));
    for (std::size_t i = 0; i < got.visibility.size(); ++i) {
      const bool deep_inside = i % 12 > 1 && i % 12 < 10 && i / 12 > 1 && i / 12 < 8;
      if (!deep_inside) continue;
      CAPTURE(box, i, got.visibility[i], expected);
      CHECK(got.visibility[i] == expected);
      CHECK(std::fabs(rounded.visibility[i] - expected) <= 1e-9);
    }
  }
}
