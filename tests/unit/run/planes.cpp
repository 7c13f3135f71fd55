// The scene whose visibility is known in closed form: equation (4) of [LauritzenMcCool08].
#include <set>

#include "bitshade/shadow/pcf.hpp"
#include "run/lookup.hpp"
#include "run/pipeline.hpp"
#include "scene/scene.hpp"
#include "support/catch.hpp"
#include "support/exactly.hpp"

using namespace bitshade;
using q = exact_rational;

TEST_CASE("in exact arithmetic `planes` is equation (4), with the kernel's weight as coverage") {
  scene_options options;
  options.map_size = 128;
  options.view_width = 160;
  options.view_height = 100;
  configuration how;
  how.format = "exact";
  how.min_variance = 0;
  const auto weights = gaussian_kernel(how.blur_taps, how.blur_sigma);
  const std::vector<q> blur(weights.weights.begin(), weights.weights.end());
  std::set<double> values;
  for (const char* dx : {"0.02", "0.4", "0.6"}) {
    for (const char* dy : {"0.005", "0.1", "0.3"}) {
      options.parameters = {{"dx", dx}, {"dy", dy}, {"coverage", "0.4"}};
      const frame scene = load_input("planes", options);
      const auto got = run_pipeline(scene, how, make_plan(scene, how)).visibility;
      int two_occluders = 0;
      for (std::size_t i = 0; i < got.size(); ++i) {
        const receiver& r = scene.receivers[i];
        if (r.surface == 0) continue;
        const int w = scene.depth.width, h = scene.depth.height;
        const auto at = locate(q(r.u), q(r.v), w, h, map_address);
        const std::span<const q> taps(blur);
        const auto columns = blurred_axis<q>(at.x0, at.x1, at.fx, q(1), taps, w, map_address);
        const auto rows = blurred_axis<q>(at.y0, at.y1, at.fy, q(1), taps, h, map_address);
        std::set<float> depths;
        for (std::size_t y = 0; y < rows.count; ++y) {
          for (std::size_t x = 0; x < columns.count; ++x) {
            depths.insert(scene.depth.at(columns.index[x], rows.index[y]));
          }
        }
        if (depths.size() != 2 || !(*depths.rbegin() < r.t)) continue;
        const float a = *depths.begin(), b = *depths.rbegin();
        const q alpha = lit_share<q>(columns, rows, [&](int x, int y, std::size_t, std::size_t) {
          return scene.depth.at(x, y) == a;
        });
        const q delta_x = q(b) - q(a), delta_y = q(r.t) - q(b);
        const q spread = alpha * (q(1) - alpha) * delta_x * delta_x;
        const q reach = delta_y + alpha * delta_x;
        const double expected = test::nearest_double(spread / (spread + reach * reach));
        CAPTURE(dx, dy, i, a, b, r.t, got[i], expected);
        REQUIRE(got[i] == expected);
        ++two_occluders;
        values.insert(expected);
      }
      CAPTURE(dx, dy);
      CHECK(two_occluders >= 10);  // the thinnest gap hides most of what lies under B
    }
  }
  CHECK(values.size() > 200);
}
