#include "run/device_cost.hpp"

#include <algorithm>
#include <bit>

#include "run/lookup.hpp"
#include "run/storage.hpp"

namespace bitshade {

namespace {

/// Passes over a map, and the bytes that they read and write.
struct work {
  int passes = 0;
  double bytes = 0;
};

/// Filtered reads of one lookup, and the texels that each touches.
struct reads {
  double fetches = 1, texels = 4;
};

/// What happens to a layer's texels of `layer` bytes between its first pass and its use.
work filtering_of(const configuration& how, const lookup& look, const frame& scene, double layer) {
  const double texels = static_cast<double>(scene.depth.texels.size());
  work w;
  if (look.samples > 1 && how.method != technique::pcf)
    w.passes += 1, w.bytes += (look.samples + 1) * texels * layer;
  if (how.blurred() && blurs_its_map(how.method)) {
    const int directions = how.filtered.way == blur_way::one_pass ? 1 : 2;
    w.passes += directions, w.bytes += directions * 2 * texels * layer;
  }
  if (how.method == technique::savsm) w.passes += 2, w.bytes += 2 * 2 * texels * layer;
  if (look.mips) {
    w.passes += mip_levels(scene.depth.width, scene.depth.height) - 1;
    w.bytes += (1 + 1.0 / 3 + 1.0 / 3) * texels * layer;
  }
  return w;
}

/// Mean number of probes and of mip levels that a filtered read of a receiver spans.
reads probes_and_levels(const frame& scene, const lookup& look) {
  if (look.filter == texel_filter::nearest) return {1, 1};
  if (look.plain()) return {};
  double probes = 0, levels = 0, receivers = 0;
  const int count = mip_levels(scene.depth.width, scene.depth.height);
  for (const receiver& r : scene.receivers) {
    if (!has_receiver(r)) continue;
    const auto set = probes_of(r, scene.depth.width, scene.depth.height, look.max_anisotropy);
    const auto blend = blend_levels(set.lambda, look.mips ? count : 1, map_mip_bits);
    receivers += 1;
    probes += static_cast<double>(set.offsets.size());
    levels += static_cast<double>(set.offsets.size()) * (blend.fraction == 0 ? 1 : 2);
  }
  return receivers == 0 ? reads{} : reads{probes / receivers, 4 * levels / probes};
}

/// The reads of one lookup in one layer, whose texel takes `layer` bytes.
reads reads_of(const frame& scene, const configuration& how, const lookup& look, double layer) {
  if (how.method == technique::hard) return {1, 1};
  if (how.method == technique::savsm) return {4, 1};  // the corners of a box
  if (how.method == technique::pcf) {
    const double side = (how.blurred() ? how.blur_taps : 1) + 1;
    return {look.samples * side * side / 4, 4};
  }
  if (how.method == technique::deep) {
    // A binary search among the steps of each of four functions, and the share it finds.
    const double step = 2.0 * storage_named(how.format).bits / 8;
    const auto steps = static_cast<unsigned>(std::max(1.0, layer / step));
    return {4.0 * (std::bit_width(steps) + 1), 1};
  }
  reads r = probes_and_levels(scene, look);
  r.fetches *= (how.channels() + 3) / 4;
  return r;
}

/// Bytes of what one texel of a fetch holds: four channels at most, one step of a function.
double fetched_bytes(const configuration& how, double layer) {
  if (how.method == technique::deep) return storage_named(how.format).bits / 8.0;
  return layer / ((how.channels() + 3) / 4);
}

}  // namespace

device_cost device_cost_of(const frame& scene, const configuration& how, const plan& effects,
                           int bytes_per_texel) {
  const auto table = layers_of(scene, how, effects);
  const lookup look = lookup_of(how, effects);
  const double texels = static_cast<double>(scene.depth.texels.size());
  const double layers = static_cast<double>(table.intervals.size());
  const double layer = static_cast<double>(bytes_per_texel) / layers;
  double used = 0, lookups = 0, samples = 0;
  for (const auto& users : table.users)
    used += users.empty() ? 0 : 1, lookups += static_cast<double>(users.size());
  for (const int own : table.own) samples += own >= 0 ? 1 : 0;
  if (how.exact() || samples == 0) return {};
  if (averages_lookups(how.method)) lookups *= how.filtered.lookups * how.filtered.lookups;

  // What compares depths uses the map that the depth pass writes; the others read it once a layer,
  // or once for all, and write their own.
  const int of_texel = takes_samples(how.method) ? look.samples : 1;
  const bool depths = how.method == technique::hard || how.method == technique::pcf;
  const bool together = how.method == technique::lvsm && how.one_pass && look.samples == 1;
  const double fills = together ? 1 : used, written = together ? layers : used;
  const work filters = filtering_of(how, look, scene, layer);
  const reads each = reads_of(scene, how, look, layer);

  device_cost cost;
  cost.passes = static_cast<int>(fills + used * filters.passes);
  cost.fetches_per_sample = each.fetches * lookups / samples;
  cost.bytes_per_frame = of_texel * texels * ((depths ? 0 : 4 * fills) + written * layer) +
                         used * filters.bytes +
                         samples * cost.fetches_per_sample * each.texels * fetched_bytes(how, layer);
  return cost;
}

}  // namespace bitshade
