// From a depth to what a moment shadow map stores of it.
#pragma once

#include <cstddef>
#include <span>

#include "bitshade/arithmetic/select.hpp"
#include "bitshade/shadow/layers.hpp"

namespace bitshade {

/// The layer's own depth of x: 0 at its near end, 1 at its far end.
///
///   phi(x) = clamp((x - near) / (far - near), 0, 1), or without the clamp
///
/// Policy   every operation is T's; the division by a width of 1 changes nothing, so that a single
///          layer over [0,1] is a VSM bit for bit.
/// Error    none for exact T.
/// Failure  none for far > near.
/// Source   (6): [LauritzenMcCool08] section 4.1; (13), unclamped: [Marinescu11].
template <class T>
T warp(const T& x, const interval& layer, layer_warp beyond = layer_warp::clamped) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T inside = (x - static_cast<T>(layer.near)) / static_cast<T>(layer.far - layer.near);
  if (beyond == layer_warp::unclamped) return inside;
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
///   min(1, sigma_min^2 / w^2)
///
/// No variance in [0,1] exceeds 1/4; a floor of 1 already lights everything in the layer by a half
/// or more, and the cap keeps it finite where w is next to nothing.
///
/// Units    min_variance in depth^2; result in the layer's own units.
/// Policy   every operation is T's; w is exact in binary32 and wider.
/// Failure  none: where w^2 underflows the floor is 1, or 0 if there is none.
/// Source   [LauritzenMcCool08] section 4.2.
template <class T>
T layer_floor(double min_variance, const interval& layer) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T variance = static_cast<T>(min_variance);
  const T width = static_cast<T>(layer.far - layer.near);
  const T square = width * width;
  const auto vanished = square == zero;
  const T floor = variance / select(vanished, one, square);
  return select(vanished, select(variance == zero, zero, one), select(floor > one, one, floor));
}

/// A row of first moments: E[x] of one texel is its warped depth.
///
/// Shapes   depth.size() texels in, `channels` values a texel out; channel 0 is written.
template <class T>
void warp_row(std::span<const float> depth, const interval& layer, std::span<T> out,
              std::size_t channels, layer_warp beyond = layer_warp::clamped) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    out[i * channels] = warp(clamp_depth(static_cast<T>(depth[i])), layer, beyond);
  }
}

/// A row of second moments: E[x^2] of one texel is channel 0 squared, into channel 1.
template <class T>
void square_row(std::span<T> row, std::size_t channels) {
  for (std::size_t i = 0; i < row.size(); i += channels) row[i + 1] = row[i] * row[i];
}

/// The same with the square taken about 1/2: 4 (x - 1/2)^2, which fills [0,1].
template <class T>
void centred_square_row(std::span<T> row, std::size_t channels) {
  for (std::size_t i = 0; i < row.size(); i += channels) {
    const T off = row[i] - static_cast<T>(0.5);
    row[i + 1] = static_cast<T>(4) * (off * off);
  }
}

/// A texel's slope along one axis: of the differences to both neighbours the smaller one, 0 where
/// they disagree in sign. At a silhouette one neighbour lies on another surface, and its difference
/// is no slope at all.
template <class T>
T limited_slope(const T& before, const T& here, const T& after) {
  const T zero = static_cast<T>(0);
  const T back = here - before, on = after - here;
  const T back_size = select(back < zero, -back, back), on_size = select(on < zero, -on, on);
  return select(back * on <= zero, zero, select(back_size < on_size, back, on));
}

/// The variance that a slanted surface has within its own texel: the term of equation (12).
///
///   ((dx/du)^2 + (dx/dv)^2) / 4,  differences per texel, limited at silhouettes
///
/// Policy   every operation is T's.
/// Source   (12): [LauritzenMcCool08], section 3; [Lauritzen07] for the quarter.
template <class T>
T slope_variance(const T& left, const T& right, const T& above, const T& below, const T& here) {
  const T du = limited_slope(left, here, right), dv = limited_slope(above, here, below);
  return static_cast<T>(0.25) * (du * du + dv * dv);
}

/// slope_variance() of texel i of a row, whose ends and the rows above and below repeat the border.
template <class T>
T slope_variance_in(std::span<const T> above, std::span<const T> here, std::span<const T> below,
                    std::size_t i) {
  return slope_variance(here[i == 0 ? 0 : i - 1], here[i + 1 == here.size() ? i : i + 1], above[i],
                        below[i], here[i]);
}

/// Adds equation (12) to the second moments of a row.
///
///   M2 += ((dx/du)^2 + (dx/dv)^2) / 4,  differences per texel of the *warped* depth
///
/// Differences of warped depths obey the chain rule by themselves: no derivative of the warp is
/// needed, and a clamped depth has no slope.
///
/// Shapes   depths of the rows above, here and below (the border repeats), one channel each; row:
///          the texels, channel 1 is changed.
/// Policy   every operation is T's.
template <class T>
void add_slope_row(std::span<const T> above, std::span<const T> here, std::span<const T> below,
                   std::span<T> row, std::size_t channels) {
  for (std::size_t i = 0; i < here.size(); ++i) {
    row[i * channels + 1] = row[i * channels + 1] + slope_variance_in(above, here, below, i);
  }
}

}  // namespace bitshade
