// The definition of a variance shadow map's layer: every stage in the type that a policy names.
// Runs over whole studies join row kernels instead (templates define, kernels run).
#pragma once

#include <cstddef>
#include <vector>

#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/formats/round_to.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/bilinear.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// x as storage S hands it back, in the type that it is loaded into.
template <storage S, class To, class From>
To stored(const From& x) {
  if constexpr (std::same_as<S, unrounded>) {
    return static_cast<To>(x);
  } else {
    return static_cast<To>(round_to(S::value, static_cast<double>(x)));
  }
}

/// One layer's moments over a map, blurred, and their lookup.
///
/// Policy   P names each stage's arithmetic and storage; the second moment is the square of the
///          first before it is stored, with the slope term (12) where asked.
/// Source   [LauritzenMcCool08] sections 3 and 4.
template <numeric_policy P>
class moment_map {
 public:
  /// Shapes   depth: one channel; blur: an odd kernel, one tap for none.
  moment_map(const image<float>& depth, const interval& layer, const kernel& blur,
             address mode = address::clamp, bool slope_term = false)
      : layer_(layer), mode_(mode), texels_(depth.width, depth.height, 2) {
    using load = typename P::load;
    using square = typename P::square;
    const auto warped = [&](int y) {
      std::vector<square> row(depth.row_size());
      for (std::size_t x = 0; x < row.size(); ++x) {
        row[x] = static_cast<square>(
            warp(clamp_depth(static_cast<typename P::warp>(depth.row(y)[x])), layer));
      }
      return row;
    };
    std::vector<square> moments(texels_.row_size());
    for (int y = 0; y < depth.height; ++y) {
      const auto here = warped(y);
      for (std::size_t x = 0; x < here.size(); ++x) moments[2 * x] = here[x];
      square_row<square>(moments, 2);
      if (slope_term) {
        add_slope_row<square>(warped(y == 0 ? 0 : y - 1), here,
                              warped(y + 1 == depth.height ? y : y + 1), moments, 2);
      }
      for (std::size_t i = 0; i < moments.size(); ++i) {
        texels_.row(y)[i] = stored<typename P::store, load>(moments[i]);
      }
    }
    if (blur.weights.size() > 1) {
      blur_pass([&](const auto& in, int y, auto out) { blur_row_x(in, blur, mode, y, out); });
      blur_pass([&](const auto& in, int y, auto out) { blur_row_y(in, blur, mode, y, out); });
    }
  }

  const image<typename P::load>& texels() const { return texels_; }

  /// Light at a receiver of depth t that looks at (u, v); min_variance in depth^2.
  typename P::shade visibility(float u, float v, float t, double min_variance) const {
    using filter = typename P::filter;
    using shade = typename P::shade;
    const auto at = locate(static_cast<filter>(u), static_cast<filter>(v), texels_.width,
                           texels_.height, mode_);
    const auto filtered = [&](int channel) {
      const auto texel = [&](int x, int y) {
        return static_cast<filter>(texels_.at(x, y, channel));
      };
      const filter upper = lerp(texel(at.x0, at.y0), texel(at.x1, at.y0), at.fx);
      const filter lower = lerp(texel(at.x0, at.y1), texel(at.x1, at.y1), at.fx);
      return static_cast<typename P::variance>(lerp(upper, lower, at.fy));
    };
    const auto depth = warp(clamp_depth(static_cast<typename P::receive>(t)), layer_);
    const auto moments = mean_and_variance(filtered(0), filtered(1));
    return chebyshev<shade>(
        {static_cast<shade>(moments.mean), static_cast<shade>(moments.variance)},
        static_cast<shade>(depth), layer_floor<shade>(min_variance, layer_));
  }

 private:
  template <class Row>
  void blur_pass(Row row) {
    using arithmetic = typename P::blur;
    image<arithmetic> in(texels_.width, texels_.height, 2);
    for (std::size_t i = 0; i < in.texels.size(); ++i) {
      in.texels[i] = static_cast<arithmetic>(texels_.texels[i]);
    }
    std::vector<arithmetic> out(in.row_size());
    for (int y = 0; y < in.height; ++y) {
      row(in, y, std::span<arithmetic>(out));
      for (std::size_t i = 0; i < out.size(); ++i) {
        texels_.row(y)[i] = stored<typename P::blur_store, typename P::load>(out[i]);
      }
    }
  }

  interval layer_;
  address mode_;
  image<typename P::load> texels_;
};

}  // namespace bitshade
