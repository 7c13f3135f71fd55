// <cmath> over packs, lane by lane: a function's lane is what the function gives of that lane alone.
//
// Policy   of a real over a pack as of the scalar real; of a pack of floats or doubles as of real<binary32> or
//          real<binary64>, so correctly rounded and the same on every machine, which the C library's are not.
// Failure  none; questions (isnan and its like) answer by a mask. For what chooses use select, fmin and fmax: a
//          comparison of packs is no condition.
#pragma once

#include "bitshade/arithmetic/pack.hpp"
#include "bitshade/arithmetic/real_math.hpp"

namespace bitshade {

namespace detail {

/// The scalar whose function a lane takes.
template <class T>
using lane_real = real<format<shape_of<T>::value>>;

template <class F, rules R, class T, int N>
real<F, R, T> lane_of(const real<F, R, pack<T, N>>& x, int k) {
  return real<F, R, T>::from_carrier(x.carrier()[k]);
}
template <class T, int N>
lane_real<T> lane_of(const pack<T, N>& x, int k) {
  return lane_real<T>(x[k]);
}

template <class T, int N, class Function, class... Packs>
pack<T, N> by_lanes(Function f, const Packs&... x) {
  T out[N];
  for (int k = 0; k < N; ++k) out[k] = f(lane_of(x, k)...).carrier();
  return pack<T, N>::load(out);
}

}  // namespace detail

#define BITSHADE_UNARY(name) \
  template <class F, rules R, class T, int N> \
  real<F, R, pack<T, N>> name(const real<F, R, pack<T, N>>& x) { \
    return real<F, R, pack<T, N>>::from_carrier(detail::by_lanes<T, N>([](auto u) { return name(u); }, x)); \
  } \
  template <class T, int N> \
  pack<T, N> name(const pack<T, N>& x) { \
    return detail::by_lanes<T, N>([](auto u) { return name(u); }, x); \
  }
#define BITSHADE_BINARY(name) \
  template <class F, rules R, class T, int N> \
  real<F, R, pack<T, N>> name(const real<F, R, pack<T, N>>& x, const std::type_identity_t<real<F, R, pack<T, N>>>& y) { \
    return real<F, R, pack<T, N>>::from_carrier( \
        detail::by_lanes<T, N>([](auto u, auto v) { return name(u, v); }, x, y)); \
  } \
  template <class T, int N> \
  pack<T, N> name(const pack<T, N>& x, const std::type_identity_t<pack<T, N>>& y) { \
    return detail::by_lanes<T, N>([](auto u, auto v) { return name(u, v); }, x, y); \
  }
BITSHADE_ELEMENTARY(BITSHADE_UNARY)
BITSHADE_UNARY(floor)
BITSHADE_UNARY(ceil)
BITSHADE_UNARY(trunc)
BITSHADE_UNARY(round)
BITSHADE_UNARY(rint)
BITSHADE_UNARY(nearbyint)
BITSHADE_UNARY(logb)
BITSHADE_BINARY(pow)
BITSHADE_BINARY(atan2)
BITSHADE_BINARY(hypot)
BITSHADE_BINARY(fmod)
BITSHADE_BINARY(remainder)
BITSHADE_BINARY(copysign)
BITSHADE_BINARY(nextafter)
BITSHADE_BINARY(fmin)
BITSHADE_BINARY(fmax)
BITSHADE_BINARY(fdim)
#undef BITSHADE_UNARY
#undef BITSHADE_BINARY

/// x 2^n, rounded once.
template <class F, rules R, class T, int N>
real<F, R, pack<T, N>> ldexp(const real<F, R, pack<T, N>>& x, int n) {
  return real<F, R, pack<T, N>>::from_carrier(detail::by_lanes<T, N>([n](auto u) { return ldexp(u, n); }, x));
}
template <class T, int N>
pack<T, N> ldexp(const pack<T, N>& x, int n) {
  return detail::by_lanes<T, N>([n](auto u) { return ldexp(u, n); }, x);
}
/// a b + c, each lane rounded once.
template <class T, int N>
pack<T, N> fma(const pack<T, N>& a, const pack<T, N>& b, const pack<T, N>& c) {
  return detail::by_lanes<T, N>([](auto u, auto v, auto w) { return fma(u, v, w); }, a, b, c);
}

template <class T, int N>
auto isnan(const pack<T, N>& x) {
  return x != x;
}
template <class T, int N>
auto isfinite(const pack<T, N>& x) {
  return x - x == pack<T, N>(0);
}
template <class T, int N>
auto isinf(const pack<T, N>& x) {
  return !(isnan(x) | isfinite(x));
}
template <class F, rules R, class T, int N>
auto isnan(const real<F, R, pack<T, N>>& x) {
  return isnan(x.carrier());
}
template <class F, rules R, class T, int N>
auto isfinite(const real<F, R, pack<T, N>>& x) {
  return isfinite(x.carrier());
}
template <class F, rules R, class T, int N>
auto isinf(const real<F, R, pack<T, N>>& x) {
  return isinf(x.carrier());
}

}  // namespace bitshade
