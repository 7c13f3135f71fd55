// Blurs beyond the separable exact-tap one: weights in any format, one pass, linear-sampled taps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// A kernel whose weights went through a format.
struct rounded_kernel {
  kernel taps;
  double sum = 1;  ///< of the weights as they are used: what a constant image is multiplied with
};

/// Weights as a format holds them; renormalised: their deviation from 1 given to the middle tap,
/// as far as the format can hold that, so that what is left is reported honestly.
///
/// Error    sum says it: variances shift by about -(sum - 1) mu^2 (docs/bounds.md).
inline rounded_kernel round_kernel(const kernel& in, const encoding& format, bool renormalise,
                                   const rules& r = {}) {
  rounded_kernel result{in, 0};
  for (double& w : result.taps.weights) w = round_to(format, w, r);
  const auto total = [&] {
    double sum = 0;
    for (const double w : result.taps.weights) sum += w;
    return sum;
  };
  if (renormalise) {
    double& middle = result.taps.weights[static_cast<std::size_t>(in.radius())];
    middle = round_to(format, middle + (1 - total()), r);
  }
  result.sum = total();
  return result;
}

/// Row y blurred in one pass over the square of taps.
///
///   sum over j, top down, of sum over i, left to right, of (w_j * w_i) * t
///
/// Policy   products and sums are T's in that order; the weights' products too.
template <class T>
void blur_row_square(const image<T>& in, const kernel& weights, address mode, int y,
                     std::span<T> out, const T& border = T(0)) {
  const std::vector<T> w = blur_detail::as<T>(weights);
  const int radius = weights.radius();
  for (int x = 0; x < in.width; ++x)
    for (int c = 0; c < in.channels; ++c) {
      T sum = static_cast<T>(0);
      for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
          const int tx = wrap(x + i, in.width, mode), ty = wrap(y + j, in.height, mode);
          const T weight =
              w[static_cast<std::size_t>(j + radius)] * w[static_cast<std::size_t>(i + radius)];
          sum = sum + weight * (tx < 0 || ty < 0 ? border : in.at(tx, ty, c));
        }
      out[static_cast<std::size_t>(x * in.channels + c)] = sum;
    }
}

/// One bilinear fetch in place of two taps.
struct linear_tap {
  double offset = 0;  ///< from the texel, in texels
  double weight = 0;
};

/// Pairs of taps as bilinear fetches: (n + 1) / 2 of them, 9 taps in 5.
///
///   weight = w_i + w_(i+1), offset = i + w_(i+1) / weight, both sides of the middle
///
/// Shapes   in.weights symmetric; an odd radius leaves single taps at the ends.
/// Error    exact but for binary64's rounding of the offset; on a device the fraction is then put
///          on its grid of 2^-weight_bits (0: not), which moves each pair's weights by up to
///          2^-(weight_bits + 1) of their sum.
inline std::vector<linear_tap> linear_taps(const kernel& in, int weight_bits = 0) {
  const int radius = in.radius();
  const auto w = [&](int i) { return in.weights[static_cast<std::size_t>(radius + i)]; };
  std::vector<linear_tap> result{{0, w(0)}};
  for (int i = 1; i <= radius; i += 2) {
    const double weight = i < radius ? w(i) + w(i + 1) : w(i);
    double fraction = i < radius && weight != 0 ? w(i + 1) / weight : 0;
    if (weight_bits > 0) {
      const double grid = static_cast<double>(1 << weight_bits);
      fraction = static_cast<double>(static_cast<std::int64_t>(fraction * grid + 0.5)) / grid;
    }
    result.push_back({i + fraction, weight});
    result.push_back({-(i + fraction), weight});
  }
  return result;
}

namespace blur_detail {

/// One texel's sum of bilinear fetches along an axis of `size` texels, of which it is number i.
template <class T, class Texel>
T linear_sum(std::span<const linear_tap> taps, int i, int size, address mode, const T& border,
             Texel texel) {
  T sum = static_cast<T>(0);
  for (const linear_tap& tap : taps) {
    const int first = texel_floor(tap.offset);
    const T f = static_cast<T>(tap.offset - first);
    const int i0 = wrap(i + first, size, mode), i1 = wrap(i + first + 1, size, mode);
    const T a = i0 < 0 ? border : texel(i0), b = i1 < 0 ? border : texel(i1);
    sum = sum + static_cast<T>(tap.weight) * (a + f * (b - a));
  }
  return sum;
}

}  // namespace blur_detail

/// Row y blurred along its rows by bilinear fetches.
///
/// Policy   each fetch a + f (b - a) in T, then weighted and summed in the taps' order.
template <class T>
void blur_row_linear(const image<T>& in, std::span<const linear_tap> taps, address mode, int y,
                     std::span<T> out, const T& border = T(0)) {
  for (int x = 0; x < in.width; ++x)
    for (int c = 0; c < in.channels; ++c)
      out[static_cast<std::size_t>(x * in.channels + c)] = blur_detail::linear_sum<T>(
          taps, x, in.width, mode, border, [&](int i) { return in.at(i, y, c); });
}

/// Row y blurred along its columns by bilinear fetches.
template <class T>
void blur_column_linear(const image<T>& in, std::span<const linear_tap> taps, address mode, int y,
                        std::span<T> out, const T& border = T(0)) {
  for (int x = 0; x < in.width; ++x)
    for (int c = 0; c < in.channels; ++c)
      out[static_cast<std::size_t>(x * in.channels + c)] = blur_detail::linear_sum<T>(
          taps, y, in.height, mode, border, [&](int j) { return in.at(x, j, c); });
}

}  // namespace bitshade
