// A stored texture, a model and a sampler's state, bound together: what `texture()` is in a shader.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bitshade/texture/presets.hpp"
#include "bitshade/texture/sampler.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade {

/// Samples one chain of a stored texture as a model does.
///
/// Policy   models with an `intermediate` rounding are evaluated in binary64, which holds what is
///          to be rounded, and narrowed to binary32 at the end; the result of intermediate::result
///          is rounded to the model's `rounded_to`, scaled codes included. All others operate in
///          binary32 throughout.
/// Failure  the constructor throws std::invalid_argument for an empty chain, or where the model
///          filters codes that the format does not have; sampling never fails.
class device_sampler {
 public:
  device_sampler(const filter_model& model, const texel_format& format,
                 const std::vector<coded_image>& chain, const sampler_state& state)
      : model_(model), format_(format), state_(state) {
    if (chain.empty()) throw std::invalid_argument("a texture needs at least one level");
    if (model.order == accumulation::lerp_codes)
      for (int c = 0; c < format.channels; ++c)
        if (format.of[static_cast<std::size_t>(c)] != unorm_encoding(8))
          throw std::invalid_argument("the preset " + std::string(model.name) +
                                      " filters 8-bit unorm channels alone");
    // llvmpipe's 8-bit way knows clamp and repeat alone, and no anisotropy.
    const auto simple = [](address a) { return a == address::clamp || a == address::repeat; };
    if (model.order == accumulation::lerp_codes &&
        (!simple(state.u) || !simple(state.v) || state.max_anisotropy > 1))
      model_ = preset_detail::llvmpipe();
    wide_ = model.rounding != intermediate::none;
    if (model.rounding == intermediate::result) {
      wide_chain_ = load_chain<double>(model_, format, chain);
    } else {
      chain_ = load_chain<float>(model_, format, chain);
      if (wide_)
        for (const image<float>& level : chain_) {
          image<double>& to = wide_chain_.emplace_back(level.width, level.height, level.channels);
          to.texels.assign(level.texels.begin(), level.texels.end());
        }
    }
    // A border is given as a value; where codes are filtered it has to be one.
    for (std::size_t c = 0; c < 4; ++c) {
      scale_[c] = texel_scale(model_, format.of[c]);
      if (scale_[c] != 1.0f) state_.border[c] = state_.border[c] / static_cast<double>(scale_[c]);
    }
  }

  int channels() const { return format_.channels; }
  const filter_model& model() const { return model_; }
  const std::vector<image<float>>& chain() const { return chain_; }

  float lod(float u, float v, float lambda, int channel) const {
    if (wide_)
      return finish(sample_lod<double>(model_, wide_chain_, u, v, lambda, state_, channel),
                    channel);
    return finish(sample_lod<float>(model_, chain_, u, v, lambda, state_, channel), channel);
  }

  float gradient(float u, float v, const gradients& g, int channel) const {
    if (wide_)
      return finish(sample_gradients<double>(model_, wide_chain_, u, v, g, state_, channel),
                    channel);
    return finish(sample_gradients<float>(model_, chain_, u, v, g, state_, channel), channel);
  }

 private:
  template <class T>
  float finish(T value, int channel) const {
    const float scale = scale_[static_cast<std::size_t>(channel)];
    if (model_.rounding == intermediate::result && model_.rounded_to != binary32::value) {
      const double scaled = static_cast<double>(value) * static_cast<double>(scale);
      return static_cast<float>(round_to(model_.rounded_to, scaled));
    }
    const auto narrow = static_cast<float>(value);
    return scale == 1.0f ? narrow : narrow * scale;
  }

  filter_model model_;
  texel_format format_;
  sampler_state state_;
  bool wide_ = false;
  std::vector<image<float>> chain_;
  std::vector<image<double>> wide_chain_;
  std::array<float, 4> scale_{};
};

/// The mip chain that a device makes of level 0: each texel sampled bilinearly from the level
/// below at the texel's centre (or box, or area, as the model says), then stored.
inline std::vector<coded_image> device_mip_chain(const filter_model& model,
                                                 const texel_format& format, coded_image base) {
  std::vector<coded_image> levels;
  const int count = mip_levels(base.width, base.height);
  levels.push_back(std::move(base));
  for (int level = 1; level < count; ++level) {
    const coded_image& from = levels.back();
    const int width = std::max(1, from.width / 2), height = std::max(1, from.height / 2);
    image<float> next(width, height, from.channels);
    if (model.mips == mip_filter::centre) {
      const device_sampler sampler(model, format, {from}, {});
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          for (int c = 0; c < from.channels; ++c) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
            next.at(x, y, c) = sampler.lod(u, v, 0, c);
          }
    } else {
      filter_model plain = model;
      if (plain.texel == texel_rule::integers) plain.texel = texel_rule::reciprocal;
      const image<float> below = load_image<float>(plain, format, from);
      for (int y = 0; y < height; ++y) downsample_row<float>(below, model.mips, y, next.row(y));
    }
    levels.push_back(store(model, format, next));
  }
  return levels;
}

}  // namespace bitshade
