// From a scene to a frame: the light's depth map and the camera's receivers.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/error.hpp"
#include "scene/light.hpp"
#include "scene/limits.hpp"
#include "scene/rays.hpp"
#include "scene/trig.hpp"

namespace bitshade {
namespace {

/// Everything that a ray needs, shared by all rows.
struct view {
  const scene& world;
  light_projection light;
  ray_caster rays;

  triangle_points triangle(std::uint32_t index) const {
    const auto& t = world.triangles[index];
    return {glm::dvec3(world.vertices[t.x]), glm::dvec3(world.vertices[t.y]),
            glm::dvec3(world.vertices[t.z])};
  }
};

template <class Row>
void for_rows(int rows, int threads, const Row& row) {
  oneapi::tbb::task_arena arena(threads > 0 ? threads : oneapi::tbb::task_arena::automatic);
  arena.execute([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, rows), [&](const auto& range) {
      for (int y = range.begin(); y != range.end(); ++y) row(y);
    });
  });
}

/// The map through one place of every texel; 1 and 0 stay where nothing is hit.
void draw_map(const view& v, sample_position at, image<float>& depth, image<std::uint32_t>& surface,
              int threads) {
  const int size = depth.width;
  // Rays start a little in front of the nearest vertex: binary32 rays resolve less, the farther
  // off.
  for_rows(size, threads, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const double s = (x + 0.5 + at.x / 16.0) / size, t = (y + 0.5 + at.y / 16.0) / size;
      const auto ray = v.light.ray_through(s, t);
      const double start = v.light.nearest() - 1e-3 * std::abs(v.light.nearest());
      const auto hit = v.rays.first_hit(ray.origin + ray.direction * start, ray.direction);
      if (!hit) continue;
      depth.at(x, y) = static_cast<float>(v.light.depth_at(v.triangle(*hit), s, t));
      surface.at(x, y) = v.world.surfaces[*hit];
    }
  });
}

struct camera_frame {
  glm::dvec3 eye, forward, right, down;  // right and down: from the picture's centre to its edges

  camera_frame(const camera_view& camera, int width, int height) : eye(camera.eye) {
    forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 up = std::abs(forward.y) > 0.9999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const double reach = tangent_of_degrees(camera.field_of_view / 2);
    const glm::dvec3 side = glm::normalize(glm::cross(forward, up));
    right = side * (reach * width / height);
    down = glm::cross(forward, side) * reach;
  }
};

/// Where (u, v) lie: the nearest multiples of 2^-24.
float on_grid(double value) { return static_cast<float>(std::nearbyint(value * 0x1p24) * 0x1p-24); }

/// A finite binary32, whatever the slope.
float finite(double value) {
  constexpr double most = 1e30;
  return static_cast<float>(value == value ? std::clamp(value, -most, most) : 0.0);
}

receiver look(const view& v, const camera_frame& camera, double x, double y, int width,
              int height) {
  receiver out;
  const glm::dvec3 step_x = camera.right * (2.0 / width), step_y = camera.down * (2.0 / height);
  const glm::dvec3 direction =
      camera.forward + camera.right * (2 * x / width - 1) + camera.down * (2 * y / height - 1);
  const auto hit = v.rays.first_hit(camera.eye, direction);
  if (!hit) return out;

  const triangle_points triangle = v.triangle(*hit);
  const glm::dvec3 normal = triangle.normal();
  const double towards = glm::dot(normal, direction);
  const double distance = glm::dot(normal, triangle.a - camera.eye) / towards;
  const glm::dvec3 point = camera.eye + direction * distance;
  out.diffuse = 0;
  if (!std::isfinite(distance)) return out;

  // The side that the camera sees must face the light: a plane along its rays has no slope.
  const double cosine =
      glm::dot(normal, v.light.towards_light(point)) / glm::length(normal) * (towards < 0 ? 1 : -1);
  if (!(cosine >= 0x1p-10)) return out;
  const glm::dvec3 seen = v.light.project(point);
  if (!(seen.x >= 0 && seen.x <= 1 && seen.y >= 0 && seen.y <= 1)) {
    out.diffuse = static_cast<float>(cosine);
    return out;
  }

  out.u = on_grid(seen.x);
  out.v = on_grid(seen.y);
  out.t = static_cast<float>(v.light.depth_at(triangle, out.u, out.v));
  const glm::dvec2 slope = v.light.slope_at(triangle, out.u, out.v);
  out.dt_du = finite(slope.x);
  out.dt_dv = finite(slope.y);
  // Ray differentials on the tangent plane ([Igehy99]).
  const auto differential = [&](glm::dvec3 step) {
    const glm::dvec3 moved = distance * (step - direction * (glm::dot(normal, step) / towards));
    return v.light.project_step(point, moved);
  };
  const glm::dvec2 along_x = differential(step_x), along_y = differential(step_y);
  out.du_dx = finite(along_x.x);
  out.dv_dx = finite(along_x.y);
  out.du_dy = finite(along_y.x);
  out.dv_dy = finite(along_y.y);
  out.surface = v.world.surfaces[*hit];
  out.diffuse = static_cast<float>(cosine);
  return out;
}

}  // namespace

frame build_frame(const scene& world, const scene_options& options) {
  check_sizes(options, world.triangles.size());
  const view v{world, light_projection(world, options.metric, options.light_range),
               ray_caster(world)};
  frame out;
  out.name = world.name;
  out.depth = image<float>(options.map_size, options.map_size, 1, 1.0f);
  out.surface = image<std::uint32_t>(options.map_size, options.map_size);
  draw_map(v, {}, out.depth, out.surface, options.threads);
  for (const int samples : options.samples) {
    for (const sample_position at : sample_pattern(samples)) {
      map_sample& s = out.samples[samples].emplace_back(
          map_sample{image<float>(options.map_size, options.map_size, 1, 1.0f),
                     image<std::uint32_t>(options.map_size, options.map_size), at});
      draw_map(v, at, s.depth, s.surface, options.threads);
    }
  }

  out.view_width = options.view_width;
  out.view_height = options.view_height;
  out.receivers.resize(static_cast<std::size_t>(out.view_width) *
                       static_cast<std::size_t>(out.view_height));
  const camera_frame camera(options.camera.value_or(world.camera), out.view_width, out.view_height);
  for_rows(out.view_height, options.threads, [&](int y) {
    for (int x = 0; x < out.view_width; ++x) {
      out.receivers[static_cast<std::size_t>(y) * static_cast<std::size_t>(out.view_width) +
                    static_cast<std::size_t>(x)] =
          look(v, camera, x + 0.5, y + 0.5, out.view_width, out.view_height);
    }
  });
  return out;
}

}  // namespace bitshade
