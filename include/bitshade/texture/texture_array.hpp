// Array layers: one texture a layer, the layer chosen by a coordinate.
#pragma once

#include <stdexcept>
#include <vector>

#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade {

/// The layer that a coordinate means: the nearest, ties to even, limited to those that there are.
///
/// Failure  none; NaN is layer 0.
/// Source   [Vulkan] "Layer Selection", [D3D11] 7.18.
inline int array_layer(float at, int layers) {
  const auto last = static_cast<float>(layers - 1);
  if (!(at > 0)) return 0;
  if (at >= last) return layers - 1;
  const int below = texel_floor(at);
  const float rest = at - static_cast<float>(below);
  return below + (rest > 0.5f || (rest == 0.5f && (below & 1) != 0) ? 1 : 0);
}

/// Samples a stored texture of several layers as a model does: layers are never filtered.
///
/// Failure  the constructor throws std::invalid_argument for a texture without layers, and as
///          device_sampler does.
class array_sampler {
 public:
  array_sampler(const filter_model& model, const stored_texture& texture,
                const sampler_state& state) {
    if (texture.layers.empty()) throw std::invalid_argument("a texture needs at least one layer");
    for (const auto& chain : texture.layers)
      layers_.emplace_back(model, texture.format, chain, state);
  }

  int layers() const { return static_cast<int>(layers_.size()); }

  float lod(float u, float v, float layer, float lambda, int channel) const {
    return at(layer).lod(u, v, lambda, channel);
  }
  float gradient(float u, float v, float layer, const gradients& g, int channel) const {
    return at(layer).gradient(u, v, g, channel);
  }

 private:
  const device_sampler& at(float layer) const {
    return layers_[static_cast<std::size_t>(array_layer(layer, layers()))];
  }

  std::vector<device_sampler> layers_;
};

}  // namespace bitshade
