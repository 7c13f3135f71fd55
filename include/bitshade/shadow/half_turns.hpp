// cos and sin of multiples of pi: the same bits on every machine, without a branch.
#pragma once

#include <array>
#include <cstddef>

#include "bitshade/shadow/exponential.hpp"

namespace bitshade {

/// cos(pi y) and sin(pi y).
template <class T>
struct half_turn {
  T cosine;
  T sine;
};

/// Largest absolute error of either number of half_turns, for |y| <= 2^50, in units of 2^-53.
inline constexpr double half_turns_error = 3;

namespace detail {

/// 1/n! up to the terms that half_turns needs.
inline constexpr std::array<double, 19> trigonometric_terms = [] {
  std::array<double, 19> result{};
  double factorial = 1;
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (n > 0) factorial *= static_cast<double>(n);
    result[n] = 1 / factorial;
  }
  return result;
}();

}  // namespace detail

/// cos(pi y), sin(pi y) by +, - and x alone.
///
///   y = 2j + r, |r| <= 1, folded to [0, 1/4]; there the series, whose own error is below 2^-60
///
/// Error    half_turns_error * 2^-53 absolute; both exact where y is a multiple of 1/2.
/// Failure  none for |y| <= 2^50.
/// Source   the addition theorems and Taylor's series.
constexpr half_turn<double> half_turns(double y) {
  constexpr double shifter = 0x1.8p52;
  constexpr double pi = 0x1.921fb54442d18p+1;
  const double r = y - 2 * ((y * 0.5 + shifter) - shifter);  // exact: both are multiples of y's ulp
  const double size = select(r < 0, -r, r);
  const double q = select(size > 0.5, 1 - size, size);  // sin(pi size) = sin(pi q)
  const double turned = select(q > 0.25, 0.5 - q, q);
  const double a = pi * turned, square = a * a;
  const auto& f = detail::trigonometric_terms;
  double sine = f[17], cosine = f[18];
  for (std::size_t n = 15; n < 17; n -= 2) sine = f[n] - square * sine;
  for (std::size_t n = 16; n < 18; n -= 2) cosine = f[n] - square * cosine;
  sine = sine * a;
  const double folded_sine = select(q > 0.25, cosine, sine);
  const double folded_cosine = select(q > 0.25, sine, cosine);
  return {select(size > 0.5, -folded_cosine, folded_cosine),
          select(r < 0, -folded_sine, folded_sine)};
}

/// cos(n pi x) and sin(n pi x) in T: an enclosure type brings its own.
///
/// Error    n x is exact for an x of at most 53 - log2(n) bits; then half_turns' error and one
///          rounding to T.
template <class T>
constexpr half_turn<T> half_turns(const T& x, int n) {
  const half_turn<double> at = half_turns(static_cast<double>(x) * n);
  return {static_cast<T>(at.cosine), static_cast<T>(at.sine)};
}

/// 1/(pi n), rounded once to binary64 and to T; the argument chooses the type.
template <class T>
constexpr T inverse_half_turns(const T&, int n) {
  return static_cast<T>(0x1.45f306dc9c883p-2 / n);
}

}  // namespace bitshade
