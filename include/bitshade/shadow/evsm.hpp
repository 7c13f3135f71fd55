// Exponential variance shadow maps with two and four components.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/exponential.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// The constants of both warps.
///
///   w+(x) = e^(positive (x - shift)),   w-(x) = -e^(-negative x)
///
/// A shift scales w+ by e^(-positive shift) and its floor alike, so p keeps its value; 1 brings w+
/// into (0,1] for formats that end at 1. w- is stored as its magnitude: every rounding that treats
/// both signs alike gives the same bits, and formats without a sign can hold it.
struct evsm_constants {
  double positive = 5;
  double negative = 5;
  double shift = 0;
};

/// The largest number of a format.
inline double largest_of(const encoding& e) { return decode(e, max_bits(e)); }

/// Whether w+ must be shifted into (0,1]: formats whose largest number is near 1.
inline bool ends_at_one(const encoding& e) { return largest_of(e) < 2; }

/// The largest exponent whose warped depths keep `powers` times finite in a format.
///
///   c = (ln max - roundings * u) / powers,  x in [0,1]
///
/// Shapes   powers: 2 for EVSM, which squares; 1 for ESM. Unlimited (700, exp's own range) where
///          the warp is shifted into (0,1].
/// Policy   roundings: how often a value may grow by one unit roundoff u before it is stored: 3 for
///          a rounded warp, squared, rounded; arithmetic in the format itself adds its sums'.
/// Error    within 2^-40 of the equation, downwards.
/// Source   [Annen08] section 4 for ESM; [LauritzenMcCool08] section 7.
inline double exponent_cap(const encoding& e, int powers = 2, int roundings = 3) {
  if (ends_at_one(e)) return 700;
  constexpr double ln2 = 0x1.62e42fefa39efp-1;
  const double u = e.kind == family::binary
                       ? 1.0 / static_cast<double>(std::uint64_t{2} << e.fraction_bits)
                       : 1 / largest_of(e);
  const double cap = (log2_fixed(largest_of(e)) * ln2 - roundings * u) / powers * (1 - 0x1p-40);
  return cap < 700 ? cap : 700;
}

/// From which exponent on w-'s square turns subnormal at x = 1; infinity where nothing is.
///
///   c = -ln(smallest normal) / 2
inline double negative_exponent_turns_subnormal(const encoding& e) {
  constexpr double ln2 = 0x1.62e42fefa39efp-1;
  if (e.kind != family::binary) return std::bit_cast<double>(std::uint64_t{0x7ff} << 52);
  return -min_exponent(e) * ln2 / 2;
}

/// Refuses an exponent that a format cannot hold: an infinity would spread through every filter.
///
/// Failure  std::invalid_argument that names the exponent, the cap and the cure.
inline void check_exponent(double c, const encoding& e, const std::string& format_name,
                           int powers = 2) {
  const double cap = exponent_cap(e, powers);
  if (c > 0 && c <= cap) return;
  throw std::invalid_argument("the exponent " + std::to_string(c) +
                              (powers == 2 ? " overflows when squared in " : " overflows in ") +
                              format_name + ": give one above 0 and at most " +
                              std::to_string(cap));
}

/// The constants as a format needs them: shifted where it ends at 1, refused above its cap.
inline evsm_constants evsm_constants_for(double positive, double negative, const encoding& e,
                                         const std::string& format_name) {
  check_exponent(positive, e, format_name);
  check_exponent(negative, e, format_name);
  return {positive, negative, ends_at_one(e) ? 1.0 : 0.0};
}

/// w+ of a depth in [0,1]. Every operation is T's.
template <class T>
constexpr T positive_warp(const T& x, const evsm_constants& c) {
  return exponential(static_cast<T>(c.positive) * (x - static_cast<T>(c.shift)));
}

/// The magnitude of w-, e^(-c x). Every operation is T's.
template <class T>
constexpr T negative_warp(const T& x, const evsm_constants& c) {
  return exponential(static_cast<T>(-c.negative) * x);
}

/// A row of a two-component map: w+ into channel 0; squares come after the store or before it, as
/// for a VSM (square_row).
///
/// Shapes   depth.size() texels in, `channels` values a texel out.
template <class T>
void positive_warp_row(std::span<const float> depth, const evsm_constants& c, std::span<T> out,
                       std::size_t channels) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    out[i * channels] = positive_warp(clamp_depth(static_cast<T>(depth[i])), c);
  }
}

/// The same for |w-|, into channel `first`.
template <class T>
void negative_warp_row(std::span<const float> depth, const evsm_constants& c, std::span<T> out,
                       std::size_t channels, std::size_t first = 2) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    out[i * channels + first] = negative_warp(clamp_depth(static_cast<T>(depth[i])), c);
  }
}

/// Adds a slanted surface's variance within its texel to a warped second moment: (12) with the
/// chain rule, since a depth's small step dx moves w = e^(c x) by c w dx.
///
///   M2 += (c w)^2 ((dx/du)^2 + (dx/dv)^2) / 4
///
/// Differences of w itself would be those of a chord, which the warp bends away from its tangent.
///
/// Units    slope: slope_variance() of the depths; m1, m2 of the warp that has the constant c.
/// Policy   every operation is T's.
/// Failure  none: no sum exceeds the square of the warp's largest value. A limited slope is at most
///          1 - x each (x for w-), and e^(2 c x) (1 + c^2 (1 - x)^2 / 2) rises up to x = 1: its
///          derivative's factor 2 + y^2 - y, y = c (1 - x), has no zero. exponent_cap needs no
///          room.
/// Source   (12): [LauritzenMcCool08] section 3, on section 7's warp.
template <class T>
void add_warped_slope(const T& slope, double c, const T& m1, T& m2) {
  const T steepness = static_cast<T>(c) * m1;
  m2 = m2 + (steepness * slope) * steepness;  // its square alone may overflow
}

/// The floor of a warped depth: a variance of sigma_min^2 in depth, seen through the warp's slope.
///
///   floor = min(1, sigma_min^2 c^2) w^2
///
/// The minimum keeps it finite wherever w^2 is: a floor of w^2 already is the whole range.
///
/// Units    min_variance in depth^2; w the receiver's warped depth; result in w's units squared.
/// Source   the chain rule on w = e^(c x), as (7) is on (6).
template <class T>
T warped_floor(double min_variance, double c, const T& w) {
  const T one = static_cast<T>(1), rate = static_cast<T>(c);
  const T share = static_cast<T>(min_variance) * rate * rate;
  return select(share < one, share, one) * (w * w);
}

/// The variance that K roundings of both moments to a format can feign at a warped depth w.
///
///   binary formats   K (3 u w^2 + (u w)^2),  u = 2^-(p+1): M2 errs by u w^2, M1^2 by 2 u w^2
///   others           K q/2 (1 + 2 w) + (K q/2)^2, with their step q
///
/// Units    w in the warp's; result in w's units squared.
inline double warped_noise(const encoding& e, double w, int roundings = 1) {
  const double k = roundings;
  if (e.kind == family::binary) {
    const double u = k / static_cast<double>(std::uint64_t{2} << e.fraction_bits);
    return u * w * w * (3 + u);
  }
  const double half_step = k * decode(e, 1) / 2;
  return half_step * (1 + 2 * w + half_step);
}

/// Upper bound of the light from two warped moments.
///
///   chebyshev of w+ with the floor sigma_min^2 (c+ w+(t))^2, never under `noise`
///
/// Shapes   M1, M2 of w+; t in [0,1].
/// Units    noise in w+'s units squared; 0 for the floor as it is.
/// Policy   every operation is T's.
/// Failure  none for constants that check_exponent lets pass.
/// Source   [LauritzenMcCool08] section 7, eq. 3 on e^(cx).
template <class T>
T evsm_positive_bound(const T& m1, const T& m2, const T& t, const evsm_constants& c,
                      double min_variance, const T& noise = static_cast<T>(0)) {
  const T w = positive_warp(t, c);
  const T floor = warped_floor(min_variance, c.positive, w);
  return chebyshev(mean_and_variance(m1, m2), w, select(floor < noise, noise, floor));
}

/// The same for w-: moments of its magnitude in, negated here.
template <class T>
T evsm_negative_bound(const T& m1, const T& m2, const T& t, const evsm_constants& c,
                      double min_variance, const T& noise = static_cast<T>(0)) {
  const T w = negative_warp(t, c);
  const T floor = warped_floor(min_variance, c.negative, w);
  const auto at = mean_and_variance(m1, m2);
  return chebyshev(mean_variance<T>{-at.mean, at.variance}, -w,
                   select(floor < noise, noise, floor));
}

/// The smaller of both bounds: four components.
///
/// Source   (10): [LauritzenMcCool08] section 7.
template <class T>
T evsm_bound(const T& positive, const T& negative) {
  return select(negative < positive, negative, positive);
}

}  // namespace bitshade
