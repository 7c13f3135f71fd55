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
#include "bitshade/texture/trilinear.hpp"
#include "run/engines.hpp"
#include "run/map_stages.hpp"
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

  native_engine(run_context& run, Technique technique)
      : scene_(run.scene),
        how_(run.how),
        technique_(std::move(technique)),
        storage_(run.storage),
        look_(run.look),
        fraction_bits_(run.effects.simulates("blur fractions") ? run.how.filtered.fraction_bits
                                                               : 0),
        threads_(run.threads),
        times_(run.result) {}

  /// Depth map or samples -> texels -> store -> resolve -> blur, stored between passes -> mips.
  void generate(const interval& layer) {
    technique_.begin(layer);
    const image<float>& depth = scene_.depth;
    const int channels = technique_.channels();
    const auto pass = [&](auto row, image<T>& out) { map_pass(row, out); };
    const auto fill = [&](const image<float>& map, int y, std::span<T> row) {
      technique_.fill(map, y, row);
    };
    image<T> texels = resolved_texels<T>(scene_, look_.samples, channels, fill, pass);
    blur_map(how_, fraction_bits_, texels, pass);
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

  /// Calls use(user, light_of) for each user; light_of(receiver) is its light in the layer
  /// generated last.
  template <class Use>
  void visit(std::span<const std::uint32_t> users, Use use) {
    const stopwatch watch(times_.shade_seconds);
    for_ranges(threads_, users.size(), 2048, [&](std::size_t first, std::size_t last) {
      std::vector<T> values(static_cast<std::size_t>(technique_.channels()));
      const auto light_of = [&](const receiver& r) {
        filter(r, values);
        return technique_.light(std::span<const T>(values), clamp_depth(static_cast<T>(r.t)));
      };
      for (std::size_t i = first; i < last; ++i) use(users[i], light_of);
    });
  }

  static light darker(const light& a, const light& b) { return b < a ? b : a; }
  /// The transition between two layers at a split: a lerp in T.
  light blended(const light& near, const light& far, const receiver& r, double split) const {
    return lerp(near, far, transition_share(clamp_depth(static_cast<T>(r.t)), split, how_.overlap));
  }
  double finished(const light& p) const { return static_cast<double>(reduced(p)); }
  /// The mean of finished lights, summed in T from the first to the last.
  double mean(std::span<const light> all) const {
    T sum = reduced(all.front());
    for (const light& p : all.subspan(1)) sum = sum + reduced(p);
    return static_cast<double>(sum / static_cast<T>(static_cast<int>(all.size())));
  }

  const image<T>& texels() const { return chain_.front(); }

 private:
  T reduced(const light& p) const {
    if (how_.bleeding_reduction == 0) return p;
    return reduce_bleeding(p, static_cast<T>(on_split_grid(how_.bleeding_reduction)));
  }
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
  const int fraction_bits_;
  const int threads_;
  cell& times_;
  std::vector<image<T>> chain_;
};

}  // namespace bitshade
