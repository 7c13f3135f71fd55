// Square root and exp of exact numbers: rational bounds as close as asked for; ask again for closer ones.
#pragma once

#include <cstdint>

#include "bitshade/arithmetic/interval.hpp"

namespace bitshade {

namespace detail {

template <class Q>
exact<Q> power_of_half(int bits) {
  exact<Q> r(1);
  exact<Q> base = exact<Q>(1) / exact<Q>(2);
  for (int n = bits; n > 0; n >>= 1) {
    if (n & 1) r *= base;
    base *= base;
  }
  return r;
}

}  // namespace detail

/// Bounds of sqrt(x), at most 2^-bits apart. Newton from above: x / y lies below the root where y lies above.
///
/// Failure  a negative x gives [0, 0] (what sqrt of an interval leaves of it).
template <class Q>
interval<exact<Q>> sqrt_enclosure(const exact<Q>& x, int bits) {
  using T = exact<Q>;
  if (!(T(0) < x)) return {T(0), T(0)};
  const T wanted = detail::power_of_half<Q>(bits), half = detail::power_of_half<Q>(1);
  // A start within a factor of two, from the number's size: y >= sqrt(x) after one step.
  T y(1);
  while (y * y < x) y *= T(2);
  while (x < y * y * half * half) y *= half;
  for (;;) {
    const T below = x / y;
    const T low = below < y ? below : y, high = below < y ? y : below;
    if (!(wanted < high - low)) return {low, high};
    y = (y + below) * half;
  }
}

/// Bounds of e^x, at most 2^-bits apart, relative to e^x where that is above 1.
///
///   e^x = (e^(x / 2^k))^(2^k), |x| / 2^k <= 1/2;  Taylor's remainder after n terms is below 2 |r|^(n+1) / (n+1)!
template <class Q>
interval<exact<Q>> exp_enclosure(const exact<Q>& x, int bits) {
  using T = exact<Q>;
  const T half = detail::power_of_half<Q>(1);
  T r = x;
  int squarings = 0;
  for (; half < abs(r); ++squarings) r *= half;
  // Each squaring at most doubles the relative width, and adds a little: three bits of reserve.
  const T wanted = detail::power_of_half<Q>(bits + squarings + 3);
  T sum(1), term(1), bound(1);
  for (int n = 1; wanted < bound; ++n) {
    term *= r / T(n);
    sum += term;
    bound = abs(term) * T(2);  // the next terms together are less than the last one
    if (term == T(0)) break;
  }
  if (r == T(0)) return {T(1), T(1)};
  interval<T> y(sum - bound, sum + bound);
  for (int i = 0; i < squarings; ++i) y *= y;
  return y;
}

}  // namespace bitshade
