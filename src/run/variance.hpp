// What a variance shadow map stores, and how light comes of it: the technique of native_engine.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/bounds.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/study/measures.hpp"
#include "bitshade/texture/image.hpp"
#include "bitshade/texture/mip.hpp"
#include "run/slope.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// How often a moment is rounded on its way to the light: the store, the resolve, blur passes,
/// mips.
inline int roundings_of(const configuration& how, const image<float>& depth) {
  const int mips =
      how.filter == texel_filter::trilinear ? mip_levels(depth.width, depth.height) - 1 : 0;
  if (how.method == technique::savsm) return how.filtered.msaa > 1 ? 2 : 1;
  const int passes = !how.blurred() ? 0 : how.filtered.way == blur_way::one_pass ? 1 : 2;
  return 1 + (how.filtered.msaa > 1 ? 1 : 0) + passes + mips;
}

/// The largest error of a variance that a format's roundings can cause, in a layer's own units.
inline double variance_noise(const configuration& how, const storage_format& storage,
                             const image<float>& depth) {
  const int roundings = roundings_of(how, depth);
  if (storage.format.kind == family::binary) {
    const double u = 1.0 / static_cast<double>(std::uint64_t{2} << storage.format.fraction_bits);
    return variance_error_floating(roundings * u, 1.0);
  }
  const double error = moment_error(decode(storage.format, 1), roundings);
  return how.second == second_moment::centred ? variance_error_centred(error, 1.0)
                                              : variance_error(error, 1.0).width();
}

/// The smallest floor, in a layer's own units, that the noise lets keep 1/255; 0 where not asked.
inline double noise_floor(const configuration& how, const storage_format& storage,
                          const image<float>& depth) {
  return how.noise_floor ? floor_for(variance_noise(how, storage, depth), tolerated_error) : 0.0;
}

/// The same for both warps of an EVSM, in their units squared: the largest warped depth bounds the
/// noise at every other one.
inline std::array<double, 2> warped_noise_floors(const configuration& how,
                                                 const storage_format& storage,
                                                 const image<float>& depth,
                                                 const evsm_constants& constants) {
  if (!how.noise_floor) return {0, 0};
  const int roundings = roundings_of(how, depth);
  const auto needed = [&](double w) {
    return floor_for(warped_noise(storage.format, w, roundings), tolerated_error);
  };
  return {needed(positive_warp(1.0, constants)), needed(1.0)};
}

template <class T>
class variance_technique {
 public:
  variance_technique(const configuration& how, const storage_format& storage,
                     const image<float>& depth)
      : how_(how),
        storage_(storage),
        least_floor_(static_cast<T>(noise_floor(how, storage, depth))) {}

  int channels() const { return 2; }

  void begin(const interval& layer) {
    layer_ = layer;
    floor_ = std::max(layer_floor<T>(how_.min_variance, layer), least_floor_);
  }

  void fill(const image<float>& depth, int y, std::span<T> row) const {
    warp_row<T>(depth.row(y), layer_, row, 2, how_.warping);
    switch (how_.second) {
      case second_moment::square:
        square_row<T>(row, 2);
        break;
      case second_moment::square_of_stored:
        round_row(storage_, row);  // channel 1 is overwritten at once
        square_row<T>(row, 2);
        break;
      case second_moment::centred:
        centred_square_row<T>(row, 2);
        break;
    }
    if (how_.slope_term) add_layer_slope(depth, y, layer_, how_, row);
  }

  T light(std::span<const T> values, const T& t) const {
    const auto at = how_.second == second_moment::centred
                        ? mean_and_centred_variance(values[0], values[1])
                        : mean_and_variance(values[0], values[1]);
    return chebyshev(at, warp(t, layer_, how_.warping), floor_);
  }

 private:
  const configuration& how_;
  const storage_format& storage_;
  T least_floor_;
  T floor_{};
  interval layer_;
};

}  // namespace bitshade
