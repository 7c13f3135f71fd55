// Hard case 27: the slope term (12) at silhouettes and with warped depths.
#include <algorithm>
#include <cmath>
#include <vector>

#include "bitshade/formats/decode.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/moments.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"

using namespace bitshade;
using test::format_named;
using test::half_step;
using q = exact_rational;

namespace {

/// What the term adds to M2 of each texel of a row whose neighbours above and below are equal.
template <class T>
std::vector<T> added(const std::vector<T>& row) {
  std::vector<T> texels(2 * row.size(), T(0));
  add_slope_row<T>(row, row, row, texels, 2);
  std::vector<T> result;
  for (std::size_t i = 0; i < row.size(); ++i) result.push_back(texels[2 * i + 1]);
  return result;
}

std::vector<q> warped(const std::vector<q>& depths, const interval& layer) {
  std::vector<q> out;
  for (const q& x : depths) out.push_back(warp(x, layer));
  return out;
}

/// A plate at 1/4 in front of a plane that falls away by 1/64 a texel.
std::vector<q> silhouette() {
  std::vector<q> row;
  for (int i = 0; i < 12; ++i) row.push_back(i < 5 ? q(0.25) : q(0.5) + q(i) / q(64));
  return row;
}

}  // namespace

TEST_CASE("hard case 27: at a silhouette the other surface's distance is no slope") {
  const auto row = silhouette();
  const auto term = added(row);
  const q own = q(1) / q(64) * (q(1) / q(64)) / q(4);
  for (std::size_t i = 0; i < row.size(); ++i) {
    CAPTURE(i);
    // The plate is flat; the plane has its slope from its own side; at the map's border, where a
    // texel is its own neighbour, there is none.
    CHECK(term[i] == (i < 5 || i + 1 == row.size() ? q(0) : own));
  }
  // A central difference, the plain method, takes the edge for a slope of half its height.
  const q edge = (row[5] - row[3]) / q(2);
  CHECK(edge * edge / q(4) > q(50) * own);
}

TEST_CASE("hard case 27: a peak and a pit have no slope, nor has what a layer clamps") {
  CHECK(added<q>({q(0.5), q(0.25), q(0.5)})[1] == q(0));
  CHECK(added<q>({q(0.25), q(0.5), q(0.25)})[1] == q(0));
  std::vector<q> plane;
  for (int i = 0; i < 16; ++i) plane.push_back(q(i) / q(16));
  const auto term = added(warped(plane, {0.25, 0.5}));
  for (std::size_t i = 0; i < plane.size(); ++i) {
    CAPTURE(i);  // 4 to 8 are inside; 4 and 8 end the slope, one of their differences is 0
    const q slope = q(1) / q(16) / q(0.25);
    CHECK(term[i] == (i > 4 && i < 8 ? slope * slope / q(4) : q(0)));
  }
}

TEST_CASE("hard case 27: within a layer of width w the term grows by 1 / w^2, the chain rule") {
  const auto row = silhouette();
  const auto plain = added(row);
  for (const interval& layer : {interval{0, 1}, interval{0.125, 0.875}, interval{0.25, 0.75}}) {
    const auto term = added(warped(row, layer));
    const q width(layer.far - layer.near);
    for (std::size_t i = 1; i + 1 < row.size(); ++i) {
      CAPTURE(i, layer.near, layer.far);
      CHECK(term[i] * width * width == plain[i]);
    }
  }
}

TEST_CASE(
    "hard case 27: on an exponential warp the term is (c w)^2 times the depth's, in between") {
  // w is convex, so that its difference lies between c w h at both ends; the smaller one is taken.
  for (const double c : {1.0, 5.0, 42.0}) {
    const evsm_constants constants{c, c, 0};
    const double h = 0x1p-10;
    std::vector<double> w;
    for (int i = 0; i < 40; ++i) w.push_back(positive_warp(0.5 + i * h, constants));
    const auto term = added(w);
    for (std::size_t i = 1; i + 1 < w.size(); ++i) {
      const double at_low = c * w[i - 1] * h, at_high = c * w[i] * h;
      CAPTURE(c, i);
      CHECK(term[i] >= at_low * at_low / 4 * (1 - 1e-9));
      CHECK(term[i] <= at_high * at_high / 4 * (1 + 1e-9));
    }
  }
}

TEST_CASE("hard case 27 in every format: slanted planes are lit up to a silhouette, no farther") {
  // Columns of depth 1/4 + x/32 behind a plate over the left half at depth 1/8: receivers on the
  // plane look half a texel beside the centres, where the plane itself is nearer by d = 1/64.
  frame scene;
  scene.depth = image<float>(16, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 16; ++x)
      scene.depth.at(x, y) = x < 8 ? 0.125F : 0.25F + static_cast<float>(x) / 32;
  const auto look = [&](float x, float depth) {
    receiver r;
    r.u = x / 16;
    r.v = 0.375F;
    r.t = depth;
    r.surface = 1;
    scene.receivers.push_back(r);
  };
  for (int x = 9; x < 14; ++x)
    look(static_cast<float>(x) + 0.984375F, 0.25F + (static_cast<float>(x) + 0.484375F) / 32);
  for (int x = 1; x < 7; ++x) look(static_cast<float>(x) + 0.5F, 0.625F);  // behind the plate
  scene.view_width = static_cast<int>(scene.receivers.size());
  scene.view_height = 1;
  configuration how;
  how.blur_taps = 0;
  how.filter = texel_filter::nearest;
  how.min_variance = 1e-7;
  how.slope_term = true;
  for (const std::string_view name :
       {"unorm8", "unorm16", "unorm24", "snorm16", "half", "bfloat16", "binary32", "exact"}) {
    how.format = name;
    const auto got = run_pipeline(scene, how, make_plan(scene, how));
    configuration without = how;
    without.slope_term = false;
    const auto plain = run_pipeline(scene, without, make_plan(scene, without));
    // v = (1/32)^2 / 4 less what both moments' rounding takes away (theory: 3 half steps and their
    // square), d + half a step: the least light that the term promises.
    const double half = how.exact() ? 0 : half_step(format_named(name));
    const double v = 1.0 / 4096 - 3 * half - half * half, d = 31.0 / 2048 + half;
    const double promised = v > 1e-7 ? v / (v + d * d) : 0;
    for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
      CAPTURE(std::string(name), i, got.visibility[i], plain.visibility[i], promised);
      if (i < 5) {
        CHECK(got.visibility[i] >= promised * (1 - 1e-6));
        CHECK(got.visibility[i] >= plain.visibility[i]);
      } else {
        CHECK(got.visibility[i] == plain.visibility[i]);  // the plate is flat: nothing is added
      }
    }
    if (how.exact()) {
      CHECK(got.visibility[2] > 0.5);
      CHECK(plain.visibility[2] < 1e-3);  // acne without it
    }
  }
}
