// C99 hexadecimal floats and bit patterns as text, the same in every locale.
#pragma once

#include <bit>
#include <string>

#include "bitshade/formats/wide_integer.hpp"

namespace bitshade {

/// "0x3c00": as many digits as the width needs.
inline std::string hexadecimal_bits(std::uint64_t bits, int width) {
  std::string out = "0x";
  for (int i = (width + 3) / 4 - 1; i >= 0; --i) out += "0123456789abcdef"[(bits >> (4 * i)) & 15];
  return out;
}

/// "-0x1.8p+1", with the leading digit 1 for subnormal numbers too; "0x0p+0", "inf", "nan".
inline std::string hexadecimal(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  std::string out = (bits >> 63) != 0 ? "-" : "";
  int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1023;
  std::uint64_t fraction = bits & low_bits(52);
  if (exponent == 1024) return out + (fraction != 0 ? "nan" : "inf");
  if (exponent == -1023) {
    if (fraction == 0) return out + "0x0p+0";
    const int zeros = std::countl_zero(fraction) - 11;
    fraction = (fraction << zeros) & low_bits(52);
    exponent = -1022 - zeros;
  }
  out += "0x1";
  if (fraction != 0) out += '.';
  for (; fraction != 0; fraction = (fraction << 4) & low_bits(52)) out += "0123456789abcdef"[fraction >> 48];
  out += exponent < 0 ? "p-" : "p+";
  return out + std::to_string(exponent < 0 ? -exponent : exponent);
}

}  // namespace bitshade
