// What every staged engine does alike: texels, stored and resolved, and the light of filtered values.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/resolve.hpp"
#include "run/parallel.hpp"
#include "run/shading_arithmetic.hpp"
#include "run/staged_image.hpp"
#include "run/staged_run.hpp"

namespace bitshade {

/// A Technique is a template over the number, made of a configuration and its storage, with
///
///   channels()                       of a texel
///   begin(layer)                     before a layer is generated
///   fill(depth map, y, row, keep)    row y of a map; keep(row) stores it where it is native
///   light(values, t)                 of `channels` filtered values, at a receiver's depth in [0,1]
///   shading(values, t)               the same as plain numbers, for an arithmetic of its own
template <class T, template <class> class Technique>
class staged_base {
 public:
  explicit staged_base(const staged_run& run)
      : scene_(run.scene),
        how_(run.how),
        choices_(run.choices),
        storage_(run.storage),
        look_(run.look),
        fraction_bits_(run.fraction_bits),
        threads_(run.threads),
        native_(run.how, run.storage),
        exact_(run.how, run.storage) {
    if (choices_.shading) shade_ = shading_in(*choices_.shading);
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

 protected:
  void begin(const interval& layer) {
    native_.begin(layer);
    exact_.begin(layer);
  }
  bool has(stage s) const { return choices_.in_format.has(s); }
  int channels() const { return native_.channels(); }

  /// The light of values that the stage before shading left native or exact.
  staged_exact light_of(std::vector<T> native, std::vector<staged_exact> exact,
                        const receiver& r) const {
    if (has(stage::filter)) {
      exact.clear();
      for (const T& v : native) exact.push_back(staged_value<staged_exact>(v));
    } else {
      native.clear();
      for (const staged_exact& v : exact) native.push_back(staged_value<T>(v));
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

  const frame& scene_;
  const configuration& how_;
  const stage_choices& choices_;
  const storage_format& storage_;
  const lookup look_;
  const int fraction_bits_;
  const int threads_;

 private:
  Technique<T> native_;
  Technique<staged_exact> exact_;
  shading_function shade_ = nullptr;
};

}  // namespace bitshade
