#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <vector>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/pcf.hpp"
#include "run/engines.hpp"
#include "run/natural_texels.hpp"
#include "run/parallel.hpp"

namespace bitshade {

namespace {

/// The kernel that a technique filters answers with; the hard test has none.
std::vector<double> weights_of(const run_context& run) {
  return run.how.method == technique::hard ? std::vector<double>{1.0} : blur_of(run.how).weights;
}

/// Hard test and percentage-closer filtering of stored depths: one map, or one a sample.
///
/// Reads has begin(columns, rows), which is told the footprint, and at(x, y, i, j), the depth of
/// entry i of its columns and j of its rows.
template <class T, class Reads>
void shade(run_context& run, const std::vector<Reads>& maps) {
  const frame& scene = run.scene;
  cell& result = run.result;
  const int width = scene.depth.width, height = scene.depth.height;
  const stopwatch watch(result.shade_seconds);
  const bool hard = run.how.method == technique::hard;
  const lookup look{hard ? texel_filter::nearest : run.look.filter};
  const int lookups = hard ? 1 : run.how.filtered.lookups;
  const std::vector<double> blur = weights_of(run);
  const std::vector<T> weights(blur.begin(), blur.end());
  const auto bias = static_cast<T>(on_split_grid(run.how.depth_bias));
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 1024, [&](std::size_t first, std::size_t last) {
    std::vector<Reads> samples = maps;
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const T t = clamp_depth(static_cast<T>(r.t)) - bias;
      const std::span<const T> taps(weights);
      T sum = T(0);
      each_lookup(r, lookups, width, height, [&](const receiver& there) {
        const auto at =
            plain_taps<T>(look, static_cast<T>(there.u), static_cast<T>(there.v), width, height);
        const auto columns = blurred_axis<T>(at.x0, at.x1, at.fx, T(1), taps, width, map_address);
        const auto rows = blurred_axis<T>(at.y0, at.y1, at.fy, T(1), taps, height, map_address);
        std::array<T, 8> part{};
        for (std::size_t s = 0; s < samples.size(); ++s) {
          Reads& depths = samples[s];
          depths.begin(columns, rows);
          part[s] = lit_share<T>(columns, rows, [&](int x, int y, std::size_t k, std::size_t j) {
            return depths.at(x, y, k, j) >= t;
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

/// Depths as numbers of T.
template <class T>
struct plain_depths {
  const image<T>* depth;
  void begin(const axis_footprint<T>&, const axis_footprint<T>&) {}
  T at(int x, int y, std::size_t, std::size_t) const { return depth->at(x, y); }
};

/// Depths as their format's bits: a footprint is loaded at once.
struct natural_depths {
  const natural_texels* texels;
  std::vector<std::uint32_t> read = {};
  std::vector<float> loaded = {};
  std::size_t columns = 0;

  void begin(const axis_footprint<float>& x, const axis_footprint<float>& y) {
    columns = x.count;
    read.clear();
    for (std::size_t j = 0; j < y.count; ++j)
      for (std::size_t i = 0; i < x.count; ++i)
        read.push_back(static_cast<std::uint32_t>(y.index[j]) *
                           static_cast<std::uint32_t>(texels->width()) +
                       static_cast<std::uint32_t>(x.index[i]));
    loaded.resize(read.size());
    texels->load(read, loaded);
  }
  float at(int, int, std::size_t i, std::size_t j) const { return loaded[j * columns + i]; }
};

/// Each map of the run, its rows put by store(map, y, row).
template <class T, class Store>
void make_maps(run_context& run, const std::vector<const image<float>*>& maps, Store store) {
  const stopwatch watch(run.result.map_seconds);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    for_ranges(run.threads, static_cast<std::size_t>(maps[i]->height), 8, [&](auto first, auto last) {
      std::vector<T> row(static_cast<std::size_t>(maps[i]->width));
      for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
        warp_row<T>(maps[i]->row(y), interval{0, 1}, std::span<T>(row), 1);
        store(i, y, std::span<const T>(row));
      }
    });
  }
}

void run_naturally(run_context& run, const std::vector<const image<float>*>& maps) {
  std::vector<natural_texels> texels;
  for (const image<float>* map : maps)
    texels.emplace_back(run.storage, map->width, map->height, 1);
  run.result.natural = true;
  make_maps<float>(run, maps, [&](std::size_t i, int y, std::span<const float> row) {
    texels[i].store(y, row);
  });
  std::vector<natural_depths> reads;
  for (const natural_texels& map : texels) reads.push_back({&map});
  shade<float>(run, reads);
}

template <class T>
void run_in(run_context& run) {
  const auto maps =
      depth_maps(run.scene, run.how.method == technique::hard ? 1 : run.look.samples);
  if constexpr (std::is_same_v<T, float>)
    if (run.natural && natural_texels::can_hold(run.storage)) return run_naturally(run, maps);
  std::vector<image<T>> depths;
  for (const image<float>* map : maps) depths.emplace_back(map->width, map->height);
  make_maps<T>(run, maps, [&](std::size_t i, int y, std::span<const T> row) {
    std::copy(row.begin(), row.end(), depths[i].row(y).begin());
  });
  if (run.storage.code) {
    const stopwatch watch(run.result.emulation_seconds);
    for (image<T>& map : depths)
      for_rows(run.threads, map.height, [&](int y) { round_row(run.storage, map.row(y)); });
  }
  std::vector<plain_depths<T>> reads;
  for (const image<T>& map : depths) reads.push_back({&map});
  shade<T>(run, reads);
}

}  // namespace

void run_depth_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

void run_depth_exact(run_context& run) {
  const stopwatch watch(run.result.shade_seconds);
  if (run.how.method == technique::hard) {
    run.result.visibility = hard_exact(run.scene, run.how.depth_bias, run.threads);
    return;
  }
  configuration kernel = run.how;
  if (!takes_samples(kernel.method)) kernel.filtered.msaa = kernel.filtered.lookups = 1;
  // Depths are compared, not averaged: they have no mips, and one probe a lookup.
  if (kernel.filter == texel_filter::trilinear) kernel.filter = texel_filter::bilinear;
  kernel.max_anisotropy = 1;
  run.result.visibility = pcf_exact(run.scene, kernel, run.threads);
}

}  // namespace bitshade
