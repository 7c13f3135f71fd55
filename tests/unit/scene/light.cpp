// Metrics against their formulas, and receivers against the map that they look up.
#include "scene/light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/error.hpp"
#include "scene/builder.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// A ground of 4 x 4 at y = 0 and a roof over its middle at y = 1.
scene room() {
  scene s;
  add_quad(s, {-2, 0, -2}, {4, 0, 0}, {0, 0, 4});
  add_quad(s, {-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1});
  return s;
}

triangle_points first_triangle(const scene& s) {
  const auto& t = s.triangles[0];
  return {glm::dvec3(s.vertices[t.x]), glm::dvec3(s.vertices[t.y]), glm::dvec3(s.vertices[t.z])};
}

}  // namespace

TEST_CASE("each metric is its formula on a point light's floor") {
  scene s = room();
  aim_point_light(s, {0.5, 8, 0.25});
  const triangle_points floor = first_triangle(s);
  const glm::dvec3 eye = s.light.position, direction = s.light.direction;
  double near = 1e9, far = 0, farthest = 0;
  for (const auto& v : s.vertices) {
    const glm::dvec3 p = glm::dvec3(v) - eye;
    near = std::min(near, glm::dot(p, direction));
    far = std::max(far, glm::dot(p, direction));
    farthest = std::max(farthest, glm::length(p));
  }
  for (const double u : {0.3, 0.5, 0.62}) {
    for (const double v : {0.35, 0.5, 0.7}) {
      const auto depth = [&](depth_metric metric) {
        return light_projection(s, metric, "").depth_at(floor, u, v);
      };
      const auto ray = light_projection(s, depth_metric::linear, "").ray_through(u, v);
      const double z = -ray.origin.y / ray.direction.y;  // down to y = 0
      const glm::dvec3 point = ray.origin + ray.direction * z;
      INFO("u " << u << " v " << v);
      CHECK(depth(depth_metric::linear) == Approx((z - near) / (far - near)).epsilon(1e-12));
      CHECK(depth(depth_metric::plane) == Approx(z / far).epsilon(1e-12));
      CHECK(depth(depth_metric::distance) ==
            Approx(glm::length(point - eye) / farthest).epsilon(1e-12));
      CHECK(depth(depth_metric::projected) ==
            Approx(far * (z - near) / (z * (far - near))).epsilon(1e-12));
      // A distance interpolated between corners is the larger one: |p - L| is convex.
      CHECK(depth(depth_metric::vertex) > depth(depth_metric::distance) + 1e-3);
    }
  }
}

TEST_CASE("interpolation from the vertices is exact at a vertex") {
  scene s = room();
  aim_point_light(s, {0.5, 8, 0.25});
  const triangle_points floor = first_triangle(s);
  const light_projection vertex(s, depth_metric::vertex, ""),
      distance(s, depth_metric::distance, "");
  for (const auto& corner : {floor.a, floor.b, floor.c}) {
    const glm::dvec3 seen = vertex.project(corner);
    CHECK(vertex.depth_at(floor, seen.x, seen.y) ==
          Approx(distance.depth_at(floor, seen.x, seen.y)).epsilon(1e-12));
  }
}

TEST_CASE("a given range sets depths 0 and 1, and what lies beyond is clamped") {
  scene s = room();
  light_from_above(s, 2, 2, 2);
  const triangle_points floor = first_triangle(s);
  const auto depth = [&](const std::string& range) {
    return light_projection(s, depth_metric::linear, range).depth_at(floor, 0.5, 0.5);
  };
  CHECK(depth("") == 1);
  CHECK(depth("0,4") == 0.5);
  CHECK(depth("3,5") == 0);
  CHECK(depth("0,1") == 1);
  CHECK(depth("tight") == 1);  // from the roof at z = 1 to the floor at z = 2
  CHECK(light_projection(s, depth_metric::linear, "tight").near() == 1);
}

TEST_CASE("a point comes back from the map's coordinates") {
  scene s = room();
  for (const bool point : {false, true}) {
    if (point) {
      aim_point_light(s, {3, 7, -1});
    } else {
      aim_directional_light(s, {0.3, -1, 0.6});
    }
    const light_projection light(s, depth_metric::linear, "");
    for (const glm::dvec3 p : {glm::dvec3(0.3, 0, 0.7), glm::dvec3(-1.5, 1, 1.2), glm::dvec3(0)}) {
      const glm::dvec3 seen = light.project(p);
      const auto ray = light.ray_through(seen.x, seen.y);
      CHECK(glm::length(ray.origin + ray.direction * seen.z - p) < 1e-12);
      const glm::dvec3 step(1e-6, 2e-6, -1e-6);
      const glm::dvec3 moved = light.project(p + step) - seen;
      const glm::dvec2 predicted = light.project_step(p, step);
      CHECK(moved.x == Approx(predicted.x).margin(1e-11));
      CHECK(moved.y == Approx(predicted.y).margin(1e-11));
    }
  }
}

TEST_CASE("a lit receiver's depth is the map's, continued along its tangent plane") {
  for (const auto metric : {depth_metric::linear, depth_metric::plane, depth_metric::distance,
                            depth_metric::projected, depth_metric::vertex}) {
    for (const bool point : {false, true}) {
      scene s = room();
      if (point) {
        aim_point_light(s, {1, 9, -1});
      } else {
        aim_directional_light(s, {0.3, -1, 0.2});
      }
      s.camera.eye = {2, 4, 5};
      scene_options o;
      o.map_size = 200;
      o.view_width = 120;
      o.view_height = 80;
      o.metric = metric;
      const frame f = build_frame(s, o);
      INFO("metric " << metric_names()[static_cast<std::size_t>(metric)]
                     << (point ? ", point" : ", sun"));
      std::size_t compared = 0;
      double worst = 0;
      for (const receiver& r : f.receivers) {
        if (r.surface == 0) continue;
        const int x = std::min(199, static_cast<int>(r.u * 200)),
                  y = std::min(199, static_cast<int>(r.v * 200));
        if (f.surface.at(x, y) != r.surface) continue;
        const double du = (x + 0.5) / 200 - static_cast<double>(r.u),
                     dv = (y + 0.5) / 200 - static_cast<double>(r.v);
        const double continued = static_cast<double>(r.t) + static_cast<double>(r.dt_du) * du +
                                 static_cast<double>(r.dt_dv) * dv;
        worst = std::max(worst, std::abs(continued - static_cast<double>(f.depth.at(x, y))));
        ++compared;
      }
      CHECK(compared > 1000);
      // What a tangent plane leaves out half a texel away: h^2 (f_uu + 2 f_uv + f_vv) / 2 with
      // h = 1/400. The strongest curvature is that of |p - L| / far, at most window^2 / (|p - L|
      // far) < 2 in each term here. The vertex metric bends at the diagonal, where slopes jump.
      CHECK(worst < (metric == depth_metric::vertex ? 2e-3 : 4 * 2.0 / 2 / 400 / 400));
    }
  }
}

TEST_CASE("screen derivatives are the differences between neighbouring pixels") {
  scene s = room();
  aim_point_light(s, {1, 9, -1});
  s.camera.eye = {2, 4, 5};
  scene_options o;
  o.map_size = 16;
  o.view_width = 300;
  o.view_height = 200;
  const frame f = build_frame(s, o);
  std::size_t compared = 0;
  for (int y = 1; y + 1 < 200; ++y) {
    for (int x = 1; x + 1 < 300; ++x) {
      const auto at = [&](int i, int j) -> const receiver& {
        return f.receivers[static_cast<std::size_t>(j * 300 + i)];
      };
      const receiver &r = at(x, y), &left = at(x - 1, y), &right = at(x + 1, y);
      const receiver &up = at(x, y - 1), &down = at(x, y + 1);
      if (r.surface == 0 || left.surface != r.surface || right.surface != r.surface ||
          up.surface != r.surface || down.surface != r.surface) {
        continue;
      }
      ++compared;
      // Central differences are right to second order; 2^-24 is the coordinates' grid.
      const double scale = 0.01 * std::max(std::abs(r.du_dx), std::abs(r.dv_dx)) + 0x1p-23;
      CHECK(std::abs((right.u - left.u) / 2 - r.du_dx) < scale);
      CHECK(std::abs((right.v - left.v) / 2 - r.dv_dx) < scale);
      const double other = 0.02 * std::max(std::abs(r.du_dy), std::abs(r.dv_dy)) + 0x1p-23;
      CHECK(std::abs((down.u - up.u) / 2 - r.du_dy) < other);
      CHECK(std::abs((down.v - up.v) / 2 - r.dv_dy) < other);
    }
  }
  CHECK(compared > 10000);
}

TEST_CASE("lights that see nothing or stand inside are refused") {
  scene s = room();
  CHECK_THROWS_AS(aim_directional_light(s, {0, 0, 0}), usage_error);
  CHECK_THROWS_AS(aim_point_light(s, {0, 0.5, 0}), usage_error);
  CHECK_THROWS_AS(aim_point_light(s, {0, 0.01, 0}), usage_error);
}
