// How a run's receivers read the map, decided once from the configuration and the plan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bitshade/shadow/layers.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "bitshade/study/plan.hpp"
#include "bitshade/texture/bilinear.hpp"
#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/lod.hpp"
#include "bitshade/texture/mip.hpp"

namespace bitshade {

/// The address mode of every map: a shadow map's border repeats its edge.
inline constexpr address map_address = address::clamp;

/// Mip levels are 2x2 means, so that exact levels stay dyadic for every size of map.
inline constexpr mip_filter map_mips = mip_filter::box;

/// Fraction bits of the level of detail ([D3D11] 7.18.10).
inline constexpr int map_mip_bits = 8;

/// What a lookup simulates.
struct lookup {
  texel_filter filter = texel_filter::bilinear;
  bool mips = false;
  int max_anisotropy = 1;
  int samples = 1;  ///< of a texel, whose mean the map is

  /// Whether a lookup is one bilinear or nearest fetch of level 0.
  bool plain() const { return !mips && max_anisotropy == 1; }
};

/// Calls use(x, y, part) for the texels of one fetch from a level, nearest or bilinear.
///
/// Units  u, v in 2^-24 of the map; part, the exact weight, in 2^-48 and never 0.
template <class Use>
void for_fetched(const lookup& look, std::int64_t u, std::int64_t v, int width, int height,
                 Use use) {
  constexpr std::int64_t one = std::int64_t{1} << 24;
  std::int64_t x = u * width, y = v * height, fx = 0, fy = 0;
  if (look.filter == texel_filter::bilinear) {
    x -= one / 2;
    y -= one / 2;
    fx = x & (one - 1);
    fy = y & (one - 1);
  }
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const auto part =
          static_cast<std::uint64_t>((i == 0 ? one - fx : fx) * (j == 0 ? one - fy : fy));
      if (part == 0) continue;
      use(wrap(static_cast<int>((x >> 24) + i), width, map_address),
          wrap(static_cast<int>((y >> 24) + j), height, map_address), part);
    }
  }
}

inline lookup lookup_of(const configuration& how, const plan& effects) {
  return {how.filter == texel_filter::nearest ? texel_filter::nearest : texel_filter::bilinear,
          effects.simulates("mips"), effects.simulates("anisotropy") ? how.max_anisotropy : 1,
          effects.simulates("msaa") ? how.filtered.msaa : 1};
}

/// The depth maps that a texel is made of: the centres' alone, or one a sample.
inline std::vector<const image<float>*> depth_maps(const frame& scene, int samples) {
  if (samples == 1) return {&scene.depth};
  std::vector<const image<float>*> maps;
  for (const map_sample& s : scene.samples.at(samples)) maps.push_back(&s.depth);
  return maps;
}

/// Calls use(receiver) for each of n x n lookups, row by row: the receiver itself, moved by whole
/// texels of level 0 on the grid of probe offsets, and no farther than the map's edge.
template <class Use>
void each_lookup(const receiver& r, int n, int width, int height, Use use) {
  if (n == 1) return use(r);
  const auto moved = [](float at, int texels, int size) {
    const double step = std::round(texels / (size * probe_grid)) * probe_grid;
    return static_cast<float>(std::clamp(static_cast<double>(at) + step, 0.0, 1.0));
  };
  for (int j = -n / 2; j <= n / 2; ++j) {
    for (int i = -n / 2; i <= n / 2; ++i) {
      receiver there = r;
      there.u = moved(r.u, i, width);
      there.v = moved(r.v, j, height);
      use(there);
    }
  }
}

/// The texel centres' neighbours and weights of a plain lookup; nearest reads one texel.
template <class T>
bilinear_taps<T> plain_taps(const lookup& how, const T& u, const T& v, int width, int height) {
  if (how.filter == texel_filter::bilinear) return locate(u, v, width, height, map_address);
  const int x = wrap(texel_floor(u * static_cast<T>(width)), width, map_address);
  const int y = wrap(texel_floor(v * static_cast<T>(height)), height, map_address);
  return {x, x, y, y, static_cast<T>(0), static_cast<T>(0)};
}

/// The probes of a receiver in a map of width x height, limited to `max_anisotropy`.
inline probe_set probes_of(const receiver& r, int width, int height, int max_anisotropy) {
  const gradients g{r.du_dx, r.dv_dx, r.du_dy, r.dv_dy};
  return vulkan_probes(g, width, height, max_anisotropy);
}

inline kernel blur_of(const configuration& how) {
  const int taps = how.blurred() ? how.blur_taps : 1;
  return how.filtered.shape == blur_shape::box ? box_kernel(taps)
                                               : gaussian_kernel(taps, how.blur_sigma);
}

inline bool has_receiver(const receiver& r) { return r.surface != 0; }

/// Which layers a run generates and which receivers look each up, in rising order.
struct layer_table {
  std::vector<double> splits;
  std::vector<interval> intervals;
  std::vector<std::vector<std::uint32_t>> users;
  std::vector<layer_pair> blends;  ///< of each receiver; empty where none blends
  std::vector<int> own;            ///< the layer of each receiver, -1 where there is none
};

/// Layers of the configuration under a plan.
///
/// A layer without users is not generated, unless the plan says to simulate empty layers.
layer_table layers_of(const frame& scene, const configuration& how, const plan& effects);

}  // namespace bitshade
