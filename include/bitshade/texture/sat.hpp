// Summed-area tables: how they are summed, offset, stored and read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// In which order the sums of one direction are made.
enum class sat_order {
  running,   ///< s_i = s_(i-1) + t_i
  doubling,  ///< s_i += s_(i - 2^k) for k = 0, 1, .. : what shaders do
  pairwise,  ///< sums of halves, then the halves' prefixes: error of order log n
  kahan      ///< running, with the lost parts carried along
};

/// What is taken from every texel before summing and given back by the box mean.
enum class sat_offset { none, half, mean };

namespace sat_detail {

/// Replaces n values, `step` apart, by their prefix sums.
template <class T>
void prefix(T* at, std::size_t n, std::size_t step, sat_order order) {
  const auto value = [&](std::size_t i) -> T& { return at[i * step]; };
  switch (order) {
    case sat_order::running:
      for (std::size_t i = 1; i < n; ++i) value(i) = value(i - 1) + value(i);
      return;
    case sat_order::doubling:
      for (std::size_t reach = 1; reach < n; reach *= 2)
        for (std::size_t i = n - 1; i >= reach; --i) value(i) = value(i - reach) + value(i);
      return;
    case sat_order::pairwise: {
      if (n < 2) return;
      // Sums of pairs, their prefixes by the same method, then the odd places from the even ones.
      std::vector<T> pairs(n / 2);
      for (std::size_t i = 0; i < n / 2; ++i) pairs[i] = value(2 * i) + value(2 * i + 1);
      prefix(pairs.data(), pairs.size(), 1, order);
      for (std::size_t i = n; i-- > 1;)
        value(i) = i % 2 == 1 ? pairs[i / 2] : pairs[i / 2 - 1] + value(i);
      return;
    }
    case sat_order::kahan: {
      T lost = value(0) - value(0);
      for (std::size_t i = 1; i < n; ++i) {
        const T wanted = value(i) - lost;
        const T sum = value(i - 1) + wanted;
        lost = (sum - value(i - 1)) - wanted;
        value(i) = sum;
      }
      return;
    }
  }
}

}  // namespace sat_detail

/// A summed-area table: at(x, y) holds the sum over the texels with indices up to x and y.
///
/// Shapes   one channel a value of the image; `offset` one a channel, already taken away.
template <class T>
struct summed_area {
  image<T> sums;
  std::vector<T> offset;
};

/// Sums an image along its rows, then along its columns.
///
/// Shapes   round: void(std::span<T>), called with every row after each direction: the store.
/// Policy   sums are T's in the order asked for; unsigned integers wrap, which keeps box sums
///          exact as long as the box's own sum fits. The mean is summed pairwise in T.
/// Error    integers, exact T: none. Floats: running sums of n terms err by up to (n - 1) units in
///          the last place of the largest sum, doubling and pairwise by log2 n of them.
/// Failure  std::invalid_argument for an empty image.
template <class T, class Round>
summed_area<T> make_sat(image<T> in, sat_order order, sat_offset offset, Round round) {
  if (in.texels.empty()) throw std::invalid_argument("a summed-area table needs texels");
  const auto channels = static_cast<std::size_t>(in.channels);
  const auto width = static_cast<std::size_t>(in.width),
             height = static_cast<std::size_t>(in.height);
  summed_area<T> result{{}, std::vector<T>(channels, static_cast<T>(0))};
  if (offset != sat_offset::none) {
    for (std::size_t c = 0; c < channels; ++c) {
      if (offset == sat_offset::half) {
        result.offset[c] = static_cast<T>(0.5);
      } else {
        std::vector<T> all(width * height);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = in.texels[i * channels + c];
        while (all.size() > 1) {
          for (std::size_t i = 0; i < all.size() / 2; ++i) all[i] = all[2 * i] + all[2 * i + 1];
          if (all.size() % 2 == 1) all[all.size() / 2] = all.back();
          all.resize((all.size() + 1) / 2);
        }
        result.offset[c] = all[0] / static_cast<T>(static_cast<int>(width * height));
      }
    }
    for (std::size_t i = 0; i < in.texels.size(); ++i)
      in.texels[i] = in.texels[i] - result.offset[i % channels];
  }
  for (int y = 0; y < in.height; ++y) {
    for (std::size_t c = 0; c < channels; ++c)
      sat_detail::prefix(in.row(y).data() + c, width, channels, order);
    round(in.row(y));
  }
  if (order == sat_order::running) {
    // Row by row, so that memory is read in its order; the sums are the same.
    for (int y = 1; y < in.height; ++y) {
      const T* above = in.row(y - 1).data();
      T* here = in.row(y).data();
      for (std::size_t i = 0; i < width * channels; ++i) here[i] = above[i] + here[i];
      round(in.row(y));
    }
  } else {
    for (std::size_t i = 0; i < width * channels; ++i)
      sat_detail::prefix(in.texels.data() + i, height, width * channels, order);
    for (int y = 0; y < in.height; ++y) round(in.row(y));
  }
  result.sums = std::move(in);
  return result;
}

/// The sum over texels x0 .. x1, y0 .. y1 (both included), the offset not given back.
///
///   (s(x1,y1) - s(x0-1,y1)) - (s(x1,y0-1) - s(x0-1,y0-1))
///
/// Policy   T's differences in that order; terms beyond the edge are left out.
template <class T>
T box_sum(const summed_area<T>& sat, int x0, int y0, int x1, int y1, int channel) {
  const auto at = [&](int x, int y) {
    return x < 0 || y < 0 ? static_cast<T>(0) : sat.sums.at(x, y, channel);
  };
  return static_cast<T>((at(x1, y1) - at(x0 - 1, y1)) - (at(x1, y0 - 1) - at(x0 - 1, y0 - 1)));
}

/// The mean over the same texels: the box sum over their number, plus the offset.
template <class T>
T box_mean(const summed_area<T>& sat, int x0, int y0, int x1, int y1, int channel) {
  const T count = static_cast<T>(static_cast<T>(x1 - x0 + 1) * static_cast<T>(y1 - y0 + 1));
  return box_sum(sat, x0, y0, x1, y1, channel) / count +
         sat.offset[static_cast<std::size_t>(channel)];
}

/// The mean over a rectangle with fractional corners, in texel space: 0 <= u0 < u1 <= width.
///
/// The table, extended by zeros, is bilinear between corners, so that its corner difference is the
/// exact integral over the rectangle: a corner at u lies u - 1 beyond the centre of texel 0.
///
/// Failure  none; corners are limited to the image.
template <class T>
T rectangle_mean(const summed_area<T>& sat, T u0, T v0, T u1, T v1, int channel) {
  const T zero = static_cast<T>(0);
  const auto limit = [&](T x, int size) {
    const T most = static_cast<T>(size);
    return x < zero ? zero : most < x ? most : x;
  };
  u0 = limit(u0, sat.sums.width);
  u1 = limit(u1, sat.sums.width);
  v0 = limit(v0, sat.sums.height);
  v1 = limit(v1, sat.sums.height);
  const auto at = [&](int x, int y) { return x < 0 || y < 0 ? zero : sat.sums.at(x, y, channel); };
  const auto corner = [&](const T& u, const T& v) {
    const int x = texel_floor(u), y = texel_floor(v);
    const T fx = u - static_cast<T>(x), fy = v - static_cast<T>(y);
    const int xn = std::min(x, sat.sums.width - 1), yn = std::min(y, sat.sums.height - 1);
    const T upper = at(x - 1, y - 1) + fx * (at(xn, y - 1) - at(x - 1, y - 1));
    const T lower = at(x - 1, yn) + fx * (at(xn, yn) - at(x - 1, yn));
    return upper + fy * (lower - upper);
  };
  const T sum = (corner(u1, v1) - corner(u0, v1)) - (corner(u1, v0) - corner(u0, v0));
  return sum / ((u1 - u0) * (v1 - v0)) + sat.offset[static_cast<std::size_t>(channel)];
}

/// Two tables whose sum is the table of an image: each value split at 1/steps.
///
///   high = floor(t * steps) / steps, low = (t - high) * steps
///
/// Error    exact box sums in T of p bits only while the sums of steps * high stay below 2^p.
template <class T>
struct split_summed_area {
  summed_area<T> high, low;
  T steps{};
};

template <class T>
split_summed_area<T> make_split_sat(const image<T>& in, sat_order order, int steps) {
  image<T> high = in, low = in;
  const T scale = static_cast<T>(steps);
  for (std::size_t i = 0; i < in.texels.size(); ++i) {
    high.texels[i] = static_cast<T>(texel_floor(in.texels[i] * scale)) / scale;
    low.texels[i] = (in.texels[i] - high.texels[i]) * scale;
  }
  const auto keep = [](std::span<T>) {};
  return {make_sat(std::move(high), order, sat_offset::none, keep),
          make_sat(std::move(low), order, sat_offset::none, keep), scale};
}

template <class T>
T box_mean(const split_summed_area<T>& sat, int x0, int y0, int x1, int y1, int channel) {
  const T count = static_cast<T>(x1 - x0 + 1) * static_cast<T>(y1 - y0 + 1);
  return (box_sum(sat.high, x0, y0, x1, y1, channel) +
          box_sum(sat.low, x0, y0, x1, y1, channel) / sat.steps) /
         count;
}

/// Largest box, in texels, whose sum of `bits`-bit codes an unsigned W keeps modulo its range: none
/// where a code alone is wider than W.
template <class W>
constexpr std::uint64_t modular_box_texels(int bits) {
  static_assert(std::is_unsigned_v<W>);
  constexpr int width = std::numeric_limits<W>::digits;
  if (bits > width) return 0;
  return width - bits >= 64 ? ~std::uint64_t{0} : std::uint64_t{1} << (width - bits);
}

/// The table of unsigned codes in W, wrapping: what uint32 SATs on devices do.
///
/// Error    box sums of at most modular_box_texels<W>(bits) texels are exact.
/// Failure  std::invalid_argument where a code does not fit `bits`, or `bits` do not fit W.
template <class W>
summed_area<W> make_modular_sat(const image<std::uint64_t>& codes, int bits) {
  if (bits < 0 || bits > std::numeric_limits<W>::digits)
    throw std::invalid_argument(
        "a modular summed-area table cannot hold codes wider than its sums");
  image<W> in(codes.width, codes.height, codes.channels);
  for (std::size_t i = 0; i < in.texels.size(); ++i) {
    if (bits < 64 && (codes.texels[i] >> bits) != 0)
      throw std::invalid_argument("a code of a modular summed-area table is wider than announced");
    in.texels[i] = static_cast<W>(codes.texels[i]);
  }
  return make_sat(std::move(in), sat_order::running, sat_offset::none, [](std::span<W>) {});
}

/// Refuses a table whose sums may pass the largest finite value of its store: box means would be
/// wrong everywhere behind the place where it saturates.
///
/// Units    largest: of the texels, offset taken away; store_max: of the store's format.
/// Failure  std::invalid_argument that says what would fit.
inline void require_sat_fits(int width, int height, double largest, double store_max) {
  if (static_cast<double>(width) * static_cast<double>(height) * largest <= store_max) return;
  throw std::invalid_argument(
      "a summed-area table of " + std::to_string(width) + " x " + std::to_string(height) +
      " texels saturates its format; use binary32 or uint32 sums, or subtract the mean");
}

}  // namespace bitshade
