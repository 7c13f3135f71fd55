// garden: [LauritzenMcCool08] fig. 3 and 5. A tree's shadow falls over a bench's: light bleeds
// under the bench, and one split between bench and ground cures it.
#include <algorithm>

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/builder.hpp"
#include "scene/embedded.hpp"
#include "scene/random.hpp"
#include "scene/trig.hpp"

namespace bitshade {
namespace {

constexpr double half = 3;    // of the window
constexpr double height = 8;  // world units of depth 1: a tree of six metres
constexpr double ground = 0.95, bench = 0.93, crown_top = 0.2, crown_bottom = 0.6;

double level(double depth) { return (ground - depth) * height; }

void add_bench(scene& s, glm::dvec3 at, int slats, double gap) {
  const double length = 1.5, width = 0.4, thickness = 0.025;
  const double top = level(bench);
  const double slat = (width - gap * (slats - 1)) / slats;
  for (int i = 0; i < slats; ++i) {
    const double z = at.z - width / 2 + slat / 2 + i * (slat + gap);
    add_box(s, {{at.x, top - thickness / 2, z},
                {length / 2, 0, 0},
                {0, thickness / 2, 0},
                {0, 0, slat / 2}});
  }
  // Posts under the outer slats alone, so that none shows through a gap between bench and ground.
  const double foot = std::min(0.06, slat) / 2, edge = width / 2 - slat / 2;
  for (const double x : {-0.62, 0.62}) {
    for (const double z : {-edge, edge}) {
      add_block(s, at.x + x - foot, at.x + x + foot, at.z + z - foot, at.z + z + foot, 0,
                top - thickness / 2);
    }
  }
}

void add_crown(scene& s, glm::dvec3 centre, double radius, const parameter_values& parameter) {
  const double half_height = (crown_bottom - crown_top) / 2 * height;
  const double size = parameter["leaf"];
  for (int i = 0; i < parameter.count("leaves"); ++i) {
    random_stream random(parameter.seed(), static_cast<std::uint64_t>(i));
    glm::dvec3 p;
    do {
      p = {random.next(-1, 1), random.next(-1, 1), random.next(-1, 1)};
    } while (glm::dot(p, p) > 1);
    // A card tilted by up to 45 degrees, pointing anywhere.
    glm::dvec3 along;
    do {
      along = {random.next(-1, 1), 0, random.next(-1, 1)};
    } while (glm::dot(along, along) > 1 || glm::dot(along, along) < 0.01);
    along = glm::normalize(along + glm::dvec3(0, random.next(-0.5, 0.5), 0));
    const glm::dvec3 across = glm::normalize(glm::cross(
        along, glm::normalize(glm::dvec3(random.next(-0.7, 0.7), 1, random.next(-0.7, 0.7)))));
    const double length = size * random.next(0.8, 1.2), width = 0.6 * length;
    // The tips stay within the crown's depths.
    const double reach = 0.5 * (std::abs(along.y) * length + std::abs(across.y) * width);
    const glm::dvec3 place =
        centre + glm::dvec3(p.x * radius, p.y * (half_height - reach), p.z * radius);
    add_quad(s, place - along * (length / 2) - across * (width / 2), along * length,
             across * width);
  }
}

scene build(const parameter_values& parameter) {
  scene s;
  light_from_above(s, half, ground * height, height);
  add_quad(s, {-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});
  add_bench(s, {0, 0, 1.15}, parameter.count("slats"), parameter["gap"]);
  // In the wind the crown swings a little over the bench and back.
  const double sway = 0.25 * turn(parameter["animation"]).sine;
  const double crown = level((crown_top + crown_bottom) / 2);
  add_prism(s, {-0.35, 0, -0.35}, 0.11, 0, crown, 16);
  add_crown(s, {-0.35 + sway, crown, -0.35}, parameter["crown"], parameter);
  s.camera.eye = {1.35, 0.72, 3.6};
  s.camera.target = {-0.05, 0.1, 0.95};
  s.camera.field_of_view = 30;
  return s;
}

}  // namespace

embedded_scene garden_scene() {
  return {{"garden",
           "a tree over a bench: light bleeds under the bench",
           {{"slats", "slats of the bench", 3, 1, 20, true},
            {"gap", "space between two slats", 0.02, 0, 0.1},
            {"leaves", "leaf cards of the crown", 3000, 0, 200000, true},
            {"leaf", "length of a leaf", 0.09, 0.01, 0.5},
            {"crown", "radius of the crown", 1.35, 0.5, 2.5},
            animation_parameter("the crown's swing in the wind")}},
          build};
}

}  // namespace bitshade
