// A layer of a variance shadow map in native arithmetic, with its texels rounded to a format
// between the stages: row kernels over whole maps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/pipeline.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// T is float or double; `light` is what a lookup gives.
template <class T>
class native_engine {
 public:
  using light = T;

  native_engine(const frame& scene, const configuration& how, const storage_format& storage,
                const lookup& look, int threads, cell& times)
      : scene_(scene),
        how_(how),
        storage_(storage),
        look_(look),
        blur_(blur_of(how)),
        threads_(threads),
        times_(times) {}

  /// Depth map -> moments -> store -> blur, stored between passes -> mips.
  void generate(const interval& layer) {
    layer_ = layer;
    const image<float>& depth = scene_.depth;
    image<T> moments(depth.width, depth.height, 2);
    map_pass(
        [&](int y) {
          warp_row<T>(depth.row(y), layer, moments.row(y), 2);
          square_row<T>(moments.row(y), 2);
        },
        moments);
    if (blur_.weights.size() > 1) {
      image<T> across(depth.width, depth.height, 2);
      map_pass([&](int y) { blur_row_x<T>(moments, blur_, map_address, y, across.row(y)); },
               across);
      map_pass([&](int y) { blur_row_y<T>(across, blur_, map_address, y, moments.row(y)); },
               moments);
    }
    chain_.clear();
    chain_.push_back(std::move(moments));
    if (look_.mips) {
      const int levels = mip_levels(depth.width, depth.height);
      for (int level = 1; level < levels; ++level) {
        const image<T>& from = chain_.back();
        image<T> next(mip_size(depth.width, level), mip_size(depth.height, level), 2);
        map_pass([&](int y) { downsample_row<T>(from, map_mips, y, next.row(y)); }, next);
        chain_.push_back(std::move(next));
      }
    }
  }

  /// Calls take(receiver, light) for each user of the layer generated last.
  template <class Take>
  void shade(std::span<const std::uint32_t> users, Take take) {
    const stopwatch watch(times_.shade_seconds);
    const T floor = layer_floor<T>(how_.min_variance, layer_);
    for_ranges(threads_, users.size(), 2048, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const receiver& r = scene_.receivers[users[i]];
        const auto [m1, m2] = filtered(r);
        const T t = warp(clamp_depth(static_cast<T>(r.t)), layer_);
        take(users[i], chebyshev(mean_and_variance(m1, m2), t, floor));
      }
    });
  }

  static light darker(const light& a, const light& b) { return b < a ? b : a; }
  /// The transition between two layers at a split: a lerp in T.
  light blended(const light& near, const light& far, const receiver& r, double split) const {
    return lerp(near, far, transition_share(clamp_depth(static_cast<T>(r.t)), split, how_.overlap));
  }
  double finished(const light& p) const {
    if (how_.bleeding_reduction == 0) return static_cast<double>(p);
    return static_cast<double>(
        reduce_bleeding(p, static_cast<T>(on_split_grid(how_.bleeding_reduction))));
  }

  const image<T>& texels() const { return chain_.front(); }

 private:
  struct moments_pair {
    T first, second;
  };

  moments_pair filtered(const receiver& r) const {
    const T u = static_cast<T>(r.u), v = static_cast<T>(r.v);
    const image<T>& base = chain_.front();
    if (look_.plain()) {
      const auto at = plain_taps<T>(look_, u, v, base.width, base.height);
      return {bilinear(base, at, 0), bilinear(base, at, 1)};
    }
    const auto probes = probes_of(r, base.width, base.height, look_.max_anisotropy);
    const std::span<const image<T>> chain(chain_);
    return {anisotropic<T>(chain, u, v, probes, map_address, 0, map_mip_bits),
            anisotropic<T>(chain, u, v, probes, map_address, 1, map_mip_bits)};
  }

  template <class Row>
  void map_pass(Row row, image<T>& out) {
    {
      const stopwatch watch(times_.map_seconds);
      for_rows(threads_, out.height, row);
    }
    if (!storage_.code) return;
    const stopwatch watch(times_.emulation_seconds);
    for_rows(threads_, out.height, [&](int y) { round_row(storage_, out.row(y)); });
  }

  const frame& scene_;
  const configuration& how_;
  const storage_format& storage_;
  const lookup look_;
  const kernel blur_;
  const int threads_;
  cell& times_;
  interval layer_;
  std::vector<image<T>> chain_;
};

}  // namespace bitshade
