// How far a wrong variance and mean carry the visibility: docs/theory.md, sections 6 to 8.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "bitshade/study/bounds.hpp"

namespace bitshade {
namespace detail {

/// The bounds below are evaluated in binary64 by fewer than 16 roundings: this factor makes each
/// an upper bound of its own exact value.
inline constexpr double outward = 1 + 0x1p-48;

/// Square root to within one ulp, constexpr where the standard library's is not.
constexpr double square_root(double x) {
  if (!std::is_constant_evaluated()) return std::sqrt(x);
  if (!(x > 0) || x > std::numeric_limits<double>::max()) return x;
  for (double root = x < 1 ? 1 : x;;) {  // Newton from above falls until it stands
    const double next = 0.5 * (root + x / root);
    if (next >= root) return root;
    root = next;
  }
}

}  // namespace detail

/// Largest slope of the visibility in the mean, times the standard deviation: 3 sqrt(3) / 8,
/// taken at d = sigma / sqrt(3). docs/theory.md section 6.
inline constexpr double mean_slope = 0x1.4c8dc2e42398p-1 * detail::outward;

/// Largest change of v / (v + d^2) over all d when v grows by the factor 1 + r.
///
///   (s - 1) / (s + 1) = r / (s + 1)^2,  s = sqrt(1 + r);  taken at d^2 = sqrt(v v')
///
/// Source   docs/theory.md section 6.
constexpr double visibility_error_of_variance(double r) {
  const double s = detail::square_root(1 + r);
  return r / ((s + 1) * (s + 1)) * detail::outward;
}

/// Largest change of the visibility when the mean moves by e at variance v.
constexpr double visibility_error_of_mean(double e, double variance) {
  return mean_slope * e / detail::square_root(variance) * detail::outward;
}

/// Largest visibility error of moments within e, whose variance errs by at most `noise` and is
/// then raised to `floor`; the shading arithmetic and the receiver's depth are exact.
///
///   |dp| <= (sqrt(1 + r) - 1) / (sqrt(1 + r) + 1) + (3 sqrt 3 / 8) e / sqrt(floor), r = noise/floor
///
/// Holds for every receiver, on both sides of the mean.
///
/// Units    noise, floor in depth^2 of the layer; e in its depth.
/// Source   docs/theory.md section 6.
constexpr double visibility_error(double noise, double e, double floor) {
  const double bound =
      visibility_error_of_variance(noise / floor) + visibility_error_of_mean(e, floor);
  return bound < 1 ? bound : 1;  // two visibilities are never further apart
}

/// The light that noise alone lets through where the variance is 0 and nothing floors it.
///
///   D / (D + d^2), which goes to 1 as the receiver nears the occluder
///
/// Source   docs/theory.md section 6.
template <class T>
constexpr T unfloored_error(const T& noise, const T& d) {
  return noise / (noise + d * d);
}

/// The largest r = D/v that keeps the variance's share of the error within eps: 4 eps / (1 - eps)^2.
template <class T>
constexpr T tolerated_noise_ratio(const T& eps) {
  return T(4) * eps / ((T(1) - eps) * (T(1) - eps));
}

/// The floor that keeps the variance's share of the error within eps.
///
///   D (1 - eps)^2 / (4 eps); a floor of D alone leaves an error of 3 - 2 sqrt 2 = 0.172
///
/// Source   docs/theory.md section 7.
template <class T>
constexpr T floor_for(const T& noise, const T& eps) {
  return noise / tolerated_noise_ratio(eps);
}

/// The light that a floor alone lets through at distance d behind a single occluder.
///
///   f / (f + d^2)
///
/// Source   docs/theory.md section 7.
template <class T>
constexpr T floor_residue(const T& floor, const T& d) {
  return floor / (floor + d * d);
}

/// The narrowest layer, or overlap, over which a floor's light falls to eps.
///
///   w >= sigma_min sqrt(1/eps - 1): 16 sigma_min at 1/255
///
/// Source   docs/theory.md section 7.
constexpr double narrowest_layer(double min_deviation, double eps) {
  return min_deviation * detail::square_root(1 / eps - 1) * detail::outward;
}

/// The overlap that hides both artefacts of a layer's edge.
///
///   delta >= max(filter radius * receiver slope, sigma_min sqrt(1/eps - 1))
///
/// Units    radius in texels, slope in depth per texel.
/// Source   docs/theory.md section 7.
constexpr double least_overlap(double radius, double slope, double min_deviation, double eps) {
  const double reach = radius * slope, fade = narrowest_layer(min_deviation, eps);
  return reach > fade ? reach : fade;
}

/// Equation (4) in general: p behind two occluders a < b, the nearer with coverage alpha.
///
///   p = alpha (1 - alpha) dx^2 / (alpha (1 - alpha) dx^2 + (dy + alpha dx)^2)
///
/// Source   [LauritzenMcCool08] eq. 4; derived in docs/theory.md section 8.
template <class T>
constexpr T two_occluder_bleeding(const T& alpha, const T& dx, const T& dy) {
  const T v = alpha * (T(1) - alpha) * dx * dx, d = dy + alpha * dx;
  return v / (v + d * d);
}

}  // namespace bitshade
