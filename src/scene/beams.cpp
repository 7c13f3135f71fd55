// beams: [LauritzenMcCool08] fig. 1 and 6 to 8. Beams at heights r^k over a wide plane: shadows of
// extreme depth ratios overlap.
#include <algorithm>

#include "scene/builder.hpp"
#include "scene/embedded.hpp"
#include "scene/random.hpp"
#include "scene/trig.hpp"

namespace bitshade {
namespace {

constexpr double half = 4;
constexpr double height = 4;
constexpr double highest = 0.9;  // of the depth range, over the plane

scene build(const parameter_values& parameter) {
  scene s;
  light_from_above(s, half, height, height);
  add_quad(s, {-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});
  const int count = parameter.count("count");
  double above = highest * height;
  for (int k = count - 1; k >= 0; --k, above /= parameter["ratio"]) {
    random_stream random(parameter.seed(), static_cast<std::uint64_t>(k));
    // Golden-ratio turns spread any number of directions evenly; each beam passes near the middle.
    const turn angle(0.5 * (0.6180339887498949 * k + parameter["animation"]));
    const double offset = random.next(-1, 1) * parameter["spread"];
    const double length = half * random.next(0.55, 0.95), width = parameter["width"] / 2;
    const double thick = std::min(0.15 * above, 0.05);
    const glm::dvec3 along(angle.cosine, 0, angle.sine), across(-angle.sine, 0, angle.cosine);
    add_box(s, {across * offset + glm::dvec3(0, above - thick / 2, 0),
                along * length,
                {0, thick / 2, 0},
                across * width});
  }
  s.camera.eye = {1.2, 5.6, 6.4};
  s.camera.target = {0, 0, 0.2};
  s.camera.field_of_view = 42;
  return s;
}

}  // namespace

embedded_scene beams_scene() {
  return {{"beams",
           "rotated beams at heights r^k over a plane: extreme depth ratios",
           {{"count", "beams", 40, 1, 400, true},
            {"ratio", "r: each beam's height to the next lower one's", 1.6, 1.01, 4},
            {"width", "width of a beam", 0.16, 0.01, 1},
            {"spread", "distance from the middle that a beam may have", 1.6, 0, 3},
            animation_parameter("half a turn of all beams")}},
          build};
}

}  // namespace bitshade
