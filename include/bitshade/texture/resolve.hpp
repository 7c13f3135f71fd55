// Multisampling: where the samples lie, and what becomes of them.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include "bitshade/texture/image.hpp"

namespace bitshade {

/// A sample's place in its pixel, in sixteenths from the pixel's centre.
struct sample_position {
  int x = 0, y = 0;
};

/// The standard patterns of 1, 2, 4 and 8 samples.
///
/// Failure  std::invalid_argument for another number.
/// Source   [D3D11] 19.2.4.1.4, [Vulkan] "Multisampling": standardSampleLocations.
inline std::span<const sample_position> sample_pattern(int samples) {
  static constexpr std::array<sample_position, 1> one{{{0, 0}}};
  static constexpr std::array<sample_position, 2> two{{{4, 4}, {-4, -4}}};
  static constexpr std::array<sample_position, 4> four{{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}};
  static constexpr std::array<sample_position, 8> eight{
      {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}};
  switch (samples) {
    case 1:
      return one;
    case 2:
      return two;
    case 4:
      return four;
    case 8:
      return eight;
    default:
      throw std::invalid_argument("multisampling knows 1, 2, 4 or 8 samples");
  }
}

/// Row y of the resolved image: the mean of all samples, all channels.
///
///   with n = 4: (s_0/4 + s_1/4) + (s_2/4 + s_3/4)
///
/// Divided before they are summed, so that no sum can overflow where its mean does not; summed in
/// pairs, so that equal samples resolve to themselves, bit for bit (but for subnormal quotients).
///
/// Shapes   one image a sample, all of one size, 1, 2, 4 or 8 of them; out.size() == row_size().
/// Policy   quotients and sums are T's in that order.
/// Error    none for exact T; in binary T log2(n) roundings of partial sums.
/// Failure  std::invalid_argument for another number of samples.
template <class T>
void resolve_row(std::span<const image<T>> samples, int y, std::span<T> out) {
  const std::size_t count = sample_pattern(static_cast<int>(samples.size())).size();
  const T share = static_cast<T>(1) / static_cast<T>(static_cast<int>(count));
  std::array<T, 8> part{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t s = 0; s < count; ++s) part[s] = samples[s].row(y)[i] * share;
    for (std::size_t left = count / 2; left > 0; left /= 2) {
      for (std::size_t s = 0; s < left; ++s) part[s] = part[2 * s] + part[2 * s + 1];
    }
    out[i] = part[0];
  }
}

}  // namespace bitshade
