// The texels that a receiver's lookup reads, with their exact weights.
#pragma once

#include <cstdint>
#include <vector>

#include "bitshade/texture/mip.hpp"
#include "run/engines.hpp"
#include "run/exact_grid.hpp"
#include "run/lookup.hpp"

namespace bitshade {

/// A texel of a lookup with its exact weight: `share` of 2^-8 times `part` of 2^-48.
struct exact_texel {
  int level, x, y;
  std::uint64_t part;
  std::uint64_t share;
};

/// Texels that several probes share appear several times.
struct exact_lookup {
  std::vector<exact_texel> texels;
  int probes = 1;
};

namespace detail {

inline void add_level(const run_context& run, std::vector<exact_texel>& to, std::int64_t u,
                      std::int64_t v, int level, std::uint64_t share) {
  const int width = mip_size(run.scene.depth.width, level);
  const int height = mip_size(run.scene.depth.height, level);
  for_fetched(run.look, u, v, width, height, [&](int x, int y, std::uint64_t part) {
    to.push_back({level, x, y, part, share});
  });
}

}  // namespace detail

/// The lookup of a receiver: bilinear or nearest, over levels and probes.
inline exact_lookup exact_lookup_of(const run_context& run, const receiver& r) {
  const image<float>& depth = run.scene.depth;
  const auto u = static_cast<std::int64_t>(static_cast<double>(r.u) * 0x1p24);
  const auto v = static_cast<std::int64_t>(static_cast<double>(r.v) * 0x1p24);
  exact_lookup result;
  if (run.look.plain()) {
    detail::add_level(run, result.texels, u, v, 0, 256);
    return result;
  }
  const auto probes = probes_of(r, depth.width, depth.height, run.look.max_anisotropy);
  const int levels = run.look.mips ? mip_levels(depth.width, depth.height) : 1;
  const auto blend = blend_levels(probes.lambda, levels, map_mip_bits);
  const auto far = on_grid(blend.fraction, map_mip_bits);
  for (const auto& at : probes.offsets) {
    const auto pu = u + static_cast<std::int64_t>(at.du * 0x1p24);
    const auto pv = v + static_cast<std::int64_t>(at.dv * 0x1p24);
    detail::add_level(run, result.texels, pu, pv, blend.near, 256 - far);
    if (far != 0) detail::add_level(run, result.texels, pu, pv, blend.far, far);
  }
  result.probes = static_cast<int>(probes.offsets.size());
  return result;
}

}  // namespace bitshade
