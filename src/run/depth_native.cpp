#include <algorithm>
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

  const stopwatch watch(result.shade_seconds);
  const lookup look{run.how.method == technique::hard ? texel_filter::nearest : run.look.filter,
                    false, 1};
  const kernel blur = run.how.method == technique::hard ? kernel{{1.0}} : blur_of(run.how);
  const std::vector<T> weights(blur.weights.begin(), blur.weights.end());
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const auto at = plain_taps<T>(look, static_cast<T>(r.u), static_cast<T>(r.v), width, height);
      const T t = clamp_depth(static_cast<T>(r.t));
      const std::span<const T> taps(weights);
      const auto columns = blurred_axis<T>(at.x0, at.x1, at.fx, T(1), taps, width, map_address);
      const auto rows = blurred_axis<T>(at.y0, at.y1, at.fy, T(1), taps, height, map_address);
      const T share = lit_share<T>(columns, rows, [&](int x, int y, std::size_t, std::size_t) {
        return depth.at(x, y) >= t;
      });
      result.visibility[i] = static_cast<double>(std::min(share, T(1)));
    }
  });
}

}  // namespace

void run_depth_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

void run_depth_exact(run_context& run) {
  const stopwatch watch(run.result.shade_seconds);
  run.result.visibility = run.how.method == technique::hard
                              ? hard_exact(run.scene, run.threads)
                              : truth_pcf(run.scene, run.how, run.threads);
}

}  // namespace bitshade
