// Techniques at the natural speed of their storage: what a device with that format would do, and
// nothing that emulation adds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitshade/shadow/moments.hpp"
#include "run/engines.hpp"
#include "run/natural_texels.hpp"
#include "run/parallel.hpp"

namespace bitshade {

/// Whether a run asks for natural speed, and has a natural path: a storage that memory holds as it
/// is, one plain lookup of the receiver's own layer, no blend.
bool runs_naturally(const run_context& run);

/// A light as the picture shows it, after bleeding reduction.
double finished_light(const configuration& how, float light);

/// Runs a technique (native.hpp says what it has), and gives the bits of native_engine.
template <class Technique>
void run_natural(run_context& run, Technique technique) {
  const frame& scene = run.scene;
  const image<float>& depth = scene.depth;
  cell& result = run.result;
  const auto channels = static_cast<std::size_t>(technique.channels());
  const kernel weights = blur_of(run.how);
  result.natural = true;
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  natural_texels texels(run.storage, depth.width, depth.height, technique.channels());

  const auto generate = [&] {
    const stopwatch watch(result.map_seconds);
    for_ranges(run.threads, static_cast<std::size_t>(depth.height), 8, [&](auto first, auto last) {
      std::vector<float> row(static_cast<std::size_t>(depth.width) * channels);
      for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
        technique.fill(depth, y, std::span<float>(row));
        texels.store(y, row);
      }
    });
    texels.blur(weights, run.threads);
  };

  // Receivers are shaded in blocks, so that their texels are decoded side by side.
  constexpr std::size_t block = 256;
  const auto shade = [&](std::span<const std::uint32_t> users) {
    const stopwatch watch(result.shade_seconds);
    for_ranges(run.threads, users.size(), 2048, [&](std::size_t first, std::size_t last) {
      std::vector<bilinear_taps<float>> taps(block);
      std::vector<std::uint32_t> read(4 * block);
      std::vector<float> loaded(4 * block * channels), values(channels);
      for (std::size_t begin = first; begin < last; begin += block) {
        const std::size_t count = std::min(block, last - begin);
        for (std::size_t k = 0; k < count; ++k) {
          const receiver& r = scene.receivers[users[begin + k]];
          const auto at = plain_taps<float>(run.look, r.u, r.v, depth.width, depth.height);
          const auto texel = [&](int x, int y) {
            return static_cast<std::uint32_t>(depth.offset(x, y));
          };
          taps[k] = at;
          read[4 * k] = texel(at.x0, at.y0), read[4 * k + 1] = texel(at.x1, at.y0);
          read[4 * k + 2] = texel(at.x0, at.y1), read[4 * k + 3] = texel(at.x1, at.y1);
        }
        texels.load(std::span(read).first(4 * count),
                    std::span(loaded).first(4 * count * channels));
        for (std::size_t k = 0; k < count; ++k) {
          const float* corner = loaded.data() + 4 * k * channels;
          for (std::size_t c = 0; c < channels; ++c, ++corner) {
            const float upper = lerp(corner[0], corner[channels], taps[k].fx);
            const float lower = lerp(corner[2 * channels], corner[3 * channels], taps[k].fx);
            values[c] = lerp(upper, lower, taps[k].fy);
          }
          const std::uint32_t user = users[begin + k];
          const float light =
              technique.light(std::span<const float>(values), clamp_depth(scene.receivers[user].t));
          result.visibility[user] = finished_light(run.how, light);
        }
      }
    });
  };

  for (std::size_t i = 0; i < run.layers.intervals.size(); ++i) {
    if (run.layers.users[i].empty()) continue;
    technique.begin(run.layers.intervals[i]);
    generate();
    shade(run.layers.users[i]);
  }
}

}  // namespace bitshade
