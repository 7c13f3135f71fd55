// Sampling a mip chain as arithmetic defines it: the value, or the texels that it is made of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/texture/bilinear.hpp"
#include "bitshade/texture/lod.hpp"
#include "bitshade/texture/mip.hpp"

namespace bitshade {

/// One texel of a footprint.
template <class T>
struct footprint_texel {
  int level = 0, x = 0, y = 0;  ///< x or y of -1: the border
  T weight{};
};

/// The texels that a lookup reads, with weights that sum to 1 (in exact T; else to T's rounding).
template <class T>
using footprint = std::vector<footprint_texel<T>>;

/// The filtered value of one channel of a chain at one level of detail.
///
///   lerp(bilinear(near), bilinear(far), fraction): x, y, then mip
///
/// Policy   every operation is T's; a fraction of 0 reads the near level alone.
/// Failure  none for a chain that is not empty.
template <class T>
T trilinear(std::span<const image<T>> chain, const T& u, const T& v, const level_blend& blend,
            address mode, int channel, const T& border = T(0)) {
  const auto level = [&](int l) {
    const image<T>& in = chain[static_cast<std::size_t>(l)];
    return bilinear(in, locate(u, v, in.width, in.height, mode), channel, border);
  };
  const T near = level(blend.near);
  if (blend.fraction == 0) return near;
  return lerp(near, level(blend.far), static_cast<T>(blend.fraction));
}

/// The mean of trilinear lookups at every probe, first to last.
template <class T>
T anisotropic(std::span<const image<T>> chain, const T& u, const T& v, const probe_set& probes,
              address mode, int channel, int mip_bits = 8, const T& border = T(0)) {
  const level_blend blend = blend_levels(probes.lambda, static_cast<int>(chain.size()), mip_bits);
  T sum = static_cast<T>(0);
  bool first = true;
  for (const auto& at : probes.offsets) {
    const T value = trilinear(chain, u + static_cast<T>(at.du), v + static_cast<T>(at.dv), blend,
                              mode, channel, border);
    sum = first ? value : sum + value;
    first = false;
  }
  return sum / static_cast<T>(static_cast<int>(probes.offsets.size()));
}

/// Appends the texels of one bilinear lookup, each weight times `scale`.
template <class T>
void append_bilinear(footprint<T>& out, const bilinear_taps<T>& at, int level, const T& scale) {
  const T one = static_cast<T>(1);
  const T ux = one - at.fx, uy = one - at.fy;
  const auto add = [&](int x, int y, const T& wx, const T& wy) {
    const T weight = wx * wy * scale;
    if (weight != static_cast<T>(0)) out.push_back({level, x < 0 || y < 0 ? -1 : x, y, weight});
  };
  add(at.x0, at.y0, ux, uy);
  add(at.x1, at.y0, at.fx, uy);
  add(at.x0, at.y1, ux, at.fy);
  add(at.x1, at.y1, at.fx, at.fy);
}

/// The texels that anisotropic() reads, with their weights; one probe at the centre: trilinear().
///
/// Shapes   width, height: level 0's; levels: the chain's length.
/// Policy   texels that several probes share appear several times; weights of 0 are left out.
/// Error    none for exact T.
template <class T>
footprint<T> chain_footprint(int width, int height, int levels, const T& u, const T& v,
                             const probe_set& probes, address mode, int mip_bits = 8) {
  const level_blend blend = blend_levels(probes.lambda, levels, mip_bits);
  const T each = static_cast<T>(1) / static_cast<T>(static_cast<int>(probes.offsets.size()));
  const T far = static_cast<T>(blend.fraction);
  footprint<T> result;
  for (const auto& at : probes.offsets) {
    const T pu = u + static_cast<T>(at.du), pv = v + static_cast<T>(at.dv);
    const auto level = [&](int l, const T& scale) {
      append_bilinear(result, locate(pu, pv, mip_size(width, l), mip_size(height, l), mode), l,
                      scale);
    };
    level(blend.near, (static_cast<T>(1) - far) * each);
    if (blend.fraction != 0) level(blend.far, far * each);
  }
  return result;
}

/// The same footprint on level 0: each texel of a higher level replaced by those that it was made
/// of, equal texels merged, in row-major order, the border (if read) first.
template <class T>
footprint<T> on_base_level(const footprint<T>& texels, int width, int height, mip_filter filter) {
  int top = 0;
  for (const auto& texel : texels) top = texel.level > top ? texel.level : top;
  T outside = static_cast<T>(0);
  image<T> weights(mip_size(width, top), mip_size(height, top), 1, static_cast<T>(0));
  for (int level = top; level >= 0; --level) {
    for (const auto& texel : texels) {
      if (texel.level != level) continue;
      if (texel.x < 0 || texel.y < 0)
        outside = outside + texel.weight;
      else
        weights.at(texel.x, texel.y) = weights.at(texel.x, texel.y) + texel.weight;
    }
    if (level == 0) break;
    image<T> below(mip_size(width, level - 1), mip_size(height, level - 1), 1, static_cast<T>(0));
    for (int y = 0; y < weights.height; ++y) {
      const mip_taps down = mip_axis(filter, below.height, y);
      for (int x = 0; x < weights.width; ++x) {
        const T whole = weights.at(x, y);
        if (whole == static_cast<T>(0)) continue;
        const mip_taps across = mip_axis(filter, below.width, x);
        const T part = whole / static_cast<T>(across.denominator * down.denominator);
        for (int j = 0; j < down.count; ++j)
          for (int i = 0; i < across.count; ++i) {
            const int numerator = down.weight[static_cast<std::size_t>(j)] *
                                  across.weight[static_cast<std::size_t>(i)];
            T& into = below.at(across.first + i, down.first + j);
            into = into + part * static_cast<T>(numerator);
          }
      }
    }
    weights = std::move(below);
  }
  footprint<T> result;
  if (outside != static_cast<T>(0)) result.push_back({0, -1, -1, outside});
  for (int y = 0; y < weights.height; ++y)
    for (int x = 0; x < weights.width; ++x)
      if (weights.at(x, y) != static_cast<T>(0)) result.push_back({0, x, y, weights.at(x, y)});
  return result;
}

}  // namespace bitshade
