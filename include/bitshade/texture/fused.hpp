// a*b + c rounded once, for every number type, without the processor's help.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace bitshade {

/// a*b + c in binary32, rounded once to nearest even.
///
///   the product is exact in binary64; the sum is rounded there to odd, which makes the second
///   rounding innocuous (53 >= 24 + 2)
///
/// Error    none beyond the one rounding, subnormal results included.
/// Source   [BoldoMelquiond08] theorem 2.
inline float fused(float a, float b, float c) {
  const double product = static_cast<double>(a) * static_cast<double>(b);
  const double addend = static_cast<double>(c);
  double sum = product + addend;
  const double part = sum - product;
  const double error = (product - (sum - part)) + (addend - part);
  // A NaN error means an infinite or NaN sum, which needs no correction.
  if (error < 0 || error > 0) {
    auto bits = std::bit_cast<std::uint64_t>(sum);
    if ((bits & 1) == 0) {
      bits += ((error > 0) == (sum > 0)) ? 1 : std::uint64_t(-1);
      sum = std::bit_cast<double>(bits);
    }
  }
  return static_cast<float>(sum);
}

/// The same for other types: their own fma where they have one, else a*b + c (exact types).
template <class T>
T fused(const T& a, const T& b, const T& c) {
  if constexpr (std::is_floating_point_v<T>)
    return std::fma(a, b, c);
  else if constexpr (requires { fma(a, b, c); })
    return fma(a, b, c);
  else
    return a * b + c;
}

}  // namespace bitshade
