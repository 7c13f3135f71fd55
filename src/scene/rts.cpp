// rts: the setting of [Marinescu11], a battlefield: terrain, buildings, and debris in the air.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scene/builder.hpp"
#include "scene/embedded.hpp"
#include "scene/random.hpp"

namespace bitshade {
namespace {

constexpr double half = 8;
constexpr double height = 16;
constexpr int cells = 96;  // of the height field, along each side

double level(double depth) { return (1 - depth) * height; }

/// Value noise with a smooth step, in [0,1].
double noise(double x, double z, std::uint64_t seed) {
  const auto lattice = [&](int i, int j) {
    return random_stream(seed, static_cast<std::uint64_t>(i + 4096) * 65536 +
                                   static_cast<std::uint64_t>(j + 4096))
        .next();
  };
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(z));
  const auto smooth = [](double f) { return f * f * (3 - 2 * f); };
  const double fx = smooth(x - i), fz = smooth(z - j);
  const double low = lattice(i, j) + (lattice(i + 1, j) - lattice(i, j)) * fx;
  const double high = lattice(i, j + 1) + (lattice(i + 1, j + 1) - lattice(i, j + 1)) * fx;
  return low + (high - low) * fz;
}

/// Depth of the terrain, from 0.85 (hills) to 1.
double terrain(double x, double z, std::uint64_t seed) {
  const double n = (noise(x / 4, z / 4, seed) * 4 + noise(x / 1.6, z / 1.6, seed + 1)) / 5;
  return std::clamp(1 - 0.15 * n, 0.85, 1.0);
}

void add_terrain(scene& s, std::uint64_t seed) {
  const auto first = static_cast<std::uint32_t>(s.vertices.size());
  const double step = 2 * half / cells;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = -half + i * step, z = -half + j * step;
      s.vertices.emplace_back(static_cast<float>(x), static_cast<float>(level(terrain(x, z, seed))),
                              static_cast<float>(z));
    }
  }
  std::uint32_t surface = s.surfaces.empty() ? 0 : s.surfaces.back();
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = first + j * (cells + 1) + i, b = a + cells + 1;
      s.triangles.emplace_back(a, a + 1, b + 1);
      s.triangles.emplace_back(a, b + 1, b);
      s.surfaces.push_back(++surface);  // the two halves of a cell are two planes
      s.surfaces.push_back(++surface);
    }
  }
}

void add_houses(scene& s, const parameter_values& parameter) {
  for (int k = 0; k < parameter.count("boxes"); ++k) {
    random_stream random(parameter.seed(), 1000000 + static_cast<std::uint64_t>(k));
    const double w = random.next(0.12, 0.4), d = random.next(0.12, 0.4);
    const double x = random.next(-half + w, half - w), z = random.next(-half + d, half - d);
    // Sunk into the slope, and below the split at 0.8 between ground and debris.
    const double foot = level(terrain(x, z, parameter.seed()));
    const double roof = std::min(foot + random.next(0.25, 0.9), level(0.81));
    add_block(s, x - w, x + w, z - d, z + d, foot - 0.6, std::max(roof, foot + 0.05));
  }
}

void add_shards(scene& s, const parameter_values& parameter) {
  for (int k = 0; k < parameter.count("shards"); ++k) {
    random_stream random(parameter.seed(), 2000000 + static_cast<std::uint64_t>(k));
    const auto direction = [&] {
      glm::dvec3 v;
      do {
        v = {random.next(-1, 1), random.next(-1, 1), random.next(-1, 1)};
      } while (glm::dot(v, v) > 1 || glm::dot(v, v) < 0.01);
      return glm::normalize(v);
    };
    const glm::dvec3 along = direction();
    const glm::dvec3 across = glm::normalize(glm::cross(along, direction()));
    const double length = random.next(0.2, 0.55), width = random.next(0.08, 0.3);
    // They fall from wherever they are to the lowest depth and begin again at the top.
    const double fallen = random.next() + parameter["animation"];
    const double reach = (length + width) / height;
    const double depth = 0.1 + reach + (0.6 - 2 * reach) * (fallen - std::floor(fallen));
    const glm::dvec3 at(random.next(-half, half), level(depth), random.next(-half, half));
    add_quad(s, at - along * (length / 2) - across * (width / 2), along * length, across * width);
  }
}

scene build(const parameter_values& parameter) {
  scene s;
  light_from_above(s, half, height, height);
  add_terrain(s, parameter.seed());
  add_houses(s, parameter);
  add_shards(s, parameter);
  s.camera.eye = {3.4, 6.2, 9.2};
  s.camera.target = {0, 0.6, 0.6};
  s.camera.field_of_view = 38;
  return s;
}

}  // namespace

embedded_scene rts_scene() {
  return {{"rts",
           "terrain, buildings and debris in the air, as in a strategy game",
           {{"boxes", "buildings", 200, 0, 5000, true},
            {"shards", "pieces of debris", 300, 0, 20000, true},
            animation_parameter("the debris' fall")}},
          build};
}

}  // namespace bitshade
