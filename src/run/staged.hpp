// The engine behind run_staged() for maps that are filtered as they are: each stage in its
// arithmetic.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/texture/trilinear.hpp"
#include "run/map_stages.hpp"
#include "run/staged_base.hpp"

namespace bitshade {

template <class T, template <class> class Technique>
class staged_engine : public staged_base<T, Technique> {
  using parts = staged_base<T, Technique>;
  using parts::choices_, parts::fraction_bits_, parts::has, parts::how_, parts::look_,
      parts::scene_, parts::storage_, parts::threads_;

 public:
  using parts::parts;

  void generate(const interval& layer) {
    this->begin(layer);
    staged_image<T> texels = this->resolved();
    if (how_.blurred()) blur(texels);
    chain_.clear();
    chain_.push_back(std::move(texels));
    const int levels = look_.mips ? mip_levels(scene_.depth.width, scene_.depth.height) : 1;
    for (int level = 1; level < levels; ++level) chain_.push_back(next_level(chain_.back(), level));
    natives_.clear();
    exacts_.clear();
    for (auto& level : chain_) {
      if (has(stage::filter)) {
        natives_.push_back(level.as_native());
      } else {
        exacts_.push_back(level.as_exact());
      }
    }
  }

  /// The lights of a receiver's lookups; bilinear weights and all else as one lookup has them.
  std::vector<staged_exact> lights(const receiver& r) const {
    std::vector<staged_exact> all;
    each_lookup(r, how_.filtered.lookups, scene_.depth.width, scene_.depth.height,
                [&](const receiver& there) { all.push_back(light(there)); });
    return all;
  }

 private:
  staged_exact light(const receiver& r) const {
    std::vector<T> native(static_cast<std::size_t>(this->channels()));
    std::vector<staged_exact> exact(native.size());
    if (has(stage::filter)) {
      filter(r, std::span<const image<T>>(natives_), std::span<T>(native));
    } else {
      filter(r, std::span<const image<staged_exact>>(exacts_), std::span<staged_exact>(exact));
    }
    return this->light_of(std::move(native), std::move(exact), r);
  }

  void blur(staged_image<T>& texels) const {
    const auto native = [&](auto row, image<T>& out) {
      for_rows(threads_, out.height, [&](int y) {
        row(y);
        round_row(storage_, out.row(y));
      });
    };
    const auto exact = [&](auto row, image<staged_exact>& out) {
      for_rows(threads_, out.height, row);
    };
    if (has(stage::blur)) {
      texels.as_native();
      blur_map(how_, fraction_bits_, texels.native, native);
    } else {
      texels.as_exact();
      configuration one_blur = how_;  // without rounding every way is one blur
      one_blur.filtered.way = blur_way::separable;
      blur_map(one_blur, 0, texels.exact, exact);
    }
  }

  staged_image<T> next_level(staged_image<T> from, int level) const {
    const int width = mip_size(scene_.depth.width, level);
    const int height = mip_size(scene_.depth.height, level);
    staged_image<T> to;
    to.in_format = has(stage::mips);
    const auto run = [&]<class V>(const image<V>& in) {
      return this->template pass<V>(width, height, in.channels,
                     [&](int y, std::span<V> row) { downsample_row<V>(in, map_mips, y, row); });
    };
    if (to.in_format) {
      to.native = run(from.as_native());
    } else {
      to.exact = run(from.as_exact());
    }
    return to;
  }

  template <class V>
  bilinear_taps<V> taps_of(const receiver& r) const {
    const int width = scene_.depth.width, height = scene_.depth.height;
    if (!has(stage::weights)) {  // u and v lie on a grid on which binary64 loses nothing
      const auto at = plain_taps<double>(look_, r.u, r.v, width, height);
      return {at.x0, at.x1, at.y0, at.y1, V(at.fx), V(at.fy)};
    }
    auto at = plain_taps<T>(look_, static_cast<T>(r.u), static_cast<T>(r.v), width, height);
    if (choices_.weight_bits > 0) {
      const T steps = static_cast<T>(std::uint64_t{1} << choices_.weight_bits);
      at.fx = std::nearbyint(at.fx * steps) / steps;
      at.fy = std::nearbyint(at.fy * steps) / steps;
    }
    return {at.x0, at.x1, at.y0, at.y1, staged_value<V>(at.fx), staged_value<V>(at.fy)};
  }

  template <class V>
  void filter(const receiver& r, std::span<const image<V>> chain, std::span<V> out) const {
    const image<V>& base = chain.front();
    if (look_.plain()) {
      const auto at = taps_of<V>(r);
      for (int c = 0; c < base.channels; ++c)
        out[static_cast<std::size_t>(c)] = bilinear(base, at, c);
      return;
    }
    const auto probes = probes_of(r, base.width, base.height, look_.max_anisotropy);
    for (int c = 0; c < base.channels; ++c) {
      if constexpr (std::is_same_v<V, T>) {
        out[static_cast<std::size_t>(c)] = anisotropic<T>(
            chain, static_cast<T>(r.u), static_cast<T>(r.v), probes, map_address, c, map_mip_bits);
      } else {
        out[static_cast<std::size_t>(c)] = exact_probes(r, chain, probes, c);
      }
    }
  }

  /// anisotropic() with places in binary64, where they are exact, and values that are enclosures.
  static staged_exact exact_probes(const receiver& r, std::span<const image<staged_exact>> chain,
                                   const probe_set& probes, int channel) {
    const auto blend = blend_levels(probes.lambda, static_cast<int>(chain.size()), map_mip_bits);
    staged_exact sum;
    for (const auto& p : probes.offsets) {
      const auto level = [&](int l) {
        const auto& in = chain[static_cast<std::size_t>(l)];
        const auto at =
            locate<double>(static_cast<double>(r.u) + p.du, static_cast<double>(r.v) + p.dv,
                           in.width, in.height, map_address);
        return bilinear(in, bilinear_taps<staged_exact>{at.x0, at.x1, at.y0, at.y1, at.fx, at.fy},
                        channel);
      };
      staged_exact value = level(blend.near);
      if (blend.fraction != 0) value = lerp(value, level(blend.far), staged_exact(blend.fraction));
      sum = sum + value;
    }
    return sum / staged_exact(static_cast<int>(probes.offsets.size()));
  }

  std::vector<staged_image<T>> chain_;
  std::vector<image<T>> natives_;
  std::vector<image<staged_exact>> exacts_;
};

}  // namespace bitshade
