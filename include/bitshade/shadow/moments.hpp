// From a depth to what a moment shadow map stores of it.
#pragma once

#include <cstddef>
#include <span>

#include "bitshade/arithmetic/select.hpp"
#include "bitshade/shadow/layers.hpp"

namespace bitshade {

/// The layer's own depth of x: 0 at its near end, 1 at its far end.
///
///   phi(x) = clamp((x - near) / (far - near), 0, 1)
///
/// Policy   every operation is T's; the division by a width of 1 changes nothing, so that a single
///          layer over [0,1] is a VSM bit for bit.
/// Error    none for exact T.
/// Failure  none for far > near.
/// Source   [LauritzenMcCool08] section 4.1.
template <class T>
T warp(const T& x, const interval& layer) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T inside = (x - static_cast<T>(layer.near)) / static_cast<T>(layer.far - layer.near);
  return select(inside < zero, zero, select(inside > one, one, inside));
}

/// Depths in [0,1]: what lies outside is clamped before it is squared, so that moments stay
/// consistent.
template <class T>
T clamp_depth(const T& x) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  return select(x < zero, zero, select(x > one, one, x));
}

/// The layer's floor: a variance of sigma_min^2 in depth is one of sigma_min^2 / w^2 in the layer.
///
/// Units    min_variance in depth^2; result in the layer's own units.
/// Policy   every operation is T's; w is exact in T.
/// Source   [LauritzenMcCool08] section 4.2.
template <class T>
T layer_floor(double min_variance, const interval& layer) {
  const T width = static_cast<T>(layer.far - layer.near);
  return static_cast<T>(min_variance) / (width * width);
}

/// A row of first moments: E[x] of one texel is its warped depth.
///
/// Shapes   depth.size() texels in, `channels` values a texel out; channel 0 is written.
template <class T>
void warp_row(std::span<const float> depth, const interval& layer, std::span<T> out,
              std::size_t channels) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    out[i * channels] = warp(clamp_depth(static_cast<T>(depth[i])), layer);
  }
}

/// A row of second moments: E[x^2] of one texel is channel 0 squared, into channel 1.
template <class T>
void square_row(std::span<T> row, std::size_t channels) {
  for (std::size_t i = 0; i < row.size(); i += channels) row[i + 1] = row[i] * row[i];
}

}  // namespace bitshade
