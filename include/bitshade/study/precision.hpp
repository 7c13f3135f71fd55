// Bits against layers: how wide a stored moment must be. docs/theory.md section 9.
#pragma once

#include <cstdint>

#include "bitshade/study/bounds_visibility.hpp"

namespace bitshade {

/// What decides how many bits a stored moment needs.
///
/// Units    floor_deviation (sigma_min), overlap and width in depth; mu in layer units.
struct precision_question {
  double tolerated = 1.0 / 255;  ///< eps, an error of visibility
  double floor_deviation = 0.01;
  double width = 1;       ///< w of the widest layer, its overlaps included
  int roundings = 1;      ///< K: store, blur passes, mip levels, filter result ..
  double mean = 1;        ///< the largest mean of the footprints, 1 unless known better
  bool spare_mean = false;  ///< count the variance's share of the error alone
};

/// The width of the widest of N uniform layers with overlap delta: eq. (8).
constexpr double uniform_layer_width(int layers, double overlap) {
  const double w = 1.0 / layers + (layers > 2 ? 2 : layers - 1) * overlap;
  return w < 1 ? w : 1;
}

/// The floor in the layer's own units: eq. (7).
constexpr double layer_floor_variance(const precision_question& q) {
  const double s = q.floor_deviation / q.width;
  return s * s;
}

/// The largest visibility error of a grid with that many steps in [0,1].
constexpr double error_at(const precision_question& q, double steps) {
  const double e = moment_error(1 / steps, q.roundings);
  const double noise = variance_error(e, q.mean).width() * detail::outward;
  const double floor = layer_floor_variance(q);
  if (q.spare_mean) return visibility_error_of_variance(noise / floor);
  return visibility_error(noise, e, floor);
}

/// 2^b - 1 of the fewest (real) bits b for which the variance's share stays within eps.
///
///   E = 2 T / ((1 + 2 mu) + sqrt((1 + 2 mu)^2 + 4 T)),  T = 4 eps v / (1 - eps)^2
///   2^b - 1 = K / (2 E) >= K (1 + 2 mu)(1 - eps)^2 w^2 / (8 eps sigma_min^2)
///
/// Source   docs/theory.md section 9; the second form leaves out E^2 and is a hair smaller.
constexpr double steps_needed(const precision_question& q) {
  const double t = tolerated_noise_ratio(q.tolerated) * layer_floor_variance(q);
  const double b = 1 + 2 * q.mean;
  const double e = 2 * t / (b + detail::square_root(b * b + 4 * t));
  return q.roundings / (2 * e);
}

/// The fewest whole bits of a unorm that keep the error within eps for every footprint; 0 where
/// 52 do not suffice.
constexpr int unorm_bits_needed(const precision_question& q) {
  for (int bits = 1; bits <= 52; ++bits) {
    const auto steps = static_cast<double>((std::uint64_t{1} << bits) - 1);
    if (error_at(q, steps) <= q.tolerated) return bits;
  }
  return 0;
}

/// The fewest significand bits (the hidden one included) of a binary float that keep the error
/// within eps for every footprint of [0,1]; 0 where 53 do not suffice.
///
/// Its coarsest steps below 1 are 2^-p: as a unorm with 2^p steps.
constexpr int significand_bits_needed(const precision_question& q) {
  for (int bits = 1; bits <= 53; ++bits) {
    const auto steps = static_cast<double>(std::uint64_t{1} << bits);
    if (error_at(q, steps) <= q.tolerated) return bits;
  }
  return 0;
}

/// Steps (2^b - 1) below which the full overlap cannot keep eps, whatever sigma_min and N >= 2.
///
///   1.5 K (1 - eps)^3 / eps^2: the overlap that the floor asks for widens every layer beyond
///   twice itself, and the floor in its units is then at most eps / (4 (1 - eps))
///
/// Source   docs/theory.md section 9; holds for overlaps below 1/2, K roundings, mu = 1.
constexpr double steps_needed_with_full_overlap(double eps, int roundings) {
  return 1.5 * roundings * (1 - eps) * (1 - eps) * (1 - eps) / (eps * eps);
}

}  // namespace bitshade
