// planes: [LauritzenMcCool08] fig. 2, whose visibility is known in closed form (equation 4).
#include <algorithm>

#include "scene/builder.hpp"
#include "scene/embedded.hpp"

namespace bitshade {
namespace {

constexpr double half = 2;    // of the window
constexpr double height = 4;  // world units of depth 1; a power of two keeps depths exact

scene build(const parameter_values& parameter) {
  const double c = parameter["receiver"];
  const double b = c - parameter["dy"];
  const double a = b - parameter["dx"];
  // The moving edge travels over half the map and back to where it is at rest.
  const double t = parameter["animation"];
  const double shift = 0.5 * (t < 0.5 ? t : 1 - t);
  const double coverage = std::clamp(parameter["coverage"] - shift, 0.0, 1.0);
  const auto level = [&](double depth) { return (c - depth) * height; };

  scene s;
  light_from_above(s, half, c * height, height);
  add_quad(s, {-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});  // C
  // B leaves a strip of C free in front, where A is the only occluder (claim C1).
  const double gap = level(b), front = 0.5 * half;
  const double thickness = std::min(0.25 * gap, 0.06);
  add_box(s, {{0, gap - thickness / 2, (front - half) / 2},
              {half, 0, 0},
              {0, thickness / 2, 0},
              {0, 0, (front + half) / 2}});
  if (coverage > 0) {
    add_quad(s, {-half, level(a), -half}, {2 * half * coverage, 0, 0}, {0, 0, 2 * half});  // A
  }
  // Low enough to look two units deep under B, however thin the gap.
  const double distance = 5;
  s.camera.eye = {0.9, std::min(1.6, gap * (1 + (distance - front) / 2)), distance};
  s.camera.target = {0, gap / 2, 0.2};
  s.camera.field_of_view = 34;
  return s;
}

}  // namespace

embedded_scene planes_scene() {
  return {{"planes",
           "half-plane A over slab B over plane C: visibility in closed form",
           {{"dx", "depth between A and B", 0.4, 0.02, 0.6},
            {"dy", "depth between B and C", 0.1, 0.005, 0.3},
            {"coverage", "share of the map's width under A", 0.5, 0, 1},
            {"receiver", "depth of C", 0.95, 0.9, 1},
            animation_parameter("A's edge, half the map and back")}},
          build};
}

}  // namespace bitshade
