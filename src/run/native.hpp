// A filterable map in native arithmetic, its texels rounded to a format between the stages: row
// kernels over whole maps. What is stored and how light comes of it is a technique's.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/pipeline.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// T is float or double; `light` is what a lookup gives.
///
/// A Technique has
///   channels()                       of a texel
///   begin(layer)                     before a layer is generated
///   fill(depth map, y, row)          row y of the unfiltered map
///   light(values, t)                 of `channels` filtered values, at a receiver's depth in [0,1]
template <class T, class Technique>
class native_engine {
 public:
  using light = T;

  native_engine(const frame& scene, const configuration& how, Technique technique,
                const storage_format& storage, const lookup& look, int threads, cell& times)
      : scene_(scene),
        how_(how),
        technique_(std::move(technique)),
        storage_(storage),
        look_(look),
        blur_(blur_of(how)),
        threads_(threads),
        times_(times) {}

  /// Depth map -> texels -> store -> blur, stored between passes -> mips.
  void generate(const interval& layer) {
    technique_.begin(layer);
    const image<float>& depth = scene_.depth;
    const int channels = technique_.channels();
    image<T> texels(depth.width, depth.height, channels);
    map_pass([&](int y) { technique_.fill(depth, y, texels.row(y)); }, texels);
    if (blur_.weights.size() > 1) {
      image<T> across(depth.width, depth.height, channels);
      map_pass([&](int y) { blur_row_x<T>(texels, blur_, map_address, y, across.row(y)); }, across);
      map_pass([&](int y) { blur_row_y<T>(across, blur_, map_address, y, texels.row(y)); }, texels);
    }
    chain_.clear();
    chain_.push_back(std::move(texels));
    if (look_.mips) {
      const int levels = mip_levels(depth.width, depth.height);
      for (int level = 1; level < levels; ++level) {
        const image<T>& from = chain_.back();
        image<T> next(mip_size(depth.width, level), mip_size(depth.height, level), channels);
        map_pass([&](int y) { downsample_row<T>(from, map_mips, y, next.row(y)); }, next);
        chain_.push_back(std::move(next));
      }
    }
  }

  /// Calls take(receiver, light) for each user of the layer generated last.
  template <class Take>
  void shade(std::span<const std::uint32_t> users, Take take) {
    const stopwatch watch(times_.shade_seconds);
    for_ranges(threads_, users.size(), 2048, [&](std::size_t first, std::size_t last) {
      std::vector<T> values(static_cast<std::size_t>(technique_.channels()));
      for (std::size_t i = first; i < last; ++i) {
        const receiver& r = scene_.receivers[users[i]];
        filter(r, values);
        take(users[i],
             technique_.light(std::span<const T>(values), clamp_depth(static_cast<T>(r.t))));
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
  void filter(const receiver& r, std::span<T> values) const {
    const T u = static_cast<T>(r.u), v = static_cast<T>(r.v);
    const image<T>& base = chain_.front();
    if (look_.plain()) {
      const auto at = plain_taps<T>(look_, u, v, base.width, base.height);
      for (int c = 0; c < base.channels; ++c) {
        values[static_cast<std::size_t>(c)] = bilinear(base, at, c);
      }
      return;
    }
    const auto probes = probes_of(r, base.width, base.height, look_.max_anisotropy);
    const std::span<const image<T>> chain(chain_);
    for (int c = 0; c < base.channels; ++c) {
      values[static_cast<std::size_t>(c)] =
          anisotropic<T>(chain, u, v, probes, map_address, c, map_mip_bits);
    }
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
  Technique technique_;
  const storage_format& storage_;
  const lookup look_;
  const kernel blur_;
  const int threads_;
  cell& times_;
  std::vector<image<T>> chain_;
};

}  // namespace bitshade
