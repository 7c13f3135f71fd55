// From filtered moments to light.
#pragma once

#include "bitshade/arithmetic/select.hpp"

namespace bitshade {

/// Mean and variance of filtered moments; rounding may have made the variance negative.
template <class T>
struct mean_variance {
  T mean;
  T variance;
};

/// mu = m1, sigma^2 = m2 - m1^2; every operation is T's. [LauritzenMcCool08] eq. 2.
template <class T>
mean_variance<T> mean_and_variance(const T& m1, const T& m2) {
  return {m1, m2 - m1 * m1};
}

/// The same from centred storage, m2 = E[4 (x - 1/2)^2].
///
///   mu = m1, sigma^2 = m2 / 4 - (m1 - 1/2)^2
template <class T>
mean_variance<T> mean_and_centred_variance(const T& m1, const T& m2) {
  const T off = m1 - static_cast<T>(0.5);
  return {m1, m2 * static_cast<T>(0.25) - off * off};
}

/// Upper bound of the light reaching a receiver behind filtered moments.
///
///   p = 1 if t <= mu, else v / (v + (t - mu)^2),  v = max(sigma^2, floor)
///
/// Shapes   a mean, a variance and one receiver in, one visibility out.
/// Units    depths in [0,1]; floor in depth^2; p in [0,1].
/// Policy   every operation is T's; nothing is evaluated wider.
/// Error    exact moments: none for exact T.
/// Failure  none: p is never NaN for finite moments and a floor >= 0. Where the floor is 0 and
///          (t - mu)^2 underflows, the sum is 0 and p is 0: the limit of v -> 0 at d > 0.
/// Source   [LauritzenMcCool08] eq. 3.
template <class T>
T chebyshev(const mean_variance<T>& at, const T& t, const T& floor) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T d = t - at.mean;
  const T v = select(at.variance < floor, floor, at.variance);
  const T sum = v + d * d;
  const auto empty = sum == zero;
  const T p = select(empty, zero, v / select(empty, one, sum));
  return select(t <= at.mean, one, p);
}

/// Light with its lowest share alpha taken as darkness.
///
///   p' = max(0, (p - alpha) / (1 - alpha))
///
/// Shapes   alpha in [0, 1).
/// Policy   every operation is T's. At alpha = 0, p itself.
/// Failure  none: where alpha rounds to 1 in T the result is 1 for p = 1, else 0.
/// Source   [LauritzenMcCoolSAVSM].
template <class T>
T reduce_bleeding(const T& p, const T& alpha) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T rest = one - alpha;
  const auto none_left = rest <= zero;
  const T reduced =
      select(none_left, select(p < one, zero, one), (p - alpha) / select(none_left, one, rest));
  return select(reduced < zero, zero, reduced);
}

}  // namespace bitshade
