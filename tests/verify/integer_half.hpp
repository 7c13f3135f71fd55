// binary16 in integers of one fixed unit, 2^-48: a b + c is then one multiplication and one addition, and rounding is
// a look at the bits that are left over. Written for these programs alone: it shares no code with bitshade.
#pragma once

#include <bit>
#include <cstdint>

#include "bitshade/formats/rounding.hpp"

namespace integer_half {

__extension__ typedef __int128 wide;
__extension__ typedef unsigned __int128 unsigned_wide;

inline bool is_nan(std::uint16_t h) { return (h & 0x7fff) > 0x7c00; }
inline bool is_infinite(std::uint16_t h) { return (h & 0x7fff) == 0x7c00; }

/// A finite number in units of 2^-24, the smallest subnormal.
inline std::int64_t units(std::uint16_t h) {
  const int field = (h >> 10) & 31;
  const std::int64_t m = field == 0 ? h & 0x3ff : static_cast<std::int64_t>((h & 0x3ff) | 0x400) << (field - 1);
  return (h & 0x8000) != 0 ? -m : m;
}

/// n 2^-48, not 0, to binary16; overflow as IEEE 754 has it.
inline std::uint16_t rounded(wide n, bitshade::rounding direction) {
  using bitshade::rounding;
  const bool negative = n < 0;
  const auto size = static_cast<unsigned_wide>(negative ? -n : n);
  const auto high = static_cast<std::uint64_t>(size >> 64);
  const int width = high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<std::uint64_t>(size));
  // One code is 2^drop units: 2^24 among the subnormals, more from twice the smallest normal number on.
  const int drop = width > 35 ? width - 11 : 24;
  auto code = static_cast<std::uint32_t>(size >> drop);
  const unsigned_wide left = size & ((unsigned_wide{1} << drop) - 1), half = unsigned_wide{1} << (drop - 1);
  bool away = false;
  switch (direction) {
    case rounding::nearest_even: away = left > half || (left == half && (code & 1) != 0); break;
    case rounding::nearest_away: away = left >= half; break;
    case rounding::toward_zero: away = false; break;
    case rounding::up: away = left != 0 && !negative; break;
    case rounding::down: away = left != 0 && negative; break;
    case rounding::to_odd: away = left != 0 && (code & 1) == 0; break;
    case rounding::stochastic: break;
  }
  code += away ? 1 : 0;
  code += static_cast<std::uint32_t>(drop - 24) << 10;
  if (code > 0x7bff) {
    const bool infinite = direction == rounding::nearest_even || direction == rounding::nearest_away ||
                          (direction == rounding::up && !negative) || (direction == rounding::down && negative);
    code = infinite ? 0x7c00 : 0x7bff;
  }
  return static_cast<std::uint16_t>(code | (negative ? 0x8000u : 0u));
}

/// a b + c, rounded once; every NaN is 0x7e00.
inline std::uint16_t fma(std::uint16_t a, std::uint16_t b, std::uint16_t c, bitshade::rounding direction) {
  if (is_nan(a) || is_nan(b) || is_nan(c)) return 0x7e00;
  const auto sign = static_cast<std::uint16_t>((a ^ b) & 0x8000);
  if (is_infinite(a) || is_infinite(b)) {
    if ((a & 0x7fff) == 0 || (b & 0x7fff) == 0) return 0x7e00;
    if (is_infinite(c) && (c & 0x8000) != sign) return 0x7e00;
    return static_cast<std::uint16_t>(sign | 0x7c00);
  }
  if (is_infinite(c)) return c;
  const wide sum = static_cast<wide>(units(a)) * units(b) + (static_cast<wide>(units(c)) << 24);
  if (sum != 0) return rounded(sum, direction);
  // Zeros of one sign keep it; a sum that cancels, and zeros of unlike signs, are +0, toward -infinity -0.
  const bool zeros = (c & 0x7fff) == 0;
  if (zeros && (c & 0x8000) == sign) return c;
  return direction == bitshade::rounding::down ? 0x8000 : 0;
}

}  // namespace integer_half
