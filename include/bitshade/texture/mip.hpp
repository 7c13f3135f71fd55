// Mip chains: each level from the one below it, a row at a time.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "bitshade/texture/image.hpp"

namespace bitshade {

/// How a level is made of the level below. All three agree on even sizes.
///
///   box     2x2 means; an odd size's last row or column is dropped, as the oldest tools do
///   centre  bilinear at the destination texel's centre: what the measured renderers do
///   area    the mean over the destination texel's area
enum class mip_filter { box, centre, area };

/// The size of a level along one axis: halves, rounded down, never under 1.
constexpr int mip_size(int base, int level) { return level < 31 ? std::max(1, base >> level) : 1; }

/// Levels down to 1x1.
constexpr int mip_levels(int width, int height) {
  int levels = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++levels;
  return levels;
}

/// One destination texel along one axis: numerators over a common denominator, which sum to it.
struct mip_taps {
  int first = 0;  ///< the first source texel; the others follow it
  int count = 1;
  std::array<int, 3> weight{1, 0, 0};
  int denominator = 1;
};

/// The weights of destination texel x along an axis that shrinks from `from` to max(1, from/2).
constexpr mip_taps mip_axis(mip_filter filter, int from, int x) {
  if (from == 1) return {};
  if (from % 2 == 0 || filter == mip_filter::box) return {2 * x, 2, {1, 1, 0}, 2};
  const int to = from / 2;
  // from = 2 to + 1: the destination texel covers [x, x+1] * from/to, the parts (to - x), to and
  // (x + 1) of three texels.
  if (filter == mip_filter::area) return {2 * x, 3, {to - x, to, x + 1}, from};
  // Its centre lies at (2x+1) from / (2 to) - 1/2 = 2x + 1/2 + (2x+1)/(2 to).
  const int past = 2 * x + 1 + to;  // beyond texel 2x, in steps of 1/(2 to); under 4 to
  const int step = past / (2 * to);
  const int rest = past % (2 * to);
  return {2 * x + step, rest == 0 ? 1 : 2, {2 * to - rest, rest, 0}, 2 * to};
}

/// Row y of the next smaller level, all channels.
///
///   even sizes  ((a + b) + (c + d)) / 4, a and b from the upper row; one axis: (a + b) / 2
///   odd sizes   sum over rows j of wy_j * (sum over columns i of wx_i * t_ij), first to last,
///               each w its integer numerator divided by the denominator in T
///
/// Shapes   out.size() == max(1, in.width / 2) * in.channels; y < max(1, in.height / 2).
/// Policy   operations are T's in that order.
/// Error    none for exact T.
/// Failure  none.
template <class T>
void downsample_row(const image<T>& in, mip_filter filter, int y, std::span<T> out) {
  const int width = std::max(1, in.width / 2);
  const int channels = in.channels;
  const mip_taps down = mip_axis(filter, in.height, y);
  const bool halves_x = in.width > 1 && (in.width % 2 == 0 || filter == mip_filter::box);
  const bool halves_y = in.height > 1 && (in.height % 2 == 0 || filter == mip_filter::box);

  if (halves_x && halves_y) {
    const T quarter = static_cast<T>(0.25);
    const T* upper = in.row(down.first).data();
    const T* lower = in.row(down.first + 1).data();
    const auto run = [&](auto count) {  // a constant count lets the compiler interleave by shuffles
      std::size_t i = 0;
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < count; ++c, ++i) {
          const std::size_t left = 2 * i - static_cast<std::size_t>(c);
          const std::size_t right = left + static_cast<std::size_t>(count);
          out[i] = ((upper[left] + upper[right]) + (lower[left] + lower[right])) * quarter;
        }
    };
    if (channels == 1)
      run(std::integral_constant<int, 1>{});
    else if (channels == 2)
      run(std::integral_constant<int, 2>{});
    else if (channels == 4)
      run(std::integral_constant<int, 4>{});
    else
      run(channels);
    return;
  }
  const auto weight = [](const mip_taps& taps, int i) {
    return static_cast<T>(taps.weight[static_cast<std::size_t>(i)]) /
           static_cast<T>(taps.denominator);
  };
  std::size_t i = 0;
  for (int x = 0; x < width; ++x) {
    const mip_taps across = mip_axis(filter, in.width, x);
    for (int c = 0; c < channels; ++c, ++i) {
      T sum = static_cast<T>(0);
      for (int j = 0; j < down.count; ++j) {
        T row = static_cast<T>(0);
        for (int k = 0; k < across.count; ++k) {
          const T part = weight(across, k) * in.at(across.first + k, down.first + j, c);
          row = k == 0 ? part : row + part;
        }
        const T part = weight(down, j) * row;
        sum = j == 0 ? part : sum + part;
      }
      out[i] = sum;
    }
  }
}

/// The levels of an image, level 0 (the image itself) first, down to 1x1.
///
/// Shapes   round: void(std::span<T>), called with each row of each level but the first, in order:
///          the rounding of that level's store.
/// Failure  none.
template <class T, class Round>
std::vector<image<T>> mip_chain(image<T> base, mip_filter filter, Round round) {
  std::vector<image<T>> levels;
  const int count = mip_levels(base.width, base.height);
  levels.reserve(static_cast<std::size_t>(count));
  levels.push_back(std::move(base));
  for (int level = 1; level < count; ++level) {
    const image<T>& from = levels.back();
    image<T> next(std::max(1, from.width / 2), std::max(1, from.height / 2), from.channels);
    for (int y = 0; y < next.height; ++y) {
      downsample_row<T>(from, filter, y, next.row(y));
      round(next.row(y));
    }
    levels.push_back(std::move(next));
  }
  return levels;
}

}  // namespace bitshade
