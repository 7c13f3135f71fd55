#include "command/sampling.hpp"

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "command/texture_options.hpp"

namespace bitshade::command {
namespace {

class device : public texture_sampler {
 public:
  device(const filter_model& model, const named_texture& texture, const sampler_state& state)
      : sampler_(model, texture.format, texture.levels, state) {}
  float lod(float u, float v, float lambda, int channel) const override {
    return sampler_.lod(u, v, lambda, channel);
  }
  float gradient(float u, float v, const gradients& g, int channel) const override {
    return sampler_.gradient(u, v, g, channel);
  }

 private:
  device_sampler sampler_;
};

class exact : public texture_sampler {
 public:
  exact(const named_texture& texture, const sampler_state& state)
      : sampler_(texture.format, texture.levels, state) {}
  float lod(float u, float v, float lambda, int channel) const override {
    return sampler_.lod(u, v, lambda, channel);
  }
  float gradient(float u, float v, const gradients& g, int channel) const override {
    return sampler_.gradient(u, v, g, channel);
  }

 private:
  exact_sampler<exact_rational> sampler_;
};

}  // namespace

std::unique_ptr<texture_sampler> make_texture_sampler(const filter_model& model,
                                                      const named_texture& texture,
                                                      const sampler_state& state) {
  try {
    if (model.name == "exact") return std::make_unique<exact>(texture, state);
    return std::make_unique<device>(model, texture, state);
  } catch (const std::invalid_argument& e) {
    throw refused_format(texture, e.what());
  }
}

}  // namespace bitshade::command
