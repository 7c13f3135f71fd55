// Less light bleeding at the price of darker penumbrae: the second form, a power and a lift.
// The first form, (11), is reduce_bleeding of chebyshev.hpp.
#pragma once

#include "bitshade/arithmetic/select.hpp"
#include "bitshade/shadow/exponential.hpp"
#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// The constants of the form; the defaults are the source's.
struct power_reduction {
  double exponent = 1.3;
  double lift = 0.65;
};

/// x^a for x in [0,1] and a > 0 by binary64's own logarithm and exponential, then one rounding to
/// T.
///
/// Error    3 |a log2 x| 2^-53 relative and one rounding: below 2^-45 where x^a > 2^-64.
template <class T>
T power_of(const T& x, double a) {
  constexpr double ln2 = 0x1.62e42fefa39efp-1;
  const double wide = static_cast<double>(x);
  if (!(wide > 0)) return static_cast<T>(0);
  return static_cast<T>(exp_of_double(a * log2_fixed(wide) * ln2));
}

/// Darkened penumbrae, then lifted shadows.
///
///   p' = min(1, p^exponent + lift)
///
/// Shapes   p in [0,1].
/// Policy   the power is one operation, sum and comparison are T's.
/// Failure  none: p = 0 gives the lift, p = 1 gives 1.
/// Source   [Marinescu11]: p^1.3 + 0.65.
template <class T>
T reduce_bleeding_by_power(const T& p, const power_reduction& how = {}) {
  const T one = static_cast<T>(1);
  const T lifted = power_of(p, how.exponent) + static_cast<T>(how.lift);
  return select(lifted < one, lifted, one);
}

}  // namespace bitshade
