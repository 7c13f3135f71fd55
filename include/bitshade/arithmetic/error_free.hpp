// Error-free transforms: an operation's result and, exactly, what its rounding left out.
#pragma once

#include "bitshade/formats/contract.hpp"

namespace bitshade {

/// value + error is the exact result of the operation.
template <class T>
struct with_error {
  T value;
  T error;
};

/// a + b. Exact to nearest, unless it overflows. Six operations, no branch: T may be a pack.
/// Source   [Knuth97] 4.2.2, theorem B.
template <class T>
constexpr with_error<T> two_sum(const T& a, const T& b) {
  const T s = a + b;
  const T back = s - a;
  return {s, (a - (s - back)) + (b - back)};
}

/// a + b where |a| >= |b| or a = 0. Source [Dekker71].
template <class T>
constexpr with_error<T> fast_two_sum(const T& a, const T& b) {
  const T s = a + b;
  return {s, b - (s - a)};
}

/// a's leading and trailing half, `splitter` = 2^ceil(p/2) + 1: 4097 for binary32, 134217729 for binary64.
/// Exact while splitter * a does not overflow. Source [Dekker71].
template <class T>
constexpr with_error<T> split(const T& a, const T& splitter) {
  const T c = splitter * a;
  const T high = c - (c - a);
  return {high, a - high};
}

/// a * b, without fma, so that every processor gives the same bits.
/// Exact unless something overflows or the error falls below the smallest number. Source [Dekker71].
template <class T>
constexpr with_error<T> two_product(const T& a, const T& b, const T& splitter) {
  const T p = a * b;
  const auto x = split(a, splitter), y = split(b, splitter);
  return {p, ((x.value * y.value - p) + x.value * y.error + x.error * y.value) + x.error * y.error};
}
constexpr with_error<float> two_product(float a, float b) { return two_product(a, b, 4097.0f); }
constexpr with_error<double> two_product(double a, double b) { return two_product(a, b, 134217729.0); }

}  // namespace bitshade
