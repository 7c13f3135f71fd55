// exp, log2 and floor whose bits are the same on every machine.
//
// libm's bits change with the processor and the library's version, so kernel weights, levels of
// detail and probe tables would too. These use +, -, * and / of binary64 alone.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace bitshade {

/// Largest error of exp_fixed relative to e^x, for x in [-700, 700], in units of 2^-53.
inline constexpr double exp_fixed_error = 4;
/// Largest absolute error of log2_fixed plus its error relative to the result, in units of 2^-53.
inline constexpr double log2_fixed_error = 4;

/// e^x, deterministic.
///
///   x = k ln 2 + r, |r| <= (ln 2)/2;  e^x = 2^k (1 + r + r^2/2! + .. + r^13/13!)
///
/// Error    exp_fixed_error * 2^-53 relative (the series' own is 4e-18).
/// Failure  none for |x| <= 700; below it 0, above it infinity; NaN stays NaN.
constexpr double exp_fixed(double x) {
  if (!(x >= -700)) return x < -700 ? 0.0 : x;
  if (x > 700) return std::bit_cast<double>(std::uint64_t{0x7ff0000000000000});
  constexpr double ln2_high = 0x1.62e42fefa3800p-1;  // 42 bits, so that k * ln2_high is exact
  constexpr double ln2_low = 0x1.ef35793c76730p-45;
  const double scaled = x * 0x1.71547652b82fep+0;
  const int k = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1;
  for (int n = 13; n >= 1; --n) sum = 1 + sum * (r / n);
  // 2^k in one step: |k| <= 1010 keeps it normal.
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

/// log2 x, deterministic; exact for powers of two.
///
///   x = 2^k m, m in [sqrt(1/2), sqrt(2));  log2 m = 2/ln 2 * artanh(s), s = (m-1)/(m+1)
///
/// Error    log2_fixed_error * 2^-53 * (1 + |log2 x|).
/// Failure  -infinity for 0, NaN for what has no logarithm.
constexpr double log2_fixed(double x) {
  if (x == 0) return -std::bit_cast<double>(std::uint64_t{0x7ff0000000000000});
  if (!(x > 0)) return std::bit_cast<double>(std::uint64_t{0x7ff8000000000000});
  if (x > 0x1.fffffffffffffp+1023) return x;
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  auto bits = std::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52) - 1023;
  bits = (bits & 0xfffffffffffff) | 0x3ff0000000000000;
  double m = std::bit_cast<double>(bits);
  if (m > 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    ++k;
  }
  const double s = (m - 1) / (m + 1);
  const double square = s * s;  // <= 0.0295; 11 terms leave square^12/25 < 2e-20
  double sum = 0;
  for (int n = 23; n >= 3; n -= 2) sum = (sum + 1.0 / n) * square;
  return k + 0x1.71547652b82fep+1 * (s + s * sum);
}

/// Largest index magnitude that texel_floor returns; coordinates beyond it are clamped to it.
inline constexpr int max_texel_index = 1 << 30;

/// Whether a floor is where texel_floor stops: the number itself may lie anywhere beyond, so that
/// nothing is known of its distance from there.
constexpr bool beyond_indices(int floor) {
  return floor == max_texel_index || floor == -max_texel_index;
}

/// floor(x) as an index, for any ordered number T.
///
/// Shapes   any x; the result lies within +-max_texel_index; NaN gives 0.
/// Policy   exact for every T, rationals included: the guess through double is corrected by
///          comparisons in T.
template <class T>
constexpr int texel_floor(const T& x) {
  const double wide = static_cast<double>(x);
  if (!(wide > -max_texel_index)) return wide == wide ? -max_texel_index : 0;
  if (wide >= max_texel_index) return max_texel_index;
  int i = static_cast<int>(wide);
  if (i > wide) --i;
  if constexpr (!std::is_floating_point_v<T>) {
    // A conversion that rounds can only err to a neighbouring integer.
    if (x < static_cast<T>(i))
      --i;
    else if (!(x < static_cast<T>(i + 1)))
      ++i;
  }
  return i;
}

}  // namespace bitshade
