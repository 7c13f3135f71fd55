#include "scene/builder.hpp"

#include "scene/trig.hpp"

namespace bitshade {
namespace {

std::uint32_t new_surface(const scene& s) { return s.surfaces.empty() ? 1 : s.surfaces.back() + 1; }

std::uint32_t add_vertex(scene& s, glm::dvec3 p) {
  s.vertices.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y),
                          static_cast<float>(p.z));
  return static_cast<std::uint32_t>(s.vertices.size() - 1);
}

void add_face(scene& s, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const std::uint32_t surface = new_surface(s);
  s.triangles.emplace_back(a, b, c);
  s.triangles.emplace_back(a, c, d);
  s.surfaces.insert(s.surfaces.end(), 2, surface);
}

/// The corners of a level regular polygon.
std::vector<std::uint32_t> ring(scene& s, glm::dvec3 centre, double radius, int sides) {
  std::vector<std::uint32_t> corners;
  for (int i = 0; i < sides; ++i) {
    const turn angle(static_cast<double>(i) / sides);
    corners.push_back(
        add_vertex(s, centre + glm::dvec3(radius * angle.cosine, 0, radius * angle.sine)));
  }
  return corners;
}

/// A convex polygon in one plane: one surface.
void add_fan(scene& s, const std::vector<std::uint32_t>& corners) {
  const std::uint32_t surface = new_surface(s);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    s.triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
    s.surfaces.push_back(surface);
  }
}

}  // namespace

void add_quad(scene& s, glm::dvec3 origin, glm::dvec3 a, glm::dvec3 b) {
  const auto p = add_vertex(s, origin), q = add_vertex(s, origin + a);
  const auto r = add_vertex(s, origin + a + b), t = add_vertex(s, origin + b);
  add_face(s, p, q, r, t);
}

void add_box(scene& s, const box_shape& box) {
  std::uint32_t corner[8];
  for (int i = 0; i < 8; ++i) {
    corner[i] = add_vertex(s, box.centre + (i & 1 ? box.x : -box.x) + (i & 2 ? box.y : -box.y) +
                                  (i & 4 ? box.z : -box.z));
  }
  constexpr int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& f : faces) add_face(s, corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]);
}

void add_block(scene& s, double x0, double x1, double z0, double z1, double bottom, double top) {
  const double x[] = {x0, x1, x1, x0}, z[] = {z0, z0, z1, z1};
  std::uint32_t low[4], high[4];
  for (int i = 0; i < 4; ++i) {
    low[i] = add_vertex(s, {x[i], bottom, z[i]});
    high[i] = add_vertex(s, {x[i], top, z[i]});
  }
  for (int i = 0; i < 4; ++i) add_face(s, low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
  add_face(s, high[0], high[1], high[2], high[3]);
}

void add_prism(scene& s, glm::dvec3 centre, double radius, double bottom, double top, int sides) {
  const auto low = ring(s, {centre.x, bottom, centre.z}, radius, sides);
  const auto high = ring(s, {centre.x, top, centre.z}, radius, sides);
  const auto count = static_cast<std::size_t>(sides);
  for (std::size_t i = 0; i < count; ++i) {
    add_face(s, low[i], low[(i + 1) % count], high[(i + 1) % count], high[i]);
  }
  add_fan(s, high);
}

void add_disc(scene& s, glm::dvec3 centre, double radius, int sides) {
  add_fan(s, ring(s, centre, radius, sides));
}

void light_from_above(scene& s, double half, double top, double range) {
  s.light = light_view{};  // straight down, u along x and v along z
  s.light.position = {0, top, 0};
  s.light.half_width = s.light.half_height = half;
  s.light.near = 0;
  s.light.far = range;
  s.fit_range = false;
}

}  // namespace bitshade
