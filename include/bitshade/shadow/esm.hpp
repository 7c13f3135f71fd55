// Exponential shadow maps: the step of the depth test as an exponential, which filters linearly.
#pragma once

#include <cstddef>
#include <span>

#include "bitshade/shadow/evsm.hpp"

namespace bitshade {

/// The constant, and the shift that brings e^(c (x - shift)) into (0,1] for formats that end at 1.
struct esm_constants {
  double exponent = 5;
  double shift = 0;
};

/// Shifted where the format ends at 1, refused above ln(max).
inline esm_constants esm_constants_for(double exponent, const encoding& e,
                                       const std::string& format_name) {
  check_exponent(exponent, e, format_name, 1);
  return {exponent, ends_at_one(e) ? 1.0 : 0.0};
}

/// What a texel stores: e^(c (x - shift)). Every operation is T's.
template <class T>
constexpr T esm_warp(const T& x, const esm_constants& c) {
  return exponential(static_cast<T>(c.exponent) * (x - static_cast<T>(c.shift)));
}

/// A row of texels.
template <class T>
void esm_row(std::span<const float> depth, const esm_constants& c, std::span<T> out) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    out[i] = esm_warp(clamp_depth(static_cast<T>(depth[i])), c);
  }
}

/// Light at a receiver behind a filtered exponential.
///
///   p = min(1, e^(-c (t - shift)) E[e^(c (x - shift))])
///
/// Shapes   one filtered texel and one receiver in, one visibility out.
/// Policy   every operation is T's.
/// Error    not a bound of P(x >= t) from either side: texels beyond the receiver count for more
///          than 1, and the clamp hides it. By Markov's inequality it is one from above.
/// Failure  none for constants that check_exponent lets pass.
/// Source   [Annen08] eq. 7.
template <class T>
T esm_visibility(const T& filtered, const T& t, const esm_constants& c) {
  const T one = static_cast<T>(1);
  const T p = exponential(static_cast<T>(-c.exponent) * (t - static_cast<T>(c.shift))) * filtered;
  return select(p < one, p, one);
}

}  // namespace bitshade
