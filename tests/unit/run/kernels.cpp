// Kernels of percentage-closer filtering, several lookups against them, and filters that a plan
// leaves out or a map cannot give.
#include <bit>
#include <cmath>

#include "bitshade/texture/gaussian.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

cell run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how), 2);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

}  // namespace

TEST_CASE("PCF over a VSM never gives less light than PCF over the same lookups, exactly") {
  const auto scene = test::with_samples(test::small_frame(19, 16, 120, 61), 2, 62);
  for (const technique method : {technique::vsm, technique::evsm4}) {
    configuration how;
    how.method = method;
    how.format = "exact";
    how.blur_taps = 3;
    how.min_variance = 0;
    how.filtered.lookups = 3;
    how.filtered.msaa = 2;
    const auto got = run(scene, how);
    const auto truth = truth_pcf(scene, how);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] == truth[i]) CHECK(got.visibility[i] >= truth[i] - 0x1p-53);
    }
  }
}

TEST_CASE("PCF kernels: 2x2 with bilinear weights, 3x3 box and Gaussian, 9x9 Gaussian") {
  // One near texel in an empty map: its weight in each kernel is what the receiver loses.
  frame scene = test::small_frame(32, 32, 1, 1);
  for (float& x : scene.depth.texels) x = 1;
  scene.depth.at(10, 12) = 0.25F;
  receiver& r = scene.receivers[0];
  r = receiver{};
  r.surface = 1;
  r.t = 0.5F;
  r.u = (10.5F + 0.25F) / 32;  // a quarter of a texel to the right
  r.v = 12.5F / 32;
  configuration how;
  how.method = technique::pcf;
  const auto lit = [&](const std::string& format) {
    how.format = format;
    return run(scene, how).visibility[0];
  };
  const auto check = [&](double weight) {
    CAPTURE(how.key());
    CHECK(std::fabs(lit("exact") - (1 - weight)) <= 0x1p-52);
    CHECK(std::fabs(lit("binary32") - (1 - weight)) <= 9 * 9 * 0x1p-24);
    CHECK(std::fabs(lit("half") - (1 - weight)) <= 9 * 9 * 0x1p-24);
  };
  how.blur_taps = 0;
  check(0.75);  // bilinear: 3/4 of the texel itself

  how.filter = texel_filter::nearest;
  how.blur_taps = 3;
  how.filtered.shape = blur_shape::box;
  const double third = box_kernel(3).weights[1];
  CHECK(std::fabs(third - 1.0 / 3) <= 0x1p-24);
  check(third * third);

  how.filtered.shape = blur_shape::gaussian;
  how.blur_sigma = 1;
  const double middle = gaussian_kernel(3, 1).weights[1];
  check(middle * middle);

  how.filter = texel_filter::bilinear;
  how.blur_taps = 9;
  how.blur_sigma = 2;
  const auto nine = gaussian_kernel(9, 2).weights;
  check((0.75 * nine[4] + 0.25 * nine[3]) * nine[4]);
}

TEST_CASE("fractions on the grid are left out of a linear-sampled blur, and no others") {
  const auto scene = test::small_frame(16, 16, 100, 71);
  configuration how;
  how.filtered.way = blur_way::linear;
  const auto fractions = [&] { return make_plan(scene, how).effects.back(); };
  CHECK(fractions().simulated());
  CHECK(fractions().evidence == "4 of 5 fetches lie between steps of 2^-8 texels");
  how.filtered.shape = blur_shape::box;  // pairs of equal weights meet in their middle
  CHECK_FALSE(fractions().needed);
  CHECK(fractions().evidence == "0 of 5 fetches lie between steps of 2^-8 texels");
  const plan p = make_plan(scene, how);
  CHECK(same_bits(run_pipeline(scene, how, p).visibility,
                  run_pipeline(scene, how, p.everything()).visibility));
}

TEST_CASE("a map without samples refuses them, and says what it has") {
  const auto scene = test::small_frame(8, 8, 4, 81);
  configuration how;
  how.filtered.msaa = 4;
  CHECK_THROWS_WITH(make_plan(scene, how),
                    Catch::Contains("this depth map has one sample a texel"));
  how.filtered.msaa = 3;
  CHECK_THROWS_WITH(make_plan(scene, how), Catch::Contains("1, 2, 4 or 8"));
}
