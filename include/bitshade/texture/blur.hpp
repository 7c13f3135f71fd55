// One direction of a separable blur, a row at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

namespace blur_detail {

/// Elements that one pass over the taps keeps in registers.
inline constexpr std::size_t block = 32;

template <class T>
std::vector<T> as(const kernel& weights) {
  std::vector<T> result;
  result.reserve(weights.weights.size());
  for (const double w : weights.weights) result.push_back(static_cast<T>(w));
  return result;
}

/// out[i] = sum over k of weight(k) * source(k)[i], k ascending from the first product.
template <class T, class Source, class Weight>
void weighted_sum(std::size_t taps, std::size_t count, Source source, Weight weight, T* out) {
  std::size_t i = 0;
  for (; i + block <= count; i += block) {
    std::array<T, block> sum;
    const T* in = source(0) + i;
    T w = weight(0);
    for (std::size_t j = 0; j < block; ++j) sum[j] = w * in[j];
    for (std::size_t k = 1; k < taps; ++k) {
      in = source(k) + i;
      w = weight(k);
      for (std::size_t j = 0; j < block; ++j) sum[j] = sum[j] + w * in[j];
    }
    std::copy(sum.begin(), sum.end(), out + i);
  }
  for (; i < count; ++i) {
    T sum = weight(0) * source(0)[i];
    for (std::size_t k = 1; k < taps; ++k) sum = sum + weight(k) * source(k)[i];
    out[i] = sum;
  }
}

}  // namespace blur_detail

/// Row y of the image blurred along its rows, all channels.
///
///   out(x) = (..((w_0 * in(x-r)) + w_1 * in(x-r+1)) ..) + w_2r * in(x+r)
///
/// Shapes   out.size() == in.row_size().
/// Policy   products and sums are T's, in that order: left to right, no fma. Texels beyond the
///          edge are found by `mode`; `border` is every channel's value for address::border.
/// Error    none for exact T; K roundings are the caller's, on the row that comes out.
/// Failure  none.
template <class T>
void blur_row_x(const image<T>& in, const kernel& weights, address mode, int y, std::span<T> out,
                const T& border = T(0)) {
  const std::size_t taps = weights.weights.size();
  const int radius = weights.radius();
  const auto channels = static_cast<std::size_t>(in.channels);
  const std::vector<T> w = blur_detail::as<T>(weights);

  const auto edge = [&](int x) {
    for (int c = 0; c < in.channels; ++c) {
      T sum = T(0);
      for (std::size_t k = 0; k < taps; ++k) {
        const int from = wrap(x - radius + static_cast<int>(k), in.width, mode);
        const T product = w[k] * (from < 0 ? border : in.at(from, y, c));
        sum = k == 0 ? product : sum + product;
      }
      out[static_cast<std::size_t>(x) * channels + static_cast<std::size_t>(c)] = sum;
    }
  };
  const int inner = std::min(radius, in.width);
  const int outer = std::max(inner, in.width - radius);
  for (int x = 0; x < inner; ++x) edge(x);
  for (int x = outer; x < in.width; ++x) edge(x);
  if (outer > inner) {
    const T* first = in.row(y).data();  // the tap x - r of x = r
    blur_detail::weighted_sum<T>(
        taps, static_cast<std::size_t>(outer - inner) * channels,
        [=](std::size_t k) { return first + k * channels; }, [&](std::size_t k) { return w[k]; },
        out.data() + static_cast<std::size_t>(inner) * channels);
  }
}

/// Row y of the image blurred along its columns, all channels: as blur_row_x, from the top down.
template <class T>
void blur_row_y(const image<T>& in, const kernel& weights, address mode, int y, std::span<T> out,
                const T& border = T(0)) {
  const std::size_t taps = weights.weights.size();
  const int radius = weights.radius();
  const std::vector<T> w = blur_detail::as<T>(weights);
  std::vector<T> beyond;
  std::vector<const T*> rows(taps);
  for (std::size_t k = 0; k < taps; ++k) {
    const int from = wrap(y - radius + static_cast<int>(k), in.height, mode);
    if (from < 0 && beyond.empty()) beyond.assign(in.row_size(), border);
    rows[k] = from < 0 ? beyond.data() : in.row(from).data();
  }
  blur_detail::weighted_sum<T>(
      taps, in.row_size(), [&](std::size_t k) { return rows[k]; },
      [&](std::size_t k) { return w[k]; }, out.data());
}

}  // namespace bitshade
