#include "run/device_cost.hpp"

#include <algorithm>

#include "run/lookup.hpp"

namespace bitshade {

namespace {

/// Mean number of probes and of mip levels that a filtered read of a receiver spans.
struct reads {
  double probes = 1, levels = 1;
};

reads reads_of(const frame& scene, const lookup& look) {
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
  return receivers == 0 ? reads{} : reads{probes / receivers, levels / receivers};
}

}  // namespace

device_cost device_cost_of(const frame& scene, const configuration& how, const plan& effects,
                           int bytes_per_texel) {
  const auto table = layers_of(scene, how, effects);
  const lookup look = lookup_of(how, effects);
  const double texels =
      static_cast<double>(scene.depth.width) * static_cast<double>(scene.depth.height);
  double used = 0, lookups = 0, samples = 0;
  for (const auto& users : table.users)
    used += users.empty() ? 0 : 1, lookups += static_cast<double>(users.size());
  for (const int own : table.own) samples += own >= 0 ? 1 : 0;
  const double layer_bytes =
      static_cast<double>(bytes_per_texel) / static_cast<double>(table.intervals.size());
  const double textures = (how.channels() + 3) / 4;

  device_cost cost;
  double per_lookup = textures, passes = 1, texels_read = 4;
  double traffic = texels * 4 + texels * layer_bytes;  // the depth map is read, a layer written
  if (how.method == technique::hard) {
    traffic = texels * layer_bytes;  // the map is what the depth pass writes
    texels_read = 1;
  } else if (how.method == technique::pcf) {
    traffic = texels * layer_bytes;
    const double side = (how.blurred() ? how.blur_taps : 1) + 1;
    per_lookup = side * side / 4;
  } else if (how.method == technique::savsm) {
    passes += 2;
    traffic += 2 * 2 * texels * layer_bytes;
    per_lookup = 4;  // the corners of a box
    texels_read = 1;
  } else {
    if (how.blurred()) passes += 2, traffic += 2 * 2 * texels * layer_bytes;
    if (look.mips) {
      passes += mip_levels(scene.depth.width, scene.depth.height) - 1;
      traffic += (1 + 1.0 / 3) * texels * layer_bytes + texels * layer_bytes / 3;
    }
    const reads r = reads_of(scene, look);
    per_lookup *= r.probes;
    texels_read *= r.levels / r.probes;
    if (look.filter == texel_filter::nearest) texels_read = 1;
  }
  const double per_sample = samples == 0 ? 0 : lookups / samples;
  cost.passes = static_cast<int>(passes * used);
  cost.fetches_per_sample = per_lookup * per_sample;
  const double sample_bytes =
      how.method == technique::pcf ? layer_bytes : layer_bytes / textures;  // a texel of a fetch
  cost.bytes_per_frame =
      traffic * used + samples * cost.fetches_per_sample * texels_read * sample_bytes;
  return cost;
}

}  // namespace bitshade
