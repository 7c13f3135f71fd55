// Convolution shadow maps: the depth test as a Fourier series, whose terms filter linearly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/half_turns.hpp"
#include "bitshade/shadow/moments.hpp"

namespace bitshade {

/// How many terms, how they are stored, and what is done against ringing.
///
/// `biased`   terms are stored as (1 + v)/2, for formats without a sign: 8-bit unorm, say.
/// `damping`  term k is multiplied by e^(-damping (k/M)^2): 0 leaves the series as it is.
/// `gain`     p = min(1, gain f). The series is 1/2 where x = t; 2 lights such a receiver.
/// `offset`   the receiver moves towards the light by it before it is looked up.
struct csm_constants {
  int terms = 4;
  bool biased = true;
  double damping = 0;
  double gain = 2;
  double offset = 0;

  std::size_t channels() const { return 2 * static_cast<std::size_t>(terms); }
};

/// The constants with terms stored as the format allows.
inline csm_constants csm_constants_for(int terms, const encoding& e) {
  const bool has_sign = e.has_sign && e.kind != family::unorm && e.kind != family::ufixed;
  csm_constants c;
  c.terms = terms;
  c.biased = !has_sign;
  return c;
}

/// One texel: cos(c_k x), sin(c_k x) for k = 1 .. M, c_k = (2k - 1) pi, biased or not.
///
/// Shapes   out: 2M values, cosine before sine.
/// Policy   each cosine and sine is one operation; the bias is T's.
/// Source   [Annen07] eq. 7, eq. 8.
template <class T>
void csm_texel(const T& x, const csm_constants& c, std::span<T> out) {
  const T half = static_cast<T>(0.5);
  for (int k = 0; k < c.terms; ++k) {
    const half_turn<T> at = half_turns(x, 2 * k + 1);
    const auto i = 2 * static_cast<std::size_t>(k);
    out[i] = c.biased ? half + half * at.cosine : at.cosine;
    out[i + 1] = c.biased ? half + half * at.sine : at.sine;
  }
}

/// A row of texels.
template <class T>
void csm_row(std::span<const float> depth, const csm_constants& c, std::span<T> out) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    csm_texel(clamp_depth(static_cast<T>(depth[i])), c,
              out.subspan(i * c.channels(), c.channels()));
  }
}

/// The series of the depth test, from filtered terms.
///
///   f = 1/2 + 2 sum_k g_k/c_k (cos(c_k t) E[sin(c_k x)] - sin(c_k t) E[cos(c_k x)])
///   p = clamp(gain f, 0, 1),  g_k = e^(-damping (k/M)^2)
///
/// Shapes   2M filtered values and one receiver in, one visibility out.
/// Policy   every operation is T's, terms added from k = 1 on.
/// Error    method: f differs from the step by O(1/(M |t - x|)) away from x = t and overshoots by
///          9 % next to it (Gibbs); no bound of P(x >= t).
/// Failure  none.
/// Source   [Annen07] eq. 6 to 9.
template <class T>
T csm_visibility(std::span<const T> filtered, const T& t, const csm_constants& c) {
  const T zero = static_cast<T>(0), half = static_cast<T>(0.5), one = static_cast<T>(1),
          two = static_cast<T>(2);
  const T at = t - static_cast<T>(c.offset);
  T sum = zero;
  for (int k = 0; k < c.terms; ++k) {
    const auto i = 2 * static_cast<std::size_t>(k);
    const auto plain = [&](const T& v) { return c.biased ? two * v - one : v; };
    const half_turn<T> turn = half_turns(at, 2 * k + 1);
    T weight = two * inverse_half_turns(t, 2 * k + 1);
    if (c.damping != 0) {
      const double share = (k + 1.0) / c.terms;
      weight = weight * exponential(static_cast<T>(-c.damping * (share * share)));
    }
    const T term = turn.cosine * plain(filtered[i + 1]) - turn.sine * plain(filtered[i]);
    sum = sum + weight * term;
  }
  const T f = static_cast<T>(c.gain) * (half + sum);
  return select(f < zero, zero, select(f > one, one, f));
}

}  // namespace bitshade
