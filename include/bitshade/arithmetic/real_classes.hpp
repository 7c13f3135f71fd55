// What <cmath> asks about a number: its class, its sign, its order.
#pragma once

#include <cmath>

#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

template <class F, rules R, class C> constexpr bool isnan(real<F, R, C> x) { return x != x; }
template <class F, rules R, class C> constexpr bool isfinite(real<F, R, C> x) {
  return x.carrier() - x.carrier() == 0;
}
template <class F, rules R, class C> constexpr bool isinf(real<F, R, C> x) { return !isnan(x) && !isfinite(x); }
template <class F, rules R, class C> constexpr bool isnormal(real<F, R, C> x) {
  return isfinite(x) && x != real<F, R, C>(0) &&
         (F::value.kind != family::binary || !(abs(x) < real<F, R, C>::from_bits(
              static_cast<typename F::bits_type>(min_normal_bits(F::value)))));
}
template <class F, rules R, class C> constexpr bool signbit(real<F, R, C> x) {
  return (std::bit_cast<std::uint64_t>(static_cast<double>(x.carrier())) >> 63) != 0;
}
template <class F, rules R, class C> constexpr int fpclassify(real<F, R, C> x) {
  return isnan(x) ? FP_NAN : isinf(x) ? FP_INFINITE : x == real<F, R, C>(0) ? FP_ZERO : isnormal(x) ? FP_NORMAL : FP_SUBNORMAL;
}

// A real raises no exception, so these are the operators.
#define BITSHADE_COMPARISON(name, result) \
  template <class F, rules R, class C> \
  constexpr bool name(real<F, R, C> a, std::type_identity_t<real<F, R, C>> b) { return result; }
BITSHADE_COMPARISON(isgreater, a > b)
BITSHADE_COMPARISON(isgreaterequal, a >= b)
BITSHADE_COMPARISON(isless, a < b)
BITSHADE_COMPARISON(islessequal, a <= b)
BITSHADE_COMPARISON(islessgreater, a < b || a > b)
BITSHADE_COMPARISON(isunordered, isnan(a) || isnan(b))
#undef BITSHADE_COMPARISON

}  // namespace bitshade
