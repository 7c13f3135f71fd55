// One sampler for every model: presets are data that it interprets.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/texture/accumulate.hpp"
#include "bitshade/texture/ewa.hpp"
#include "bitshade/texture/image.hpp"
#include "bitshade/texture/locate_model.hpp"
#include "bitshade/texture/lod_model.hpp"
#include "bitshade/texture/probes.hpp"

namespace bitshade {

enum class mip_selection : std::uint8_t { none, nearest, linear };

/// What the application asks of a sampler.
struct sampler_state {
  address u = address::clamp, v = address::clamp;
  bool linear = true;  ///< within a level; false: the nearest texel
  mip_selection mips = mip_selection::none;
  int max_anisotropy = 1;
  std::array<double, 4> border{};
};

namespace sampler_detail {

template <class T>
T texel_or_border(const image<T>& in, int x, int y, int channel, const sampler_state& state) {
  if (x < 0 || y < 0) return static_cast<T>(state.border[static_cast<std::size_t>(channel)]);
  return in.at(x, y, channel);
}

}  // namespace sampler_detail

/// One channel of one level.
///
/// Policy   the model's; operations are T's.
/// Failure  none: every u and v reads inside the level or the border.
template <class T>
T sample_level(const filter_model& model, const image<T>& in, const T& u, const T& v,
               const sampler_state& state, int channel) {
  using sampler_detail::texel_or_border;
  if (!state.linear)
    return texel_or_border(in, nearest_axis(model, u, in.width, state.u),
                           nearest_axis(model, v, in.height, state.v), channel, state);
  const axis_taps<T> x = locate_axis(model, u, in.width, state.u);
  const axis_taps<T> y = locate_axis(model, v, in.height, state.v);
  return filter_four<T>(model, texel_or_border(in, x.i0, y.i0, channel, state),
                        texel_or_border(in, x.i1, y.i0, channel, state),
                        texel_or_border(in, x.i0, y.i1, channel, state),
                        texel_or_border(in, x.i1, y.i1, channel, state), x.weight, y.weight);
}

/// The levels that a level of detail asks for, blended.
///
///   lambda limited to [0, last]; linear: interpolate(level floor, level floor + 1, fraction on
///   the model's grid); nearest: ceil(lambda + 1/2) - 1
///
/// Shapes   level: T(int).
/// Failure  none; NaN is level 0.
template <class T, class Level>
T blend_levels(const filter_model& model, const sampler_state& state, const T& lambda, int levels,
               Level level) {
  const int last = levels - 1;
  if (state.mips == mip_selection::none || !(static_cast<T>(0) < lambda)) return level(0);
  if (state.mips == mip_selection::nearest) {
    const T shifted = lambda + static_cast<T>(0.5);
    const int below = texel_floor(shifted);
    return level(std::min(last, shifted == static_cast<T>(below) ? below - 1 : below));
  }
  const int near = texel_floor(lambda);
  if (near >= last) return level(last);
  const T fraction =
      locate_detail::on_grid(lambda - static_cast<T>(near), model.mip_bits, snap::floor);
  return interpolate<T>(model, level(near), level(near + 1), fraction);
}

/// One channel of a chain at a level of detail.
template <class T>
T sample_lod(const filter_model& model, std::span<const image<T>> chain, const T& u, const T& v,
             const T& lambda, const sampler_state& state, int channel) {
  return blend_levels(model, state, lambda, static_cast<int>(chain.size()), [&](int l) {
    return sample_level(model, chain[static_cast<std::size_t>(l)], u, v, state, channel);
  });
}

/// One channel of a chain, level and probes chosen from derivatives.
///
/// Units    derivatives of u and v per pixel.
/// Policy   levels, ratios and probe counts are binary32's, as devices compute them; filtering is
///          T's.
template <class T>
T sample_gradients(const filter_model& model, std::span<const image<T>> chain, const T& u,
                   const T& v, const gradients& g, const sampler_state& state, int channel) {
  const image<T>& base = chain.front();
  if (state.max_anisotropy <= 1) {
    const float lambda = model_lambda(model, g, base.width, base.height);
    return sample_lod(model, chain, u, v, static_cast<T>(lambda), state, channel);
  }
  if (model.anisotropy == anisotropy_rule::ewa ||
      model.anisotropy == anisotropy_rule::ewa_unlimited) {
    const int limit = model.anisotropy == anisotropy_rule::ewa ? state.max_anisotropy : 0;
    const int last = static_cast<int>(chain.size()) - 1;
    const int level = ewa_level(model, g, base.width, base.height, limit);
    if (level >= last) return sample_level(model, chain.back(), u, v, state, channel);
    const ewa_ellipse ellipse(g, base.width, base.height, std::max(0, level));
    const bool llvmpipe = model.anisotropy == anisotropy_rule::ewa_unlimited;
    const image<T>& in = chain[static_cast<std::size_t>(std::max(0, level))];
    return static_cast<T>(ewa_sum(ellipse, llvmpipe, static_cast<float>(u), static_cast<float>(v),
                                  base.width, base.height, [&](float s, float t) {
                                    return static_cast<float>(sampler_detail::texel_or_border(
                                        in, nearest_axis(model, s, in.width, state.u),
                                        nearest_axis(model, t, in.height, state.v), channel,
                                        state));
                                  }));
  }
  probe_plan plan =
      plan_probes(model.anisotropy, model.log2, g, base.width, base.height, state.max_anisotropy);
  if (model.anisotropy == anisotropy_rule::feline)
    limit_feline(plan, static_cast<int>(chain.size()) - 1);
  const auto level = [&](int l) {
    T at_u = u + static_cast<T>(plan.first) * static_cast<T>(plan.du);
    T at_v = v + static_cast<T>(plan.first) * static_cast<T>(plan.dv);
    const T step_u = static_cast<T>(plan.du) * static_cast<T>(plan.spacing);
    const T step_v = static_cast<T>(plan.dv) * static_cast<T>(plan.spacing);
    T sum = static_cast<T>(0);
    for (int i = 0; i < plan.count; ++i) {
      sum = sum +
            sample_level(model, chain[static_cast<std::size_t>(l)], at_u, at_v, state, channel) *
                static_cast<T>(plan.weight(i));
      at_u = at_u + step_u;
      at_v = at_v + step_v;
    }
    return sum;
  };
  return blend_levels(model, state, static_cast<T>(plan.lambda), static_cast<int>(chain.size()),
                      level);
}

}  // namespace bitshade
