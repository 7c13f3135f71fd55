// slope: [LauritzenMcCool08] fig. 4 and 9. A slanted plane crosses every split, half of it in
// shadow.
#include "scene/builder.hpp"
#include "scene/embedded.hpp"

namespace bitshade {
namespace {

constexpr double half = 2;
constexpr double height = 4;
constexpr double plate = 0.02;

scene build(const parameter_values& parameter) {
  // The animation tilts the plane to half its slope and back.
  const double t = parameter["animation"];
  const double tilt = 1 - (t < 0.5 ? t : 1 - t);
  const double middle = (parameter["near"] + parameter["far"]) / 2;
  const double spread = (parameter["far"] - parameter["near"]) / 2 * tilt;
  const auto level = [](double depth) { return (1 - depth) * height; };

  scene s;
  light_from_above(s, half, height, height);
  const double left = level(middle - spread), right = level(middle + spread);
  add_quad(s, {-half, left, -half}, {2 * half, right - left, 0}, {0, 0, 2 * half});
  const double depth = 2 * half * parameter["shadow"];
  if (depth > 0) add_quad(s, {-half, level(plate), -half}, {2 * half, 0, 0}, {0, 0, depth});
  s.camera.eye = {5.4, 3.4, 3.6};
  s.camera.target = {0.1, 1.9, -0.1};
  s.camera.field_of_view = 42;
  return s;
}

}  // namespace

embedded_scene slope_scene() {
  return {{"slope",
           "a slanted plane across every split, half in the shadow of a plate",
           {{"near", "depth of the plane's upper edge", 0.06, 0.03, 0.9},
            {"far", "depth of its lower edge", 1, 0.1, 1},
            {"shadow", "share of the plane under the plate", 0.5, 0, 1},
            animation_parameter("the plane's tilt, to half the slope and back")}},
          build};
}

}  // namespace bitshade
