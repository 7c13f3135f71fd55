// The engine behind run_staged(): each stage in its arithmetic.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/lookup.hpp"
#include "run/map_stages.hpp"
#include "run/parallel.hpp"
#include "run/shading_arithmetic.hpp"
#include "run/staged_image.hpp"
#include "run/stages.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// Technique: a template over the number with channels(), begin(layer), fill(depth, y, row, keep),
/// light(values, t) and, for emulated shading, shading(values, t), the same as plain numbers.
template <class T, template <class> class Technique>
class staged_engine {
 public:
  staged_engine(const frame& scene, const configuration& how, const stage_choices& choices,
                const storage_format& storage, const lookup& look, int fraction_bits, int threads)
      : scene_(scene),
        how_(how),
        choices_(choices),
        storage_(storage),
        look_(look),
        fraction_bits_(fraction_bits),
        threads_(threads),
        native_(how),
        exact_(how) {
    if (choices.shading) shade_ = shading_in(*choices.shading);
  }

  void generate(const interval& layer) {
    native_.begin(layer);
    exact_.begin(layer);
    staged_image<T> texels = resolved();
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

  std::vector<staged_exact> blended(const std::vector<staged_exact>& near,
                                    const std::vector<staged_exact>& far, const receiver& r,
                                    double split) const {
    std::vector<staged_exact> all;
    for (std::size_t i = 0; i < near.size(); ++i) {
      all.push_back(in_shading([&](auto zero) {
        using V = decltype(zero);
        const V share = transition_share(clamp_depth(V(r.t)), split, how_.overlap);
        return lerp(staged_value<V>(near[i]), staged_value<V>(far[i]), share);
      }));
    }
    return all;
  }
  /// Less bleeding for each light, then their mean.
  double finished(const std::vector<staged_exact>& lights) const {
    const double alpha = on_split_grid(how_.bleeding_reduction);
    if (alpha == 0 && lights.size() == 1) return lights.front().nearest();
    return in_shading([&](auto zero) {
             using V = decltype(zero);
             const auto reduced = [&](const staged_exact& p) {
               const V light = staged_value<V>(p);
               return alpha == 0 ? light : reduce_bleeding(light, static_cast<V>(alpha));
             };
             V sum = reduced(lights.front());
             for (std::size_t i = 1; i < lights.size(); ++i) sum = sum + reduced(lights[i]);
             return lights.size() == 1 ? sum : sum / V(static_cast<int>(lights.size()));
           })
        .nearest();
  }

 private:
  staged_exact light(const receiver& r) const {
    std::vector<T> native(static_cast<std::size_t>(native_.channels()));
    std::vector<staged_exact> exact(native.size());
    if (has(stage::filter)) {
      filter(r, std::span<const image<T>>(natives_), std::span<T>(native));
      for (std::size_t c = 0; c < native.size(); ++c)
        exact[c] = staged_value<staged_exact>(native[c]);
    } else {
      filter(r, std::span<const image<staged_exact>>(exacts_), std::span<staged_exact>(exact));
      for (std::size_t c = 0; c < native.size(); ++c) native[c] = staged_value<T>(exact[c]);
    }
    if (!has(stage::shading)) {
      return exact_.light(std::span<const staged_exact>(exact), clamp_depth(staged_exact(r.t)));
    }
    if (shade_ != nullptr) {
      std::vector<double> values;
      for (const auto& v : exact) values.push_back(v.nearest());
      return staged_exact(shade_(native_.shading(values, static_cast<double>(r.t))));
    }
    return staged_value<staged_exact>(
        native_.light(std::span<const T>(native), clamp_depth(static_cast<T>(r.t))));
  }

  bool has(stage s) const { return choices_.in_format.has(s); }

  /// What is combined after shading is so in its arithmetic.
  template <class F>
  staged_exact in_shading(F f) const {
    return has(stage::shading) ? staged_value<staged_exact>(f(T{})) : f(staged_exact());
  }

  /// All rows of a new image, stored where they are native.
  template <class V, class Row>
  image<V> pass(int width, int height, int channels, Row make) const {
    image<V> out(width, height, channels);
    for_rows(threads_, height, [&](int y) {
      make(y, out.row(y));
      if constexpr (std::is_same_v<V, T>) round_row(storage_, out.row(y));
    });
    return out;
  }

  /// The texels of one depth map.
  staged_image<T> stored(const image<float>& depth) const {
    staged_image<T> texels;
    const int channels = native_.channels();
    texels.in_format = has(stage::store);
    if (texels.in_format) {
      texels.native = pass<T>(depth.width, depth.height, channels, [&](int y, std::span<T> row) {
        native_.fill(depth, y, row, [&](std::span<T> r) { round_row(storage_, r); });
      });
    } else {
      texels.exact = pass<staged_exact>(
          depth.width, depth.height, channels, [&](int y, std::span<staged_exact> row) {
            exact_.fill(depth, y, row, [](std::span<staged_exact>) {});
          });
    }
    return texels;
  }

  /// The map of the texels' centres, or the mean of its samples.
  staged_image<T> resolved() const {
    std::vector<staged_image<T>> samples;
    for (const image<float>* depth : depth_maps(scene_, look_.samples)) {
      samples.push_back(stored(*depth));
    }
    if (samples.size() == 1) return std::move(samples.front());
    staged_image<T> out;
    out.in_format = has(stage::resolve);
    const auto run = [&]<class V>(std::vector<image<V>> all) {
      return pass<V>(all[0].width, all[0].height, all[0].channels,
                     [&](int y, std::span<V> row) { resolve_row<V>(all, y, row); });
    };
    std::vector<image<T>> native;
    std::vector<image<staged_exact>> exact;
    for (auto& sample : samples) {
      if (out.in_format) {
        native.push_back(sample.as_native());
      } else {
        exact.push_back(sample.as_exact());
      }
      sample = {};
    }
    if (out.in_format) {
      out.native = run(std::move(native));
    } else {
      out.exact = run(std::move(exact));
    }
    return out;
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
      return pass<V>(width, height, in.channels,
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

  const frame& scene_;
  const configuration& how_;
  const stage_choices& choices_;
  const storage_format& storage_;
  const lookup look_;
  const int fraction_bits_;
  const int threads_;
  Technique<T> native_;
  Technique<staged_exact> exact_;
  shading_function shade_ = nullptr;
  std::vector<staged_image<T>> chain_;
  std::vector<image<T>> natives_;
  std::vector<image<staged_exact>> exacts_;
};

/// All layers, as run_layers() does, with lights that remember which arithmetic they came from.
template <class Engine>
void run_staged_layers(Engine& engine, const frame& scene, const layer_table& table, int threads,
                       cell& result) {
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::vector<staged_exact>> waiting(table.blends.empty() ? 0 : scene.receivers.size());
  for (std::size_t i = 0; i < table.intervals.size(); ++i) {
    const auto& users = table.users[i];
    if (users.empty()) continue;
    engine.generate(table.intervals[i]);
    for_ranges(threads, users.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::uint32_t at = users[k];
        const receiver& r = scene.receivers[at];
        auto p = engine.lights(r);
        if (table.blends.empty() || table.blends[at].near == table.blends[at].far) {
          result.visibility[at] = engine.finished(p);
        } else if (static_cast<int>(i) == table.blends[at].near) {
          waiting[at] = std::move(p);
        } else {
          const double split = table.splits[static_cast<std::size_t>(table.blends[at].far)];
          result.visibility[at] = engine.finished(engine.blended(waiting[at], p, r, split));
        }
      }
    });
  }
}

}  // namespace bitshade
