// All layers of an LVSM at once: generated in one pass, two to a four-component texel.
#pragma once

#include <cstddef>
#include <span>

#include "bitshade/shadow/moments.hpp"

namespace bitshade {

/// Where a layer's moments lie when two layers share a four-component texture.
struct packed_layer {
  int texture = 0;
  int channel = 0;  ///< of the first moment; the second one follows
};

constexpr packed_layer packed(int layer) { return {layer / 2, layer % 2 * 2}; }

/// Four-component textures that N layers take; of an odd N the last one is half empty.
constexpr int packed_textures(int layers) { return (layers + 1) / 2; }

/// A row of the moments of several layers, from one reading of the depths.
///
/// Shapes   out: 2 values a layer and texel, layers one after the other: two layers make a
///          four-component texel. `stride` values a texel, at least 2 a layer; 0: exactly that.
/// Policy   the same operations as warp_row and square_row on each layer alone, and so the same
///          bits: a post-process of the depth map equals generation in one pass.
/// Source   [LauritzenMcCool08] section 4.4.
template <class T>
void layers_row(std::span<const float> depth, std::span<const interval> layers, std::span<T> out,
                std::size_t stride = 0, layer_warp beyond = layer_warp::clamped) {
  const std::size_t channels = stride == 0 ? 2 * layers.size() : stride;
  for (std::size_t x = 0; x < depth.size(); ++x) {
    const T inside = clamp_depth(static_cast<T>(depth[x]));
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const T y = warp(inside, layers[i], beyond);
      out[x * channels + 2 * i] = y;
      out[x * channels + 2 * i + 1] = y * y;
    }
  }
}

}  // namespace bitshade
