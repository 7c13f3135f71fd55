// One face for both kinds of sampler: a device's model, and the certified exact one.
#pragma once

#include <memory>

#include "bitshade/texture/sampler.hpp"
#include "io/texture_text.hpp"

namespace bitshade::command {

class texture_sampler {
 public:
  virtual ~texture_sampler() = default;
  virtual float lod(float u, float v, float lambda, int channel) const = 0;
  virtual float gradient(float u, float v, const gradients& g, int channel) const = 0;
};

/// The model's sampler; for the preset `exact`, the exact value rounded once to binary32.
/// Throws failure where the preset takes no such format.
std::unique_ptr<texture_sampler> make_texture_sampler(const filter_model& model,
                                                      const named_texture& texture,
                                                      const sampler_state& state);

}  // namespace bitshade::command
