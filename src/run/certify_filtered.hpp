// Maps that are filtered as they are, with radii: blurs, mips and lookups.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/certify_texels.hpp"

namespace bitshade::certified {

template <class T>
class filtered_map : public texel_maker<T> {
  using parts = texel_maker<T>;
  using parts::scene_, parts::stored_pass, parts::unit, parts::widen;

 public:
  filtered_map(const frame& scene, const configuration& how, const storage_format& storage,
               const lookup& look, int threads)
      : parts(scene, storage, threads), look_(look), blur_(blur_of(how)) {}

  /// What the arithmetic alone may add to a moment on its whole way; values are at most 1.
  double arithmetic(const receiver&) const {
    const double taps = static_cast<double>(blur_.weights.size());
    const int levels = look_.mips ? mip_levels(scene_.depth.width, scene_.depth.height) : 0;
    return (8 + 2.1 * taps + 6.1 * levels) * unit * up;
  }

  void generate(const interval& layer) {
    const image<float>& depth = scene_.depth;
    level<T> base = this->texels(layer);
    if (blur_.weights.size() > 1) {
      base = blurred(base, [&](const auto& in, int y, auto row) {
        using V = typename decltype(row)::value_type;
        blur_row_x<V>(in, blur_, map_address, y, row);
      });
      base = blurred(base, [&](const auto& in, int y, auto row) {
        using V = typename decltype(row)::value_type;
        blur_row_y<V>(in, blur_, map_address, y, row);
      });
    }
    chain_.clear();
    chain_.push_back(std::move(base));
    const int levels = look_.mips ? mip_levels(depth.width, depth.height) : 1;
    for (int l = 1; l < levels; ++l) {
      const level<T>& from = chain_.back();
      const int w = mip_size(depth.width, l), h = mip_size(depth.height, l);
      level<T> next{image<T>(w, h, 2), image<double>(w, h, 2)};
      stored_pass(next, [&](int y) {
        downsample_row<T>(from.values, map_mips, y, next.values.row(y));
        downsample_row<double>(from.radii, map_mips, y, next.radii.row(y));
        widen(next, y, 6.1);
      });
      chain_.push_back(std::move(next));
    }
  }

  /// The lookup at its exact place: binary64 holds the coordinates, and its sums err by 2^-46.
  moment filtered(const receiver& r, int channel) const {
    moment sum;
    const auto at_level = [&](int l, double u, double v, texel_filter filter) {
      const level<T>& in = chain_[static_cast<std::size_t>(l)];
      lookup one = look_;
      one.filter = filter;
      const auto at = plain_taps<double>(one, u, v, in.values.width, in.values.height);
      const auto mixed = [&](const auto& texels) {
        const auto value = [&](int x, int y) {
          return static_cast<double>(texels.at(x, y, channel));
        };
        return lerp(lerp(value(at.x0, at.y0), value(at.x1, at.y0), at.fx),
                    lerp(value(at.x0, at.y1), value(at.x1, at.y1), at.fx), at.fy);
      };
      return moment{mixed(in.values), mixed(in.radii)};
    };
    if (look_.plain()) {
      sum = at_level(0, r.u, r.v, look_.filter);
    } else {
      const auto probes =
          probes_of(r, scene_.depth.width, scene_.depth.height, look_.max_anisotropy);
      const auto blend = blend_levels(probes.lambda, static_cast<int>(chain_.size()), map_mip_bits);
      for (const auto& p : probes.offsets) {
        const double u = static_cast<double>(r.u) + p.du, v = static_cast<double>(r.v) + p.dv;
        const moment near = at_level(blend.near, u, v, texel_filter::bilinear);
        const moment far =
            blend.fraction == 0 ? near : at_level(blend.far, u, v, texel_filter::bilinear);
        sum.value += lerp(near.value, far.value, blend.fraction);
        sum.radius += lerp(near.radius, far.radius, blend.fraction);
      }
      const auto n = static_cast<double>(probes.offsets.size());
      sum = {sum.value / n, sum.radius / n};
    }
    return {sum.value, sum.radius * up + 0x1p-46};
  }

 private:
  template <class Row>
  level<T> blurred(const level<T>& from, Row pass) const {
    level<T> to{image<T>(from.values.width, from.values.height, 2),
                image<double>(from.values.width, from.values.height, 2)};
    stored_pass(to, [&](int y) {
      pass(from.values, y, to.values.row(y));
      pass(from.radii, y, to.radii.row(y));
      widen(to, y, 1.01 * static_cast<double>(blur_.weights.size()));
    });
    return to;
  }

  const lookup look_;
  const kernel blur_;
  std::vector<level<T>> chain_;
};

}  // namespace bitshade::certified
