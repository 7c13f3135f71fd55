#include "run/certify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "io/error.hpp"
#include "run/certify_filtered.hpp"
#include "run/certify_sums.hpp"
#include "run/variance.hpp"

namespace bitshade {

namespace {

using certified::up;

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
  if (!stores_variance(how.method)) {
    throw usage_error("certificates are derived for vsm, savsm and lvsm, not for " +
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
  const filtering& f = how.filtered;
  if (f.msaa > 1 || (blurs_its_map(how.method) && (f.lookups > 1 || f.way != blur_way::separable ||
                                                   f.shape != blur_shape::gaussian))) {
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

/// Map: filtered_map or summed_map in the arithmetic.
template <class Map>
void run_in(const frame& scene, const configuration& how, const storage_format& storage,
            const lookup& look, const layer_table& layers, int threads, certificates& out) {
  Map map(scene, how, storage, look, threads);
  const double stored = store_error(storage, out.roundings);
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
    for_ranges(threads, users.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::uint32_t at = users[k];
        const receiver& r = scene.receivers[at];
        const double e = (stored + map.arithmetic(r)) * up;
        const double noise = variance_error(e, 1.0).width() * up;
        const double bound = floor > 0 ? visibility_error(noise, e, floor) : 1;
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
  const auto run = [&]<class T>(T) {
    if (how.method == technique::savsm) {
      run_in<certified::summed_map<T>>(scene, how, storage, look, layers, threads, out);
    } else {
      run_in<certified::filtered_map<T>>(scene, how, storage, look, layers, threads, out);
    }
  };
  storage.wide ? run(double{}) : run(float{});
  return out;
}

}  // namespace bitshade
