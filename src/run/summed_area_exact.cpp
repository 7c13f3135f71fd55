#include <bit>
#include <limits>

#include "bitshade/arithmetic/wide.hpp"
#include "run/engines.hpp"
#include "run/exact_grid.hpp"
#include "run/exact_moments.hpp"
#include "run/parallel.hpp"
#include "run/summed_area.hpp"

namespace bitshade {

namespace {

/// Sums over all texels above and to the left, as integers that lose nothing.
template <class T>
image<T> running_sums(const image<T>& in) {
  image<T> sums(in.width + 1, in.height + 1);
  for (int y = 0; y < in.height; ++y) {
    T row{};
    for (int x = 0; x < in.width; ++x) {
      row += in.at(x, y);
      sums.at(x + 1, y + 1) = sums.at(x + 1, y) + row;
    }
  }
  return sums;
}

template <class T>
T sum_over(const image<T>& sums, const texel_box& box) {
  return (sums.at(box.x1, box.y1) + sums.at(box.x0, box.y0)) -
         (sums.at(box.x1, box.y0) + sums.at(box.x0, box.y1));
}

/// Integers of proven width: depths of S - 1 fraction bits, maps of up to 2^31 texels, boxes of 2^16.
///
/// With n texels in a box, everything is taken n times (the variance n^2 times), in the units of
/// exact_moments, 2^-(S + 3) and 2^-(2S + 3):
///   d = n t - sum x,  v = n sum x^2 - (sum x)^2,  floor n^2 sigma_min^2, all scaled by 2^scale
/// so that the floor is an integer, too.
template <int S>
void run_in(run_context& run) {
  constexpr int scale =
      192;  // 1e-60, the smallest floor, is a multiple of 2^-252 <= 2^-(2S + scale)
  constexpr int unit = S + exact_sample_bits;
  using first_int = wide<limbs_for(unit + 1 + 31)>;
  using second_int = wide<limbs_for(2 * unit + 1 + 31)>;
  using light_int = wide<limbs_for(2 * (unit + 1 + 16) + scale + 1)>;
  using moments = exact_moments<S, wide<limbs_for(2 * S + 4)>>;
  const frame& scene = run.scene;
  const int width = scene.depth.width, height = scene.depth.height;
  const moments texels(interval{0, 1});
  const auto maps = depth_maps(scene, run.look.samples);
  image<first_int> sums1;
  image<second_int> sums2;
  {
    const stopwatch watch(run.result.map_seconds);
    image<first_int> x(width, height);
    image<second_int> squares(width, height);
    for_rows(run.threads, height, [&](int y) {
      std::vector<typename moments::depth_int> first(static_cast<std::size_t>(width));
      std::vector<wide<limbs_for(2 * S + 4)>> second(first.size());
      texels.row(maps, y, run.how.slope_term, first, second);
      for (std::size_t i = 0; i < first.size(); ++i) {
        x.row(y)[i] = first_int(first[i]);
        squares.row(y)[i] = narrowed<limbs_for(2 * unit + 1 + 31)>(second[i]) << exact_sample_bits;
      }
    });
    sums1 = running_sums(x);
    sums2 = running_sums(squares);
  }

  constexpr auto limbs = limbs_for(2 * (unit + 1 + 16) + scale + 1);
  light_int floor;
  if (run.how.min_variance > 0) {
    const auto bits = std::bit_cast<std::uint64_t>(run.how.min_variance);
    const std::uint64_t significand = (bits & 0xfffffffffffff) | (std::uint64_t{1} << 52);
    floor = light_int(significand) << (static_cast<int>(bits >> 52) - 1075 + 2 * unit + scale);
  }
  const auto alpha = on_grid(on_split_grid(run.how.bleeding_reduction), 24);
  const stopwatch watch(run.result.shade_seconds);
  run.result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(run.threads, scene.receivers.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const auto box = box_of(r, width, height, run.how.smallest_box);
      const wide<1> n(static_cast<std::uint64_t>(box.area()));
      const light_int sum1 = narrowed<limbs>(sum_over(sums1, box));
      const light_int sum2 = narrowed<limbs>(sum_over(sums2, box));
      const light_int t = narrowed<limbs>(narrowed<limbs>(first_int(texels.inside(r.t)) << exact_sample_bits) * n);
      if (t <= sum1) {
        run.result.visibility[i] = 1;
        continue;
      }
      const light_int d = t - sum1;
      light_int v = (narrowed<limbs>(sum2 * n) - narrowed<limbs>(sum1 * sum1)) << scale;
      const light_int least = narrowed<limbs>(narrowed<limbs>(floor * n) * n);
      if (v < least) v = least;
      const light_int all = v + (narrowed<limbs>(d * d) << scale);
      const auto one = std::uint64_t{1} << 24;
      const auto lit = v * wide<1>(one), lost = all * wide<1>(alpha);
      run.result.visibility[i] =
          lit <= lost ? 0.0 : quotient_to_double(lit - lost, all * wide<1>(one - alpha));
    }
  });
}

}  // namespace

void run_summed_area_exact(run_context& run) {
  depth_bits_of(run.scene) <= common_depth_bits ? run_in<common_depth_bits + 1>(run)
                                                : run_in<any_depth_bits + 1>(run);
}

}  // namespace bitshade
