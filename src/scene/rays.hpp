// Rays against a scene's triangles, through Embree.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "scene/scene.hpp"

namespace bitshade {

/// A scene's triangles, ready for rays. Robust mode: no ray slips between two triangles.
class ray_caster {
 public:
  /// Failure  failure if Embree cannot hold the scene.
  explicit ray_caster(const scene& scene);
  ~ray_caster();
  ray_caster(ray_caster&&) noexcept;
  ray_caster& operator=(ray_caster&&) noexcept;

  /// The index of the first triangle on the ray beyond `start`, in units of `direction`.
  std::optional<std::uint32_t> first_hit(glm::dvec3 origin, glm::dvec3 direction,
                                         double start = 0) const;
  /// Whether any triangle lies on the ray between `start` and `end`.
  bool occluded(glm::dvec3 origin, glm::dvec3 direction, double start, double end) const;

 private:
  struct handles;
  std::unique_ptr<handles> handles_;
};

}  // namespace bitshade
