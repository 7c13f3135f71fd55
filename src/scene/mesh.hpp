// A mesh file's triangles, on bytes in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.hpp"

namespace bitshade {

/// Vertices and triangles alone; `ending` is obj or glb, `name` stands in the messages.
///
/// Failure  failure for what is no mesh, has no triangles, or vertices that are not finite.
scene decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name,
                  const std::string& ending);

}  // namespace bitshade
