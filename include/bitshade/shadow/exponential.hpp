// e^x for warps: the same bits on every machine, a row of them at vector speed.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/select.hpp"

namespace bitshade {

/// Largest error of exp_of_double relative to e^x, for |x| <= 700, in units of 2^-53.
inline constexpr double exp_of_double_error = 3;

namespace detail {

/// 1/n!, each rounded once: n! is exact in binary64 as far as 18!.
inline constexpr std::array<double, 14> inverse_factorials = [] {
  std::array<double, 14> result{};
  double factorial = 1;
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (n > 0) factorial *= static_cast<double>(n);
    result[n] = 1 / factorial;
  }
  return result;
}();

}  // namespace detail

/// e^x by +, -, x and integer operations alone; no branch, so that compilers make vectors of it.
///
///   x = k ln 2 + r, |r| <= (ln 2)/2;  e^x = 2^k (1 + r + r^2/2! + .. + r^13/13!)
///
/// Error    exp_of_double_error * 2^-53 relative (the series' own is 4e-18).
/// Failure  none for |x| <= 700; 0 below, infinity above, NaN stays NaN.
constexpr double exp_of_double(double x) {
  constexpr double shifter = 0x1.8p52;               // adding it leaves the nearest integer
  constexpr double ln2_high = 0x1.62e42fefa3800p-1;  // 42 bits, so that k * ln2_high is exact
  constexpr double ln2_low = 0x1.ef35793c76730p-45;
  const double inside = select(x < -700, -700.0, select(x > 700, 700.0, x));
  const double shifted = inside * 0x1.71547652b82fep+0 + shifter;
  const double k = shifted - shifter;
  const double r = (inside - k * ln2_high) - k * ln2_low;
  const auto& c = detail::inverse_factorials;
  double sum = c[13];
  for (std::size_t n = 13; n-- > 0;) sum = c[n] + r * sum;
  // The low bits of `shifted` are k: moved into the exponent, they multiply by 2^k.
  const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52) +
                                             (std::uint64_t{1023} << 52));
  const double infinity = std::bit_cast<double>(std::uint64_t{0x7ff} << 52);
  return select(x < -700, 0.0, select(x > 700, infinity, sum * scale));
}

/// e^x in T: real's own, correctly rounded; an enclosure type's own; else binary64's above.
///
/// Error    float: one rounding after exp_of_double_error; double: exp_of_double_error.
template <class T>
constexpr T exponential(const T& x) {
  if constexpr (requires { typename T::format_type; }) {
    return exp(x);
  } else {
    return static_cast<T>(exp_of_double(static_cast<double>(x)));
  }
}

}  // namespace bitshade
