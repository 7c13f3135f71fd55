#include <algorithm>
#include <array>
#include <limits>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/pcf.hpp"
#include "run/engines.hpp"
#include "run/parallel.hpp"

namespace bitshade {

namespace {

/// Hard test and percentage-closer filtering of depths stored in a format.
template <class T>
void run_in(run_context& run) {
  const frame& scene = run.scene;
  cell& result = run.result;
  const int width = scene.depth.width, height = scene.depth.height;
  const bool hard = run.how.method == technique::hard;
  std::vector<image<T>> samples;
  for (const image<float>* map : depth_maps(scene, hard ? 1 : run.look.samples)) {
    image<T>& depth = samples.emplace_back(width, height);
    {
      const stopwatch watch(result.map_seconds);
      for_rows(run.threads, height, [&](int y) {
        warp_row<T>(map->row(y), interval{0, 1}, depth.row(y), 1);
      });
    }
    if (!run.storage.code) continue;
    const stopwatch watch(result.emulation_seconds);
    for_rows(run.threads, height, [&](int y) { round_row(run.storage, depth.row(y)); });
  }

  const stopwatch watch(result.shade_seconds);
  const lookup look{hard ? texel_filter::nearest : run.look.filter};
  const int lookups = hard ? 1 : run.how.filtered.lookups;
  const kernel blur = hard ? kernel{{1.0}} : blur_of(run.how);
  const std::vector<T> weights(blur.weights.begin(), blur.weights.end());
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const T t = clamp_depth(static_cast<T>(r.t));
      const std::span<const T> taps(weights);
      T sum = T(0);
      each_lookup(r, lookups, width, height, [&](const receiver& there) {
        const auto at =
            plain_taps<T>(look, static_cast<T>(there.u), static_cast<T>(there.v), width, height);
        const auto columns = blurred_axis<T>(at.x0, at.x1, at.fx, T(1), taps, width, map_address);
        const auto rows = blurred_axis<T>(at.y0, at.y1, at.fy, T(1), taps, height, map_address);
        std::array<T, 8> part{};
        for (std::size_t s = 0; s < samples.size(); ++s) {
          part[s] = lit_share<T>(columns, rows, [&](int x, int y, std::size_t, std::size_t) {
            return samples[s].at(x, y) >= t;
          });
        }
        // In pairs, as the resolve of a map: equal samples give themselves.
        for (std::size_t left = samples.size() / 2; left > 0; left /= 2) {
          for (std::size_t s = 0; s < left; ++s) part[s] = part[2 * s] + part[2 * s + 1];
        }
        sum = sum + part[0] / static_cast<T>(static_cast<int>(samples.size()));
      });
      result.visibility[i] =
          static_cast<double>(std::min(sum / static_cast<T>(lookups * lookups), T(1)));
    }
  });
}

}  // namespace

void run_depth_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

void run_depth_exact(run_context& run) {
  const stopwatch watch(run.result.shade_seconds);
  if (run.how.method == technique::hard) {
    run.result.visibility = hard_exact(run.scene, run.threads);
    return;
  }
  configuration kernel = run.how;
  if (!takes_samples(kernel.method)) kernel.filtered.msaa = kernel.filtered.lookups = 1;
  run.result.visibility = truth_pcf(run.scene, kernel, run.threads);
}

}  // namespace bitshade
