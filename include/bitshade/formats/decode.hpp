// Bits to numbers, again by integers alone.
#pragma once

#include "bitshade/formats/encode.hpp"

namespace bitshade {

/// c / (2^bits - 1), rounded once to another encoding.
///
/// The binary expansion of that ratio is c's digits, repeated for ever, so no division is needed: 128 of them,
/// and the certainty that some follow, decide every rounding.
constexpr std::uint64_t norm_to(const encoding& to, bool negative, std::uint64_t c, int bits, const rules& r = {},
                                std::uint64_t random = 0) {
  if (c == 0) return 0;
  if (c >= low_bits(bits)) return encode_scaled(to, negative, 1, 0, false, r, random);
  uint128 digits = c;
  int have = bits;
  for (; have <= 64; have *= 2) digits |= digits << have;
  return encode_scaled(to, negative, digits, -have, true, r, random);
}

/// The number that the bits stand for; bits above the width are ignored.
///
/// Error    none for binary formats and fixed point of at most 53 bits; otherwise the nearest binary64.
constexpr double decode(const encoding& e, std::uint64_t bits) {
  constexpr encoding wide = binary_encoding(11, 52);
  bits &= low_bits(e.width);
  const bool negative = (bits & sign_bit(e)) != 0;
  std::uint64_t magnitude = bits;
  if (e.kind == family::snorm || e.kind == family::fixed) {
    if (negative) magnitude = (~bits + 1) & low_bits(e.width);
  } else {
    magnitude &= ~sign_bit(e);
  }
  switch (e.kind) {
    case family::binary: {
      const std::uint64_t sign = negative ? sign_bit(wide) : 0;
      if (magnitude > max_bits(e)) {
        if (has_infinity(e) && magnitude == infinity_bits(e)) return std::bit_cast<double>(sign | infinity_bits(wide));
        const std::uint64_t payload =
            e.special == specials::single_nan ? 0 : (magnitude & low_bits(e.fraction_bits)) << (52 - e.fraction_bits);
        return std::bit_cast<double>(sign | infinity_bits(wide) | (payload ? payload : nan_bits(wide)));
      }
      const std::uint64_t field = magnitude >> e.fraction_bits;
      if (field != 0) {
        return std::bit_cast<double>(sign + (magnitude << (52 - e.fraction_bits)) +
                                     (static_cast<std::uint64_t>(bias(wide) - bias(e)) << 52));
      }
      return std::bit_cast<double>(encode_scaled(wide, negative, magnitude, min_ulp_exponent(e), false, {}, 0));
    }
    case family::unorm: return std::bit_cast<double>(norm_to(wide, false, magnitude, e.width));
    case family::snorm: return std::bit_cast<double>(norm_to(wide, negative, magnitude, e.width - 1));
    case family::ufixed:
    case family::fixed:
      return std::bit_cast<double>(encode_scaled(wide, negative, magnitude, -e.fraction_bits, false, {}, 0));
  }
  return 0;
}

/// The same as a device reads it: subnormal operands flushed, norms by a reciprocal, if r says so.
constexpr double decode(const encoding& e, std::uint64_t bits, const rules& r) {
  if (e.kind == family::binary && flushes_input(r.subnormal)) {
    const std::uint64_t magnitude = bits & low_bits(e.width) & ~sign_bit(e);
    if (magnitude < min_normal_bits(e)) return decode(e, bits & sign_bit(e));
  }
  if ((e.kind == family::unorm || e.kind == family::snorm) && r.norm == norm_decode::reciprocal) {
    constexpr encoding single = binary_encoding(8, 23);
    const int digits = e.kind == family::unorm ? e.width : e.width - 1;
    const bool negative = (bits & sign_bit(e)) != 0;
    const std::uint64_t code = negative ? (~bits + 1) & low_bits(e.width) : bits & low_bits(e.width);
    const std::uint64_t clamped = code < low_bits(digits) ? code : low_bits(digits);
    // The device multiplies two binary32 numbers: the code rounded, and the reciprocal rounded.
    const std::uint64_t step = norm_to(single, false, 1, digits);
    const std::uint64_t count = encode_scaled(single, false, clamped, 0, false, {}, 0);
    if (count == 0) return 0;
    const auto significand = [](std::uint64_t b) { return (b & low_bits(23)) | (1u << 23); };
    const auto exponent = [](std::uint64_t b) { return static_cast<std::int64_t>(b >> 23) - 150; };
    const uint128 product = uint128{significand(step)} * significand(count);
    return decode(single, encode_scaled(single, negative, product, exponent(step) + exponent(count), false, {}, 0));
  }
  return decode(e, bits);
}

}  // namespace bitshade
