// city: a size test, from a thousand to ten million triangles.
#include <algorithm>
#include <cmath>

#include "scene/builder.hpp"
#include "scene/embedded.hpp"
#include "scene/light.hpp"
#include "scene/random.hpp"
#include "scene/trig.hpp"

namespace bitshade {
namespace {

constexpr double half = 10;

scene build(const parameter_values& parameter) {
  scene s;
  // Ten triangles a building, two the ground; a square of lots, the last ones left empty.
  const auto buildings = static_cast<std::int64_t>((parameter["triangles"] - 2) / 10);
  const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(buildings))));
  s.triangles.reserve(static_cast<std::size_t>(buildings) * 10 + 2);
  s.surfaces.reserve(static_cast<std::size_t>(buildings) * 10 + 2);
  s.vertices.reserve(static_cast<std::size_t>(buildings) * 8 + 4);
  add_quad(s, {-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});
  const double lot = 2 * half / static_cast<double>(side);
  for (std::int64_t k = 0; k < buildings; ++k) {
    random_stream random(parameter.seed(), static_cast<std::uint64_t>(k));
    const double x = -half + lot * (static_cast<double>(k % side) + 0.5);
    const double z = -half + lot * (static_cast<double>(k / side) + 0.5);
    const double w = lot * random.next(0.2, 0.38), d = lot * random.next(0.2, 0.38);
    // Higher towards the middle, and never flatter than it is wide.
    const double centre = std::max(0.0, 1 - (x * x + z * z) / (half * half));
    const double r = random.next();
    const double tall = lot * (0.35 + 2.2 * r * r * (0.25 + centre * centre));
    add_block(s, x - w, x + w, z - d, z + d, 0, tall);
  }
  // The sun goes from morning to afternoon.
  const turn hour(0.18 + 0.14 * parameter["animation"]);
  aim_directional_light(s, {-hour.cosine, -hour.sine, -0.45});
  // As if from a roof: the picture shows as much of a small city as of a large one.
  const double zoom = std::max(4 * lot, std::min(half, 12 * lot));
  s.camera.eye = glm::dvec3(0.9, 0.75, 1.25) * zoom;
  s.camera.target = {0, 0, 0};
  s.camera.field_of_view = 38;
  return s;
}

}  // namespace

embedded_scene city_scene() {
  return {{"city",
           "blocks of houses under a slanted sun: a size test",
           {{"triangles", "triangles, ten a house", 20000, 1000, 1e7, true},
            animation_parameter("the sun, from morning to afternoon")}},
          build};
}

}  // namespace bitshade
