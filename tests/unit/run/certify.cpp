// Certificates hold what exact arithmetic gives, on every scene, and are narrower than the bound.
#include "run/certify.hpp"

#include <random>
#include <string>

#include "bitshade/interop/rational.hpp"
#include "io/error.hpp"
#include "scene/scene.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

double mean_width(const std::vector<light_interval>& all) {
  double sum = 0, count = 0;
  for (const auto& i : all) {
    if (i.low == i.low) sum += i.width(), ++count;
  }
  REQUIRE(count > 0);
  return sum / count;
}

/// How much narrower each certificate is than the one before, on average over a scene; of sums in
/// binary32 the running one.
constexpr double stored_share = 0.25, running_share = 0.8, sums_share = 0.45;

/// The exact run must lie in all three, each of which lies in the one before.
void check_held(const frame& scene, const configuration& how) {
  configuration exact = how;
  exact.format = "exact";
  const auto truth = run_pipeline(scene, exact, make_plan(scene, exact)).visibility;
  const auto got = certify(scene, how);
  std::size_t out = 0, wider = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] != truth[i]) continue;
    const auto holds = [&](const light_interval& c) {
      return c.low - 0x1p-53 <= truth[i] && truth[i] <= c.high + 0x1p-53;  // truth is rounded once
    };
    if (!holds(got.running[i]) || !holds(got.stored[i]) || !holds(got.global[i])) {
      if (out++ == 0)
        UNSCOPED_INFO("receiver " << i << ": " << truth[i] << " not in " << got.running[i].low
                                  << " .. " << got.running[i].high);
    }
    wider += got.running[i].width() > got.stored[i].width() ||
             got.stored[i].width() > got.global[i].width();
  }
  CAPTURE(scene.name, how.key());
  CHECK(out == 0);
  CHECK(wider == 0);
}

/// A scene of the command, small.
frame small_scene(const char* name) {
  scene_options options;
  options.map_size = 96;
  options.view_width = 64;
  options.view_height = 40;
  options.given = {"--size", "--view"};
  return load_input(name, options);
}

}  // namespace

TEST_CASE(
    "certificates hold the exact visibility on every scene, and are narrower than the bound") {
  for (const auto* name : {"planes", "garden", "slope", "beams", "rts", "city"}) {
    const frame scene = small_scene(name);
    for (const auto* format : {"unorm16", "half", "unorm24"}) {
      for (const int layers : {1, 4}) {
        configuration how;
        how.method = technique::lvsm;
        how.layers = layers;
        how.format = format;
        how.min_variance = 1e-4;
        check_held(scene, how);
        const auto got = certify(scene, how);
        CAPTURE(name, format, layers);
        CHECK(mean_width(got.stored) <= stored_share * mean_width(got.global));
        CHECK(mean_width(got.running) <= running_share * mean_width(got.stored));
      }
    }
  }
}

TEST_CASE("certificates hold with mips, probes, transitions, reduction and tiny floors") {
  const auto scene = test::small_frame(32, 16, 400, 31, true);
  configuration how;
  how.method = technique::lvsm;
  how.layers = 3;
  how.overlap = 0.0625;
  how.transition = true;
  how.bleeding_reduction = 0.2;
  for (const auto* format : {"unorm8", "unorm16", "half", "bfloat16", "binary32", "binary64"}) {
    how.format = format;
    how.filter = texel_filter::bilinear;
    how.min_variance = 1e-5;
    check_held(scene, how);
    how.filter = texel_filter::trilinear;
    how.max_anisotropy = 4;
    check_held(scene, how);
    how.max_anisotropy = 1;
    how.min_variance = 0;
    check_held(scene, how);
  }
}

TEST_CASE("certificates of summed-area tables hold the exact visibility on every scene") {
  for (const auto* name : {"planes", "garden", "slope", "beams", "rts", "city"}) {
    const frame scene = small_scene(name);
    configuration how;
    how.method = technique::savsm;
    how.min_variance = 1e-4;
    for (const auto* format : {"unorm16", "unorm32", "half", "binary32", "e8m30"}) {
      how.format = format;
      check_held(scene, how);
      const auto got = certify(scene, how);
      CAPTURE(name, format);
      if (std::string(format) == "half") continue;  // sums of 9216 texels: nothing is certain
      // What roundings of sums really did is far less than what so many of them could do.
      const bool sums = std::string(format) == "binary32";
      CHECK(mean_width(got.running) <= (sums ? sums_share : running_share) * mean_width(got.stored));
    }
  }
}

TEST_CASE("certificates hold for small rectangles, reduction, tiny depths and coarse sums") {
  configuration how;
  how.method = technique::savsm;
  for (const bool tiny : {false, true}) {
    const auto scene = test::small_frame(37, 23, 400, 33, tiny);
    for (const auto* format : {"unorm8", "ufixed2.14", "snorm12", "half", "bfloat16", "e5m7",
                               "e8m3", "binary32", "binary64"}) {
      how.format = format;
      for (const double floor : {0.0, 1e-5, 1e-2}) {
        how.min_variance = floor;
        how.smallest_box = floor == 0 ? 1 : 4;
        how.bleeding_reduction = floor == 1e-5 ? 0.2 : 0;
        check_held(scene, how);
      }
    }
  }
}

TEST_CASE("the box of moments holds every distribution within it") {
  std::mt19937_64 random(41);
  const auto unit = [&] { return static_cast<double>(random() >> 34) * 0x1p-30; };
  for (int i = 0; i < 300; ++i) {
    const double a = unit(), b = unit(), share = unit(), t = unit(),
                 floor = unit() < 0.5 ? 1e-5 : 1e-2;
    const rational m1 = rational(share) * rational(a) + (1 - rational(share)) * rational(b);
    const rational m2 = rational(share) * rational(a) * rational(a) +
                        (1 - rational(share)) * rational(b) * rational(b);
    rational v = m2 - m1 * m1;
    if (v < rational(floor)) v = rational(floor);
    const rational d = rational(t) - m1;
    const auto p = static_cast<double>(d > 0 ? rational(v / (v + d * d)) : rational(1));
    const double r1 = unit() * 0.02, r2 = unit() * 0.02;
    const auto box = light_of_box(static_cast<double>(m1) + r1 * (2 * unit() - 1), r1,
                                  static_cast<double>(m2) + r2 * (2 * unit() - 1), r2, t, floor);
    CAPTURE(a, b, share, t, floor, r1, r2, p, box.low, box.high);
    CHECK(box.low <= p);
    CHECK(p <= box.high);
  }
}

TEST_CASE("what certificates are not derived for is refused") {
  const auto scene = test::small_frame(8, 8, 4, 32);
  configuration how;
  how.method = technique::msm;
  CHECK_THROWS_AS(certify(scene, how), usage_error);
  how = {};
  how.slope_term = true;
  CHECK_THROWS_AS(certify(scene, how), usage_error);
}
