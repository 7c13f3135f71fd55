// Flat pieces put into a scene, each with a surface number of its own.
#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.hpp"

namespace bitshade {

/// A box's centre and half axes, not necessarily along x, y and z.
struct box_shape {
  glm::dvec3 centre;
  glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< half axes, mutually perpendicular
};

/// The plane quadrilateral origin, origin + a, origin + a + b, origin + b: one surface.
void add_quad(scene& scene, glm::dvec3 origin, glm::dvec3 a, glm::dvec3 b);

/// Six surfaces.
void add_box(scene& scene, const box_shape& box);

/// A box that stands on y = `bottom`: no bottom face, ten triangles.
void add_block(scene& scene, double x0, double x1, double z0, double z1, double bottom, double top);

/// An upright prism of `sides` sides from `bottom` to `top`, with a lid.
void add_prism(scene& scene, glm::dvec3 centre, double radius, double bottom, double top,
               int sides);

/// A level polygon of `sides` sides around `centre`: one surface.
void add_disc(scene& scene, glm::dvec3 centre, double radius, int sides);

/// A directional light straight down over the window [-half, half]^2 around (x, z) = 0: a point at
/// height y has depth (top - y) / range.
void light_from_above(scene& scene, double half, double top, double range);

}  // namespace bitshade
