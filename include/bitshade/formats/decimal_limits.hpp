// What std::numeric_limits says of decimal digits and exponents, from an encoding.
#pragma once

#include "bitshade/formats/limits.hpp"
#include "bitshade/formats/natural.hpp"

namespace bitshade {

/// floor(n log10 2) for 0 <= n <= 2^11: 30103/100000 exceeds log10 2 by 4.4e-9, and n log10 2 stays 4e-4 below the next
/// integer.
constexpr int decimals_of_bits(int n) { return n * 30103 / 100000; }

/// Decimal digits that every number of a format's precision keeps; norms and fixed point: of their codes.
constexpr int decimal_digits(int precision) { return decimals_of_bits(precision - 1); }
/// Decimal digits that tell all numbers of a precision apart.
constexpr int distinguishing_digits(int precision) { return 2 + decimals_of_bits(precision); }

/// The least n for which 10^n is at least the smallest normal number of a binary format.
constexpr int min_exponent10(const encoding& e) { return -decimals_of_bits(-min_exponent(e)); }

/// The greatest n for which 10^n is at most the largest finite number of a binary format, compared exactly: 2^256 lies
/// above 10^77, and so does the largest number of e9m2, but not that of e9m1.
constexpr int max_exponent10(const encoding& e) {
  const std::uint64_t code = max_bits(e);
  const auto field = static_cast<int>(code >> e.fraction_bits);
  const int scale = field - 1 + min_ulp_exponent(e);
  natural largest((code & low_bits(e.fraction_bits)) | (std::uint64_t{1} << e.fraction_bits)), power(1);
  const int n = decimals_of_bits(scale + precision(e));
  power.multiply_power_of_5(n);
  power.shift_left(n - scale);
  largest.shift_left(scale - n);
  return largest.less_than(power) ? n - 1 : n;
}

}  // namespace bitshade
