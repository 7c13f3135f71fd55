#include <limits>
#include <vector>

#include "bitshade/texture/sat.hpp"
#include "io/error.hpp"
#include "run/engines.hpp"
#include "run/map_stages.hpp"
#include "run/parallel.hpp"
#include "run/summed_area_tables.hpp"
#include "run/variance.hpp"

namespace bitshade {

namespace {

/// Shades every receiver by `mean`, which gives one channel's mean over a box.
template <class T, class Mean>
void shade(run_context& run, const variance_technique<T>& technique, Mean mean) {
  const stopwatch watch(run.result.shade_seconds);
  const frame& scene = run.scene;
  run.result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 2048, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const auto box = box_of(r, scene.depth.width, scene.depth.height, run.how.smallest_box);
      const T values[2] = {mean(box, 0), mean(box, 1)};
      const T p = technique.light(values, clamp_depth(static_cast<T>(r.t)));
      const auto alpha = static_cast<T>(on_split_grid(run.how.bleeding_reduction));
      run.result.visibility[i] = static_cast<double>(alpha == T(0) ? p : reduce_bleeding(p, alpha));
    }
  });
}

/// Norms and fixed point: sums of codes in wrapping integers, which lose nothing.
template <class T, class Code>
void run_codes(run_context& run, const image<T>& texels, const variance_technique<T>& technique) {
  const encoding& format = run.storage.format;
  image<Code> codes(texels.width, texels.height, 2);
  {
    // Codes are what a device stores: at natural speed, encoding them is part of the map.
    const stopwatch watch(run.natural ? run.result.map_seconds : run.result.emulation_seconds);
    run.result.natural = run.natural;
    for_rows(run.threads, texels.height, [&](int y) {
      encode_row<T, Code>(run.storage, texels.row(y), codes.row(y));
    });
  }
  summed_area<Code> sums;
  {
    const stopwatch watch(run.result.map_seconds);
    sums = running_table(std::move(codes), [](std::span<Code>) {});
  }
  const double unit = decode(format, 1);
  shade(run, technique, [&](const texel_box& box, int c) {
    return static_cast<T>(static_cast<double>(sum_over(sums, box, c)) * unit / box.area());
  });
}

/// Floating point: running sums in the arithmetic, stored after each direction.
template <class T>
void run_sums(run_context& run, image<T> texels, const variance_technique<T>& technique) {
  if (run.how.noise_floor) {
    throw usage_error("the noise of a summed-area table's sums in " + run.how.format +
                      " grows with the map: leave out --noise-floor, or take a format of codes, "
                      "such as unorm16, whose sums lose nothing");
  }
  require_sums_fit(texels.width, texels.height, run.storage, run.how.format);
  summed_area<T> sums;
  double rounding = 0;
  {
    const stopwatch watch(run.result.map_seconds);
    sums = running_table(std::move(texels), [&](std::span<T> row) {
      if (!run.storage.code) return;
      const stopwatch part(rounding);
      round_row(run.storage, row);
    });
  }
  run.result.map_seconds -= rounding;
  run.result.emulation_seconds += rounding;
  shade(run, technique, [&](const texel_box& box, int c) {
    return sum_over(sums, box, c) / static_cast<T>(box.area());
  });
}

template <class T>
void run_in(run_context& run) {
  const image<float>& depth = run.scene.depth;
  variance_technique<T> technique(run.how, run.storage, depth);
  technique.begin({0, 1});
  const encoding& format = run.storage.format;
  // At natural speed the codes of the sums are the store, unless samples are resolved before.
  const bool encoded_at_once =
      run.natural && format.kind != family::binary && run.look.samples == 1;
  const auto pass = [&](auto row, image<T>& out) {
    {
      const stopwatch watch(run.result.map_seconds);
      for_rows(run.threads, out.height, row);
    }
    if (!run.storage.code || encoded_at_once) return;
    const stopwatch watch(run.result.emulation_seconds);
    for_rows(run.threads, out.height, [&](int y) { round_row(run.storage, out.row(y)); });
  };
  const auto fill = [&](const image<float>& map, int y, std::span<T> row) {
    technique.fill(map, y, row);
  };
  image<T> texels = resolved_texels<T>(run.scene, run.look.samples, 2, fill, pass);
  if (format.kind == family::binary) {
    run_sums<T>(run, std::move(texels), technique);
  } else if (format.width <= 16) {
    run_codes<T, std::uint32_t>(run, texels, technique);
  } else {
    run_codes<T, std::uint64_t>(run, texels, technique);
  }
}

}  // namespace

void run_summed_area_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
