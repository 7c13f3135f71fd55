// Deep shadow maps: each texel stores the visibility of its blurred neighbourhood as a function of
// depth, a step at each depth in it, and lookups interpolate the functions. [LokovicVeach00]
#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/pcf.hpp"
#include "run/engines.hpp"
#include "run/parallel.hpp"

namespace bitshade {

namespace {

/// The steps of a texel's function: the distinct depths that its kernel reaches.
template <class T>
std::size_t steps_at(const image<T>& depth, int x, int y, int radius) {
  std::vector<T> seen;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      seen.push_back(
          depth.at(wrap(x + i, depth.width, map_address), wrap(y + j, depth.height, map_address)));
    }
  }
  std::sort(seen.begin(), seen.end());
  return static_cast<std::size_t>(std::unique(seen.begin(), seen.end()) - seen.begin());
}

/// The mean number of steps, over every 64th texel: what an uncompressed map takes.
template <class T>
double mean_steps(const image<T>& depth, int radius) {
  std::size_t texels = 0, steps = 0;
  for (int y = 0; y < depth.height; y += 8) {
    for (int x = 0; x < depth.width; x += 8) {
      ++texels;
      steps += steps_at(depth, x, y, radius);
    }
  }
  return static_cast<double>(steps) / static_cast<double>(texels);
}

/// Depths and shares of the functions are both stored in the format; a function is evaluated where
/// a receiver reads it, which gives the bits of a map of functions without holding one.
template <class T>
void run_in(run_context& run) {
  const frame& scene = run.scene;
  cell& result = run.result;
  const int width = scene.depth.width, height = scene.depth.height;
  image<T> depth(width, height);
  {
    const stopwatch watch(result.map_seconds);
    for_rows(run.threads, height, [&](int y) {
      warp_row<T>(scene.depth.row(y), interval{0, 1}, depth.row(y), 1);
    });
  }
  if (run.storage.code) {
    const stopwatch watch(result.emulation_seconds);
    for_rows(run.threads, height, [&](int y) { round_row(run.storage, depth.row(y)); });
  }
  const kernel blur = blur_of(run.how);
  const std::vector<T> weights(blur.weights.begin(), blur.weights.end());
  const auto bias = static_cast<T>(on_split_grid(run.how.depth_bias));
  result.bytes_per_texel =
      static_cast<int>(mean_steps(depth, blur.radius()) * 2 * run.storage.bits / 8 + 1);

  const stopwatch watch(result.shade_seconds);
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const lookup look{run.look.filter, false, 1};
      const auto at = plain_taps<T>(look, static_cast<T>(r.u), static_cast<T>(r.v), width, height);
      const T t = clamp_depth(static_cast<T>(r.t)) - bias;
      const auto value = [&](int x, int y) {
        const std::span<const T> taps(weights);
        const auto columns = blurred_axis<T>(x, x, T(0), T(1), taps, width, map_address);
        const auto rows = blurred_axis<T>(y, y, T(0), T(1), taps, height, map_address);
        return std::min(lit_share<T>(columns, rows,
                                     [&](int a, int b, std::size_t, std::size_t) {
                                       return depth.at(a, b) >= t;
                                     }),
                        T(1));
      };
      T share[4] = {value(at.x0, at.y0), value(at.x1, at.y0), value(at.x0, at.y1),
                    value(at.x1, at.y1)};
      round_row(run.storage, std::span<T>(share));
      const T near = lerp(share[0], share[1], at.fx), far = lerp(share[2], share[3], at.fx);
      result.visibility[i] = static_cast<double>(lerp(near, far, at.fy));
    }
  });
}

}  // namespace

void run_deep_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
