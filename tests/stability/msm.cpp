// Hard cases 33 and 36: singular four-moment matrices, and bleeding reduction as alpha nears 1.
#include <cmath>
#include <string>
#include <vector>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/msm.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// A map of one or two depths, looked at from every side of them.
frame flat(float a, float b) {
  frame scene;
  scene.name = "flat";
  scene.depth = image<float>(12, 12);
  for (std::size_t i = 0; i < scene.depth.texels.size(); ++i) {
    scene.depth.texels[i] = i % 12 < 6 ? a : b;
  }
  scene.view_width = 60;
  scene.view_height = 1;
  for (int i = 0; i < 60; ++i) {
    receiver r;
    r.u = static_cast<float>(i % 12) / 12 + 0x1p-5F;
    r.v = 0.5F;
    const float depths[] = {a, b, (a + b) / 2, 0.0F, 1.0F};
    r.t = depths[i / 12];
    r.surface = 1;
    scene.receivers.push_back(r);
  }
  return scene;
}

}  // namespace

TEST_CASE("hard case 33: singular moments in every format, biased or not: never NaN") {
  for (const auto& [a, b] : std::vector<std::pair<float, float>>{
           {0.0F, 0.0F}, {1.0F, 1.0F}, {0.5F, 0.5F}, {0.25F, 0.25F}, {0.0F, 1.0F}, {0.3F, 0.7F}}) {
    const frame scene = flat(a, b);
    for (const char* format : {"unorm8", "unorm16", "snorm16", "half", "bfloat16", "tf32",
                               "fp8_e4m3", "binary32", "binary64", "fixed16.16", "exact"})
      for (const double bias : {0.0, 6e-5, 1e-2})
        for (const bool optimised : {true, false}) {
          configuration how;
          how.method = technique::msm;
          how.format = format;
          how.moment_bias = bias;
          how.optimised_basis = optimised;
          const auto got = run_pipeline(scene, how, make_plan(scene, how));
          for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
            CAPTURE(a, b, format, bias, optimised, i, got.visibility[i]);
            REQUIRE((got.visibility[i] >= 0 && got.visibility[i] <= 1));
          }
        }
  }
}

TEST_CASE("hard case 33: without a bias one depth is Chebyshev's step, exactly") {
  const frame scene = flat(0.25F, 0.25F);
  configuration how;
  how.method = technique::msm;
  how.format = "exact";
  how.moment_bias = 0;
  const auto got = run_pipeline(scene, how, make_plan(scene, how));
  CHECK(got.notes.empty());
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    CHECK(got.visibility[i] == (scene.receivers[i].t <= 0.25F ? 1 : 0));
  }
}

TEST_CASE("hard case 36: bleeding reduction as alpha nears 1 has no 0/0") {
  const auto check = [](auto zero, double below_one) {
    using T = decltype(zero);
    for (const double alpha : {0.0, 0.5, below_one, 1.0})
      for (const double p : {0.0, 0.25, 0.999, 1.0}) {
        const T held = static_cast<T>(p), taken = static_cast<T>(alpha);
        const double got = static_cast<double>(reduce_bleeding(held, taken));
        CAPTURE(alpha, p, got);
        REQUIRE((got >= 0 && got <= 1));
        if (held == static_cast<T>(1)) REQUIRE(got == 1);
        if (held <= taken && held < static_cast<T>(1)) REQUIRE(got == 0);
      }
  };
  check(0.0, 0x1.fffffffffffffp-1);
  check(0.0f, 0x1.fffffep-1);
  check(real<binary16>(0.0), 0x1.ffcp-1);
  check(real<bfloat16>(0.0), 0x1.fep-1);
  check(real<unorm16>(0.0), 65534.0 / 65535);
}

TEST_CASE(
    "hard case 36: every technique with a floor of light that is nearly all, in every format") {
  const frame scene = flat(0.25F, 0.75F);
  for (const technique method : {technique::vsm, technique::lvsm, technique::evsm2,
                                 technique::evsm4, technique::esm, technique::csm, technique::msm})
    for (const char* format : {"unorm16", "half", "binary32", "exact"}) {
      configuration how;
      how.method = method;
      how.format = format;
      how.bleeding_reduction = 1 - 0x1p-24;
      const auto got = run_pipeline(scene, how, make_plan(scene, how));
      for (const double p : got.visibility) {
        CAPTURE(std::string(name_of(method)), format, p);
        REQUIRE((p >= 0 && p <= 1));
      }
    }
}
