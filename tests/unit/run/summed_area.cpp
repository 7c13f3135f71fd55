// Summed-area variance shadow maps against sums over their boxes in rationals.
#include "run/summed_area.hpp"

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/exactly.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;
using q = exact_rational;

TEST_CASE("exact savsm in integers equals rationals") {
  for (const bool tiny : {false, true}) {
    const auto scene = test::small_frame(29, 17, 120, 20, tiny);
    for (const double floor : {0.0, 1e-5, 1e-60}) {
      configuration how;
      how.method = technique::savsm;
      how.format = "exact";
      how.min_variance = floor;
      how.smallest_box = 3;
      how.bleeding_reduction = tiny ? 0.25 : 0;
      const auto got = run_pipeline(scene, how, make_plan(scene, how)).visibility;
      for (std::size_t i = 0; i < got.size(); ++i) {
        const receiver& r = scene.receivers[i];
        if (r.surface == 0) continue;
        const auto box = box_of(r, scene.depth.width, scene.depth.height, 3);
        q m1(0), m2(0);
        for (int y = box.y0; y < box.y1; ++y) {
          for (int x = box.x0; x < box.x1; ++x) {
            const q depth(scene.depth.at(x, y));
            m1 += depth;
            m2 += depth * depth;
          }
        }
        const q n(box.area());
        const q p = reduce_bleeding(chebyshev(mean_and_variance(m1 / n, m2 / n), q(r.t), q(floor)),
                                    q(how.bleeding_reduction));
        CAPTURE(i, tiny, floor, got[i], test::nearest_double(p));
        REQUIRE(got[i] == test::nearest_double(p));
      }
    }
  }
}

TEST_CASE("integer tables lose nothing, however they wrap; float tables drift") {
  auto scene = test::small_frame(300, 200, 400, 21);
  configuration how;
  how.method = technique::savsm;
  how.smallest_box = 7;
  how.min_variance = 1e-4;
  const auto run = [&](const std::string& format) {
    how.format = format;
    return run_pipeline(scene, how, make_plan(scene, how)).visibility;
  };
  // A map of codes: unorm16 then stores x without error, and only x^2 is rounded.
  for (float& x : scene.depth.texels) x = std::round(x * 65535) / 65535;
  const auto exact = run("exact"), narrow = run("unorm16"), wide = run("unorm32"),
             sums = run("binary32");
  double narrow_error = 0, wide_error = 0, sums_error = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact[i] != exact[i]) continue;
    narrow_error = std::max(narrow_error, std::fabs(narrow[i] - exact[i]));
    wide_error = std::max(wide_error, std::fabs(wide[i] - exact[i]));
    sums_error = std::max(sums_error, std::fabs(sums[i] - exact[i]));
  }
  // One rounding of each moment, e = q/2, is 3 e of variance at most; binary32's own shading adds
  // a few of its units (2^-24) on moments up to 1. |dp| <= D / (4 v) + 0.65 e / sqrt v, v = 1e-4.
  const auto bound = [](double e) { return 3 * e / (4 * 1e-4) + 0.65 * e / 1e-2; };
  CHECK(narrow_error <= bound(0.5 / 65535 + 0x1p-22));
  CHECK(wide_error <= bound(0x1p-22));
  CHECK(sums_error > wide_error);
  // 60,000 texels stay below half's 65,504, however badly; 300 x 219 do not.
  for (const double p : run("half")) CHECK((p != p || (p >= 0 && p <= 1)));
  scene = test::small_frame(300, 219, 10, 22);
  CHECK_THROWS_AS(run("half"), usage_error);
  CHECK_NOTHROW(run("bfloat16"));
}

TEST_CASE("boxes lie in the map and are as wide as asked") {
  receiver r;
  for (const float u : {0.0F, 0.25F, 0.999F, 1.0F}) {
    r.u = r.v = u;
    for (const float d : {0.0F, 0.01F, 0.25F, 1e20F}) {
      r.du_dx = r.dv_dy = d;
      const auto box = box_of(r, 100, 40, 5);
      CAPTURE(u, d, box.x0, box.x1, box.y0, box.y1);
      CHECK((box.x0 >= 0 && box.x1 <= 100 && box.y0 >= 0 && box.y1 <= 40));
      CHECK((box.x1 > box.x0 && box.y1 > box.y0));
      if (u == 0.25F && d == 0.25F) CHECK((box.x0 == 13 && box.x1 == 38));
    }
  }
  r = {};
  r.u = r.v = 0.5F;
  CHECK(box_of(r, 64, 64, 1).area() == 1);
  CHECK(box_of(r, 64, 64, 3).area() == 9);
}
