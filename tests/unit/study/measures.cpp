#include "bitshade/study/measures.hpp"

#include <limits>

#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("error figures by hand") {
  const std::vector<double> got{0.5, 0.75, 1.0, std::numeric_limits<double>::quiet_NaN()};
  const std::vector<double> wanted{0.5, 0.5, 1.5, 0.0};
  const auto f = compare(got, wanted);
  CHECK(f.count == 3);
  CHECK(f.largest == 0.5);
  CHECK(f.p999 == 0.5);
  CHECK(f.signed_mean == -0.25 / 3);
  CHECK(f.rmse == std::sqrt((0.0625 + 0.25) / 3));
}

TEST_CASE("the 99.9th percentile leaves one pixel of a thousand out") {
  std::vector<double> got(2000, 0.0), wanted(2000, 0.0);
  got[7] = 1;
  got[8] = 0.5;
  CHECK(compare(got, wanted).p999 == 0);
  got[9] = 0.25;
  CHECK(compare(got, wanted).p999 == 0.25);
  CHECK(compare(got, wanted).largest == 1);
}

TEST_CASE("bleeding, acne, violations, jump and banding of a hand-made row") {
  frame scene;
  scene.view_width = 4;
  scene.view_height = 1;
  scene.receivers.resize(4);
  for (auto& r : scene.receivers) r.surface = 1;
  const std::vector<double> geometric{0, 0, 1, 1}, pcf{0, 0, 0.75, 1};
  const std::vector<double> exact{0.25, 0, 1, 1}, seen{0.5, 0, 0.5, 1};
  const std::vector<int> layer{0, 0, 1, 1};
  const auto m = measure(scene, {seen, exact, geometric, pcf, layer});
  CHECK(m.receivers == 4);
  CHECK(m.bleed_area == 0.25);
  CHECK(m.bleed_integral == 0.125);
  CHECK(m.acne_area == 0.25);
  CHECK(m.violations == 1);
  CHECK(m.largest_violation == 0.25);
  CHECK(m.jump == 0);       // 0 to 0.5 where truth steps from 0 to 1
  CHECK(m.banding == 0.5);  // errors 0.25, 0, -0.5, 0
}
