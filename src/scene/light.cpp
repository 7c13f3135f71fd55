#include "scene/light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "bitshade/shadow/metric.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"
#include "scene/trig.hpp"

namespace bitshade {
namespace {

struct bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  void add(glm::dvec3 p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  glm::dvec3 centre() const { return (low + high) / 2.0; }
};

bounds bounds_of(const scene& s) {
  bounds b;
  for (const auto& v : s.vertices) b.add(glm::dvec3(v));
  return b;
}

/// Right and down across a direction; for a light straight down they are x and z.
void set_axes(light_view& light, glm::dvec3 direction) {
  light.direction = glm::normalize(direction);
  const bool upright = std::abs(light.direction.y) > 0.9999;
  light.right = upright ? glm::dvec3(1, 0, 0)
                        : glm::normalize(glm::cross(light.direction, glm::dvec3(0, 1, 0)));
  light.down = glm::cross(light.direction, light.right);
  if (upright) {  // x is not quite perpendicular to an almost upright direction
    light.down = glm::normalize(light.down);
    light.right = glm::cross(light.down, light.direction);
  }
}

std::string place(glm::dvec3 p) {
  return shortest(p.x) + "," + shortest(p.y) + "," + shortest(p.z);
}

}  // namespace

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names{"linear", "plane", "distance", "projected", "vertex"};
  return names;
}

depth_metric metric_named(const std::string& name) {
  const auto& names = metric_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw usage_error("unknown metric '" + name + "': " +
                      suggest(name, std::vector<std::string_view>(names.begin(), names.end())));
  }
  return static_cast<depth_metric>(found - names.begin());
}

void aim_directional_light(scene& s, glm::dvec3 direction) {
  if (!(glm::dot(direction, direction) > 0)) {
    throw usage_error("--light takes a direction that is not zero, such as -0.4,-1,-0.3");
  }
  light_view light;
  set_axes(light, direction);
  // The window in the light's own axes, around the bounding box's centre.
  const glm::dvec3 centre = bounds_of(s).centre();
  bounds window;
  for (const auto& v : s.vertices) {
    const glm::dvec3 p = glm::dvec3(v) - centre;
    window.add({glm::dot(p, light.right), glm::dot(p, light.down), glm::dot(p, light.direction)});
  }
  const glm::dvec3 size = window.high - window.low;
  // Square texels, and a hair of room so that no vertex lies on the border.
  light.half_width = light.half_height = std::max({size.x, size.y, 1e-6}) / 2 * 1.001;
  // Twice the scene's depth away: everything lies in front, and the range starts well off zero.
  const double distance = size.z - window.low.z;
  const glm::dvec3 middle = window.centre();
  light.position =
      centre + light.right * middle.x + light.down * middle.y - light.direction * distance;
  s.light = light;
  s.fit_range = true;
}

void aim_point_light(scene& s, glm::dvec3 position) {
  const auto inside = [&] {
    return usage_error("the light at " + place(position) +
                       " lies in the scene or too near to see all of it: move it away with "
                       "--light-position, or use --light for a directional one");
  };
  light_view light;
  light.point = true;
  light.position = position;
  const glm::dvec3 direction = bounds_of(s).centre() - position;
  if (!(glm::dot(direction, direction) > 0)) throw inside();
  set_axes(light, direction);
  double half_size = 0;
  for (const auto& v : s.vertices) {
    const glm::dvec3 p = glm::dvec3(v) - position;
    const double z = glm::dot(p, light.direction);
    if (!(z > 0)) throw inside();
    half_size = std::max(
        {half_size, std::abs(glm::dot(p, light.right)) / z, std::abs(glm::dot(p, light.down)) / z});
  }
  if (!(half_size <= tangent_of_degrees(80))) throw inside();
  light.half_width = light.half_height = std::max(half_size, 1e-9) * 1.001;
  s.light = light;
  s.fit_range = true;
}

glm::dvec3 triangle_points::normal() const { return glm::cross(b - a, c - a); }

light_projection::light_projection(const scene& s, depth_metric metric, const std::string& range)
    : light_(s.light), metric_(metric) {
  nearest_ = std::numeric_limits<double>::infinity();
  last_ = -nearest_;
  farthest_ = 0;
  for (const auto& v : s.vertices) {
    const glm::dvec3 p = glm::dvec3(v) - light_.position;
    const double z = glm::dot(p, light_.direction);
    nearest_ = std::min(nearest_, z);
    last_ = std::max(last_, z);
    farthest_ = std::max(farthest_, glm::length(p));
  }
  if (range.empty() && !s.fit_range) {
    near_ = light_.near;
    far_ = light_.far;
  } else if (range.empty() || range == "tight") {
    near_ = nearest_;
    far_ = last_;
  } else {
    const auto numbers = parse_numbers(range, "--light-range", 2, 2);
    near_ = numbers[0];
    far_ = numbers[1];
    farthest_ = far_;
  }
  // A scene that is one plane across the light has no range: any width shows it as depth 0.
  if (!(far_ - near_ > 1e-9 * std::max(std::abs(near_), std::abs(far_)))) {
    far_ = near_ + std::max(1e-6, std::abs(near_) * 1e-3);
  }
  if (!(farthest_ > 0)) farthest_ = 1;
  if (metric_ == depth_metric::projected && light_.point && !(near_ > 0)) {
    throw usage_error("--metric projected needs a near distance above 0, but it is " +
                      shortest(near_) + ": give --light-range");
  }
  if (metric_ == depth_metric::plane && !(far_ > 0)) {
    throw usage_error("--metric plane needs a far distance above 0, but it is " + shortest(far_) +
                      ": give --light-range");
  }
}

light_projection::ray light_projection::ray_through(double u, double v) const {
  const glm::dvec3 across = light_.right * ((2 * u - 1) * light_.half_width) +
                            light_.down * ((2 * v - 1) * light_.half_height);
  if (light_.point) return {light_.position, light_.direction + across};
  return {light_.position + across, light_.direction};
}

glm::dvec3 light_projection::project(glm::dvec3 point) const {
  const glm::dvec3 p = point - light_.position;
  const double z = glm::dot(p, light_.direction);
  const double w = light_.point ? z : 1;
  return {0.5 + 0.5 * glm::dot(p, light_.right) / (w * light_.half_width),
          0.5 + 0.5 * glm::dot(p, light_.down) / (w * light_.half_height), z};
}

glm::dvec2 light_projection::project_step(glm::dvec3 point, glm::dvec3 step) const {
  const glm::dvec3 p = point - light_.position;
  const glm::dvec2 across(glm::dot(p, light_.right), glm::dot(p, light_.down));
  const glm::dvec2 moved(glm::dot(step, light_.right), glm::dot(step, light_.down));
  const glm::dvec2 scale(0.5 / light_.half_width, 0.5 / light_.half_height);
  if (!light_.point) return scale * moved;
  const double z = glm::dot(p, light_.direction);
  return scale * (moved - across * (glm::dot(step, light_.direction) / z)) / z;
}

double light_projection::metric_of(glm::dvec3 point, const triangle_points& t) const {
  const glm::dvec3 p = point - light_.position;
  const double z = glm::dot(p, light_.direction);
  switch (metric_) {
    case depth_metric::plane:
      return z / far_;
    case depth_metric::distance:
      return glm::length(p) / farthest_;
    case depth_metric::projected:
      if (light_.point) return far_ * (z - near_) / (z * (far_ - near_));
      break;
    case depth_metric::vertex: {
      // Barycentric coordinates of a point in the triangle's plane.
      const glm::dvec3 n = t.normal();
      const double area = glm::dot(n, n);
      const double wb = glm::dot(glm::cross(point - t.a, t.c - t.a), n) / area;
      const double wc = glm::dot(glm::cross(t.b - t.a, point - t.a), n) / area;
      const double da = glm::length(t.a - light_.position), db = glm::length(t.b - light_.position);
      const double dc = glm::length(t.c - light_.position);
      return (da + wb * (db - da) + wc * (dc - da)) / farthest_;
    }
    case depth_metric::linear:
      break;
  }
  return linear_metric(z, near_, far_);
}

namespace {

/// Where a ray meets the triangle's plane, in units of the ray's direction; z is kept within the
/// triangle's own where `clamp` is set (`start`: the z at which the ray starts).
double meet(const triangle_points& t, const light_projection::ray& ray) {
  const glm::dvec3 n = t.normal();
  return glm::dot(n, t.a - ray.origin) / glm::dot(n, ray.direction);
}

}  // namespace

double light_projection::unclamped(const triangle_points& t, double u, double v) const {
  const ray r = ray_through(u, v);
  return metric_of(r.origin + r.direction * meet(t, r), t);
}

double light_projection::depth_at(const triangle_points& t, double u, double v) const {
  const ray r = ray_through(u, v);
  // Both kinds of ray start at z = 0 and gain 1 a step, so that the step is z.
  const auto z_of = [&](glm::dvec3 p) { return glm::dot(p - light_.position, light_.direction); };
  const double za = z_of(t.a), zb = z_of(t.b), zc = z_of(t.c);
  double z = meet(t, r);
  if (!std::isfinite(z)) z = za;
  z = std::clamp(z, std::min({za, zb, zc}), std::max({za, zb, zc}));
  return std::clamp(metric_of(r.origin + r.direction * z, t), 0.0, 1.0);
}

glm::dvec2 light_projection::slope_at(const triangle_points& t, double u, double v) const {
  // Central differences in binary64: exact for planar metrics, where depth is linear in (u, v) or a
  // ratio of such; the step balances truncation (h^2) against rounding (2^-52 / h).
  constexpr double h = 0x1p-14;
  return {(unclamped(t, u + h, v) - unclamped(t, u - h, v)) / (2 * h),
          (unclamped(t, u, v + h) - unclamped(t, u, v - h)) / (2 * h)};
}

glm::dvec3 light_projection::towards_light(glm::dvec3 point) const {
  return light_.point ? glm::normalize(light_.position - point) : -light_.direction;
}

}  // namespace bitshade
