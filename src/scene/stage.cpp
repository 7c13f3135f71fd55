// What makes a scene of a bare mesh: numbered surfaces, a ground, a light and a camera.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/numbers.hpp"
#include "scene/builder.hpp"
#include "scene/light.hpp"
#include "scene/mesh.hpp"

namespace bitshade {
namespace {

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending;
}

/// Numbers the facets: neighbours across an edge that lie in one plane are one surface.
void number_surfaces(scene& s) {
  const std::size_t count = s.triangles.size();
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  const auto corner = [&](std::uint32_t t, int k) {
    return glm::dvec3(s.vertices[s.triangles[t][k]]);
  };
  const auto coplanar = [&](std::uint32_t one, std::uint32_t other) {
    const glm::dvec3 a = corner(one, 0);
    const glm::dvec3 n = glm::cross(corner(one, 1) - a, corner(one, 2) - a);
    const double area = glm::length(n);
    if (!(area > 0)) return false;
    const double size = std::sqrt(area);
    for (int k = 0; k < 3; ++k) {
      if (std::abs(glm::dot(n, corner(other, k) - a)) > 1e-6 * area * size) return false;
    }
    return true;
  };
  std::unordered_map<std::uint64_t, std::uint32_t> edges;  // from an edge to a triangle that has it
  edges.reserve(count * 2);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
      const auto [found, fresh] = edges.emplace(std::min(a, b) << 32 | std::max(a, b), t);
      if (!fresh && coplanar(found->second, t)) parent[root(t)] = root(found->second);
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  s.surfaces.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    s.surfaces[t] =
        numbers.emplace(root(t), static_cast<std::uint32_t>(numbers.size()) + 1).first->second;
  }
}

/// A ground under the mesh, wide enough for the shadow of the default light, and a camera that sees
/// both.
void stage(scene& s, bool with_ground) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const auto& v : s.vertices) {
    low = glm::min(low, glm::dvec3(v));
    high = glm::max(high, glm::dvec3(v));
  }
  const glm::dvec3 centre = (low + high) / 2.0, size = high - low;
  const double extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0))
    throw failure("cannot use " + s.name + ": all its vertices are one point; mend the mesh");
  const glm::dvec3 light(0.45, -1, -0.35);
  if (with_ground) {
    // A disc, since a square's corners would waste map and range; it follows the shadow.
    const double radius = 0.6 * std::sqrt(size.x * size.x + size.z * size.z) + 0.5 * size.y;
    add_disc(s, {centre.x + 0.4 * light.x * size.y, low.y, centre.z + 0.4 * light.z * size.y},
             radius, 64);
  }
  aim_directional_light(s, light);
  const double away = 0.5 * glm::length(size) * 3.4;
  s.camera.target = centre - glm::dvec3(0, 0.12 * size.y, 0);
  s.camera.eye = s.camera.target + glm::normalize(glm::dvec3(0.55, 0.6, 1)) * away;
  s.camera.field_of_view = 36;
}

bool ground_wanted(const scene_options& options) {
  bool ground = true;
  for (const auto& [name, text] : options.parameters) {
    if (name != "ground") {
      throw usage_error("a mesh has no parameter '" + name + "': known is ground (0 or 1)");
    }
    const double value = parse_numbers(text, "--param ground", 1, 1)[0];
    if (value != 0 && value != 1) throw usage_error("--param ground takes 0 or 1, but not " + text);
    ground = value == 1;
  }
  return ground;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".obj" || ending == ".glb";
}

scene load_mesh(const std::filesystem::path& file, const scene_options& options) {
  const bool ground = ground_wanted(options);
  scene out = decode_mesh(read_file(file), file.string(), lower_ending(file).substr(1));
  number_surfaces(out);
  stage(out, ground);
  out.name = file.stem().string();
  return out;
}

}  // namespace bitshade
