// What each stage other than the store costs a visibility: docs/theory.md section 11.
#pragma once

#include "bitshade/study/bounds_visibility.hpp"

namespace bitshade {

/// Largest visibility error of EVSM where both moments were rounded K times in floating point.
///
///   r <= (k + (3 k + k^2) / s) / (1 - k),  e <= k (1 + 2 k) / sqrt(s),  k = (1 + u)^K - 1
///
/// The floor s = min(1, c^2 sigma_min^2) is relative to the receiver's warped depth squared, and so
/// is the noise: it is one number for every depth and every footprint.
///
/// Units    u: unit roundoff; c: the exponent; floor_deviation in depth.
/// Policy   w e^(c x) as stored, in a floating format whose range it does not leave.
/// Source   docs/theory.md section 11.
constexpr double evsm_error_at(double u, int roundings, double c, double floor_deviation) {
  double k = 0;
  for (int i = 0; i < roundings; ++i) k = k + u + k * u;
  const double slope = c * floor_deviation;
  const double s = slope < 1 ? slope * slope : 1;
  const double r = (k + (3 * k + k * k) / s) / (1 - k) * detail::outward;
  const double bound =
      visibility_error_of_variance(r) + visibility_error_of_mean(k * (1 + 2 * k), s);
  return bound < 1 ? bound : 1;
}

/// Largest visibility error of ESM where the exponential was rounded K times in floating point.
///
///   |dp| <= k p <= k,  k = (1 + u)^K - 1
///
/// Averages of relative errors up to k err by no more, and the clamp at 1 brings two lights no
/// further apart.
///
/// Source   docs/theory.md section 11.
constexpr double esm_error_at(double u, int roundings) {
  double k = 0;
  for (int i = 0; i < roundings; ++i) k = k + u + k * u;
  k = k * detail::outward;
  return k < 1 ? k : 1;
}

/// Largest visibility error of a convolution map whose biased terms, (1 + v)/2, are each within e.
///
///   |dp| <= gain 2 sum_k 2 sqrt(2) e / ((2k - 1) pi),  gain = 2
///
/// An error 2 e of cosine and sine turns by cos(c t) and sin(c t): sqrt(2) of it is left at most.
///
/// Source   docs/theory.md section 11.
constexpr double csm_error_at(double e, int terms) {
  double sum = 0;
  for (int k = 1; k <= terms; ++k) sum += 1.0 / (2 * k - 1);
  const double bound = 8 * 0x1.6a09e667f3bcdp+0 / 0x1.921fb54442d18p+1 * e * sum * (1 + 0x1p-40);
  return bound < 1 ? bound : 1;
}

/// Largest share of a footprint that rounded weights move: the total variation of bilinear weights
/// whose two fractions are each off by half a step of 2^-bits.
///
///   omega = 2^-bits
///
/// Source   docs/theory.md section 11: weights are a product of two distributions.
constexpr double moved_share(int fraction_bits) {
  return 1.0 / static_cast<double>(1ULL << fraction_bits);
}

/// Largest visibility error where a share omega of a footprint moved over depths of that range.
///
///   |dv| <= omega range^2,  |dmu| <= omega range
///
/// Source   docs/theory.md section 11.
constexpr double weight_error_at(double omega, double range, double floor) {
  return visibility_error(omega * range * range * detail::outward, omega * range * detail::outward,
                          floor);
}

/// Largest visibility error of Chebyshev's bound where moments and receiver are rounded on the way
/// in and every operation rounds once: floating point of unit roundoff u, no over- or underflow.
///
///   C = D(u, 1) + u (1 + u)^2,  e <= u (1/w + 3)(1 + u)^2,
///   |dp| <= visibility_error(C, e, f) + 4 u (1 + 8 u)
///
/// The receiver is rounded before it is warped: in a layer of width w that error counts 1/w times.
///
/// Units    width w of the layer; floor in its units.
/// Source   docs/theory.md section 11.
constexpr double shading_error_at(double u, double width, double floor) {
  const double up = (1 + u) * (1 + u);
  const double noise = (variance_error(u, 1.0).width() + u * up) * detail::outward;
  const double e = u * (1 / width + 3) * up * detail::outward;
  const double bound = visibility_error(noise, e, floor) + 4 * u * (1 + 8 * u);
  return bound < 1 ? bound : 1;
}

/// The fewest bits from 1 to `most` for which error(bits) stays within eps; 0 where none does.
template <class Error>
constexpr int fewest_bits(double eps, int most, Error error) {
  for (int bits = 1; bits <= most; ++bits) {
    if (error(bits) <= eps) return bits;
  }
  return 0;
}

/// The unit roundoff of a significand of p bits, the hidden one included.
constexpr double unit_roundoff(int significand_bits) {
  return 1.0 / static_cast<double>(1ULL << significand_bits);
}

}  // namespace bitshade
