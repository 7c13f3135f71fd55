// What a study starts from: a light's depth map and the receivers that look it up.
// From here on everything is deterministic; rays and files lie before it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bitshade/texture/image.hpp"
#include "bitshade/texture/resolve.hpp"

namespace bitshade {

/// One shaded fragment: where it looks into the depth map, and with what depth.
///
/// Units    u, v in [0,1] across the map (v down the rows), on a grid of 2^-24, so that exact
///          kernels keep a fixed width; depths in [0,1] by the frame's metric; dt_du, dt_dv are
///          the receiver's tangent plane (depth per unit of u and v); du_dx .. dv_dy the screen
///          derivatives of (u, v), per pixel, from which a sampler takes its level and anisotropy.
///
/// A surface is one plane (a facet of a curved mesh), so that a texel with the receiver's own
/// number cannot occlude it. A pixel without a receiver (surface 0) shows the background (diffuse
/// 1), a plane that faces away from the light or contains its rays (diffuse 0), or one beyond the
/// map.
struct receiver {
  float u = 0, v = 0;
  float t = 0;
  float dt_du = 0, dt_dv = 0;
  float du_dx = 0, dv_dx = 0, du_dy = 0, dv_dy = 0;
  std::uint32_t surface = 0;  ///< the surface that it lies on; 0: no receiver at this pixel
  float diffuse = 1;          ///< max(0, n.l), for the shaded picture alone (see below)
};

/// A depth map seen through another place of every texel, and what was hit there.
struct map_sample {
  image<float> depth;
  image<std::uint32_t> surface;
  sample_position at;
};

/// A scene as its light and its camera see it.
///
/// Shapes   depth, at the texels' centres: 1 channel, binary32 in [0,1], 1 where nothing was drawn;
///          surface: same size, the id of what was hit (0: nothing), or empty for captured maps;
///          samples: for each number of them that is asked for, in its pattern's order;
///          receivers: view_width x view_height, row-major.
struct frame {
  std::string name;
  image<float> depth;
  image<std::uint32_t> surface;
  std::map<int, std::vector<map_sample>> samples;
  int view_width = 0;
  int view_height = 0;
  std::vector<receiver> receivers;
};

}  // namespace bitshade
