// How a light sees points: its window, its metrics, and their derivatives on a plane.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/scene.hpp"

namespace bitshade {

/// Aims a directional light at the whole scene: a window that fits every vertex, the place of
/// [Marinescu11] (the centre of the bounding box less direction times distance), a fitted range.
///
/// Failure  usage_error if the direction is zero.
void aim_directional_light(scene& scene, glm::dvec3 direction);

/// Puts a point light at `position` that looks at the scene's centre and sees every vertex.
///
/// Failure  usage_error if that takes a view wider than 160 degrees (the light is in the scene).
void aim_point_light(scene& scene, glm::dvec3 position);

/// A triangle's corners in binary64.
struct triangle_points {
  glm::dvec3 a, b, c;
  glm::dvec3 normal() const;  ///< not normalised; zero for a degenerate triangle
};

/// What a light stores of a scene: where points fall in its map, and their depths.
class light_projection {
 public:
  /// `range` is scene_options::light_range: empty (the scene's own), "tight", or "near,far".
  light_projection(const scene& scene, depth_metric metric, const std::string& range);

  /// The ray of the light through (u, v): from `origin`, z grows by 1 along `direction`.
  struct ray {
    glm::dvec3 origin, direction;
  };
  ray ray_through(double u, double v) const;

  /// (u, v) of a point, and its distance z from the light's plane.
  glm::dvec3 project(glm::dvec3 point) const;
  /// How (u, v) changes when a point moves along `step`.
  glm::dvec2 project_step(glm::dvec3 point, glm::dvec3 step) const;

  /// Depth of the plane of `triangle` at (u, v), in [0,1]: values beyond the range are clamped, and
  /// z stays within the triangle's own, so that a grazing plane cannot fly off.
  double depth_at(const triangle_points& triangle, double u, double v) const;
  /// d depth / du and dv on the triangle's plane there, unclamped.
  glm::dvec2 slope_at(const triangle_points& triangle, double u, double v) const;

  /// The unit vector from a point towards the light.
  glm::dvec3 towards_light(glm::dvec3 point) const;
  double nearest() const { return nearest_; }  ///< least z of any vertex
  double near() const { return near_; }
  double far() const { return far_; }

 private:
  double metric_of(glm::dvec3 point, const triangle_points& triangle) const;
  double unclamped(const triangle_points& triangle, double u, double v) const;

  light_view light_;
  depth_metric metric_;
  double near_ = 0, far_ = 1;      // of z
  double farthest_ = 1;            // of |p - L|
  double nearest_ = 0, last_ = 1;  // of z over the vertices
};

}  // namespace bitshade
