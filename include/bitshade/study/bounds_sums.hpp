// What floating-point running sums cost a rectangle's mean: docs/theory.md section 5.
#pragma once

#include <limits>

#include "bitshade/study/bounds_visibility.hpp"

namespace bitshade {

/// A rectangle of a summed-area table, and how its table was made.
///
/// Units    sizes in texels; unit roundoffs of the arithmetic that sums and of the store.
struct summed_rectangle {
  int map_width = 1, map_height = 1;
  int width = 1, height = 1;
  double arithmetic = 0x1p-24, store = 0x1p-24;
};

namespace detail {

/// (1 + u)^n - 1 <= 2 n u where n u <= 1; beyond nothing is known.
constexpr double growth(double nu) {
  return nu <= 1 ? 1 + 2 * nu : std::numeric_limits<double>::infinity();
}

}  // namespace detail

/// Largest error of a rectangle's mean of texels in [0,1] by running sums that are stored after
/// each direction, the differences of corners being exact.
///
///   e <= (u W + 2 s W/w + 2 (u + s + u s) W H/w) (1 + 2 n),  n = (W + H) u + (H + 1) s <= 1
///
/// A column's sums differ by the rows between them, so that only roundings beside the rectangle
/// count; but each is one of a sum of up to W H texels. Thus log2(W H/w) bits more than the texels'.
///
/// Error    infinite where n > 1.
/// Failure  sums beyond the format's largest number are no part of it.
/// Source   docs/theory.md section 5.
constexpr double summed_mean_error(const summed_rectangle& r) {
  const double W = r.map_width, H = r.map_height, w = r.width, u = r.arithmetic, s = r.store;
  const double grown = detail::growth((W + H) * u + (H + 1) * s);
  return (u * W + 2 * s * W / w + 2 * (u + s + u * s) * W * H / w) * grown * detail::outward;
}

/// What the differences of corners and the division add in the same arithmetic.
///
///   4 u W H/(w h) (1 + 2 n) + 2 u
constexpr double corner_error(const summed_rectangle& r) {
  const double W = r.map_width, H = r.map_height, u = r.arithmetic;
  const double grown = detail::growth((W + H) * u + (H + 1) * r.store);
  const double area = static_cast<double>(r.width) * r.height;
  return (4 * u * W * H / area + 2 * u) * grown * detail::outward;
}

/// Largest visibility error of sums alone; 1 where nothing better is known.
constexpr double summed_error_at(const summed_rectangle& r, double floor) {
  const double e = summed_mean_error(r);
  if (!(e < 1)) return 1;
  return visibility_error(variance_error(e, 1.0).width() * detail::outward, e, floor);
}

}  // namespace bitshade
