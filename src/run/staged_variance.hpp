// The two moments of vsm, lvsm and savsm over any number: a Technique of staged_base.hpp.
#pragma once

#include <span>
#include <vector>

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "run/shading_arithmetic.hpp"
#include "run/slope.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// The same operations as variance_technique's, the noise floor left out.
template <class V>
class staged_variance {
 public:
  staged_variance(const configuration& how, const storage_format&) : how_(how) {}

  int channels() const { return 2; }
  void begin(const interval& layer) {
    layer_ = layer;
    floor_ = layer_floor<V>(how_.min_variance, layer);
  }
  template <class Keep>
  void fill(const image<float>& depth, int y, std::span<V> row, Keep keep) const {
    warp_row<V>(depth.row(y), layer_, row, 2, how_.warping);
    if (how_.second == second_moment::centred) {
      centred_square_row<V>(row, 2);
    } else {
      if (how_.second == second_moment::square_of_stored) keep(row);
      square_row<V>(row, 2);
    }
    if (how_.slope_term) add_layer_slope<V>(depth, y, layer_, how_, row);
  }
  V light(std::span<const V> values, const V& t) const {
    const auto at = how_.second == second_moment::centred
                        ? mean_and_centred_variance(values[0], values[1])
                        : mean_and_variance(values[0], values[1]);
    return chebyshev(at, warp(t, layer_, how_.warping), floor_);
  }
  shading_input shading(const std::vector<double>& values, double t) const {
    return {values[0], values[1],         t,
            layer_,    how_.min_variance, how_.second == second_moment::centred};
  }

 private:
  const configuration& how_;
  interval layer_;
  V floor_{};
};

}  // namespace bitshade
