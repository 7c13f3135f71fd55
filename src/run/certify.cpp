#include "run/certify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "io/error.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/storage.hpp"
#include "run/variance.hpp"

namespace bitshade {

namespace {

/// Running sums of radii are binary64: a hair more covers their own rounding.
constexpr double up = 1 + 0x1p-40;

/// A level of the map as the format pipeline stored it, and what each value may be off by.
template <class T>
struct level {
  image<T> values;
  image<double> radii;
};

template <class T>
class certified_map {
 public:
  certified_map(const frame& scene, const configuration& how, const storage_format& storage,
                const lookup& look, int threads)
      : scene_(scene),
        how_(how),
        storage_(storage),
        look_(look),
        blur_(blur_of(how)),
        threads_(threads) {}

  /// What the arithmetic alone may add to a moment on its whole way; values are at most 1.
  double arithmetic() const {
    const double taps = static_cast<double>(blur_.weights.size());
    const int levels = look_.mips ? mip_levels(scene_.depth.width, scene_.depth.height) : 0;
    return (8 + 2.1 * taps + 6.1 * levels) * unit * up;
  }

  void generate(const interval& layer) {
    const image<float>& depth = scene_.depth;
    level<T> base{image<T>(depth.width, depth.height, 2),
                  image<double>(depth.width, depth.height, 2)};
    const bool whole = layer.near == 0 && layer.far == 1;
    stored_pass(base, [&](int y) {
      const auto row = base.values.row(y);
      const auto off = base.radii.row(y);
      warp_row<T>(depth.row(y), layer, row, 2);
      square_row<T>(row, 2);
      for (std::size_t i = 0; i < row.size(); i += 2) {
        const double x = static_cast<double>(row[i]);
        off[i] = whole ? 0 : 2.1 * unit * x;  // a difference and a quotient
        off[i + 1] = (2 * x * off[i] + off[i] * off[i] + 1.1 * unit * x * x) * up;
      }
    });
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

  struct moment {
    double value = 0, radius = 0;
  };
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
  static constexpr double unit = sizeof(T) == sizeof(float) ? 0x1p-24 : 0x1p-53;

  /// What `roundings` of the arithmetic may have done to a row of sums of positive numbers.
  void widen(level<T>& to, int y, double roundings) const {
    const auto row = to.values.row(y);
    const auto off = to.radii.row(y);
    for (std::size_t i = 0; i < row.size(); ++i) {
      off[i] = (off[i] + roundings * unit * std::fabs(static_cast<double>(row[i]))) * up;
    }
  }

  /// Makes rows, stores them, and adds to each radius what its store really moved.
  template <class Row>
  void stored_pass(level<T>& to, Row make) const {
    for_rows(threads_, to.values.height, [&](int y) {
      make(y);
      const auto row = to.values.row(y);
      const std::vector<T> before(row.begin(), row.end());
      round_row(storage_, row);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double moved = static_cast<double>(row[i]) - static_cast<double>(before[i]);
        to.radii.row(y)[i] = (to.radii.row(y)[i] + std::fabs(moved)) * up;
      }
    });
  }

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

  const frame& scene_;
  const configuration& how_;
  const storage_format& storage_;
  const lookup look_;
  const kernel blur_;
  const int threads_;
  std::vector<level<T>> chain_;
};

light_interval cut(const light_interval& a, const light_interval& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// All three certificates of one receiver in one layer.
struct three {
  light_interval global, stored, running;
};

three blended(const three& near, const three& far, double share) {
  const auto mix = [&](const light_interval& a, const light_interval& b) {
    return light_interval{std::max(0.0, lerp(a.low, b.low, share) - 0x1p-48),
                          std::min(1.0, lerp(a.high, b.high, share) + 0x1p-48)};
  };
  return {mix(near.global, far.global), mix(near.stored, far.stored),
          mix(near.running, far.running)};
}

void refuse_uncovered(const configuration& how) {
  if (how.method != technique::vsm && how.method != technique::lvsm) {
    throw usage_error("certificates are derived for vsm and lvsm, not for " +
                      std::string(name_of(how.method)));
  }
  if (how.exact())
    throw usage_error("exact arithmetic needs no certificate: name a format, such as unorm16");
  if (how.lookup != layer_lookup::own || how.direct_index || how.slope_term || how.noise_floor ||
      how.powered() || how.second != second_moment::square ||
      how.warping != layer_warp::clamped) {
    throw usage_error(
        "certificates are derived for one clamped layer a receiver and the plain square: leave "
        "out --lookup, --direct-index, --layer-warp, --slope-term, --noise-floor, "
        "--bleeding-power and --second-moment");
  }
  if (how.filtered.msaa > 1 || how.filtered.lookups > 1 ||
      how.filtered.way != blur_way::separable || how.filtered.shape != blur_shape::gaussian) {
    throw usage_error(
        "certificates are derived for a separable Gaussian and one lookup a light: leave out "
        "--msaa, --lookups, --blur-way and --blur-shape");
  }
}

/// The largest error of a moment after the format's roundings; moments lie in [0,1].
double store_error(const storage_format& storage, int roundings) {
  const encoding& f = storage.format;
  const double step = f.kind == family::binary
                          ? 1.0 / static_cast<double>(std::uint64_t{2} << f.fraction_bits)
                          : decode(f, 1);
  return moment_error(step, roundings) * bitshade::detail::outward;
}

template <class T>
void run_in(const frame& scene, const configuration& how, const storage_format& storage,
            const lookup& look, const layer_table& layers, int threads, certificates& out) {
  certified_map<T> map(scene, how, storage, look, threads);
  const double e = (store_error(storage, out.roundings) + map.arithmetic()) * up;
  const double noise = variance_error(e, 1.0).width() * up;
  std::vector<three> waiting(layers.blends.empty() ? 0 : scene.receivers.size());
  const auto finish = [&](std::uint32_t at, const three& p) {
    const double alpha = on_split_grid(how.bleeding_reduction);
    const auto reduced = [&](const light_interval& i) {
      if (alpha == 0) return i;
      return light_interval{std::max(0.0, reduce_bleeding(i.low, alpha) - 0x1p-48),
                            std::min(1.0, reduce_bleeding(i.high, alpha) + 0x1p-48)};
    };
    out.global[at] = reduced(p.global);
    out.stored[at] = reduced(p.stored);
    out.running[at] = reduced(p.running);
  };
  for (std::size_t i = 0; i < layers.intervals.size(); ++i) {
    const auto& users = layers.users[i];
    if (users.empty()) continue;
    const interval layer = layers.intervals[i];
    map.generate(layer);
    const auto floor = layer_floor<double>(how.min_variance, layer);
    const double bound = floor > 0 ? visibility_error(noise, e, floor) : 1;
    for_ranges(threads, users.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::uint32_t at = users[k];
        const receiver& r = scene.receivers[at];
        const auto m1 = map.filtered(r, 0), m2 = map.filtered(r, 1);
        const double t = warp(clamp_depth(static_cast<double>(r.t)), layer);
        const auto here = light_of_box(m1.value, 0x1p-46, m2.value, 0x1p-46, t, floor);
        three p;
        p.global = {std::max(0.0, here.low - bound), std::min(1.0, here.high + bound)};
        p.stored =
            cut(p.global, light_of_box(m1.value, e + 0x1p-46, m2.value, e + 0x1p-46, t, floor));
        p.running = cut(p.stored, light_of_box(m1.value, m1.radius, m2.value, m2.radius, t, floor));
        if (layers.blends.empty() || layers.blends[at].near == layers.blends[at].far) {
          finish(at, p);
        } else if (static_cast<int>(i) == layers.blends[at].near) {
          waiting[at] = p;
        } else {
          const double split = layers.splits[static_cast<std::size_t>(layers.blends[at].far)];
          finish(at, blended(waiting[at], p,
                             transition_share(static_cast<double>(r.t), split, how.overlap)));
        }
      }
    });
  }
}

}  // namespace

certificates certify(const frame& scene, const configuration& how, int threads) {
  const default_float_environment environment;
  refuse_uncovered(how);
  const plan effects = make_plan(scene, how, threads);
  const layer_table layers = layers_of(scene, how, effects);
  storage_format storage = storage_named(how.format);
  certificates out;
  out.roundings = roundings_of(how, scene.depth);
  const double none = std::numeric_limits<double>::quiet_NaN();
  out.global.assign(scene.receivers.size(), {none, none});
  out.stored = out.running = out.global;
  const lookup look = lookup_of(how, effects);
  storage.wide ? run_in<double>(scene, how, storage, look, layers, threads, out)
               : run_in<float>(scene, how, storage, look, layers, threads, out);
  return out;
}

}  // namespace bitshade
