// What follows from an encoding, derived rather than typed in.
#pragma once

#include "bitshade/formats/encoding.hpp"

namespace bitshade {

constexpr int bias(const encoding& e) { return (1 << (e.exponent_bits - 1)) - 1; }
/// The exponent of the smallest normal number of a binary format.
constexpr int min_exponent(const encoding& e) { return 1 - bias(e); }
/// The exponent of the smallest positive number of a binary format: the unit of its subnormals.
constexpr int min_ulp_exponent(const encoding& e) { return min_exponent(e) - e.fraction_bits; }
/// Bits of the significand, the hidden one included.
constexpr int precision(const encoding& e) { return e.fraction_bits + 1; }

constexpr std::uint64_t sign_bit(const encoding& e) {
  return e.has_sign ? std::uint64_t{1} << (e.width - 1) : 0;
}
constexpr bool has_infinity(const encoding& e) { return e.kind == family::binary && e.special == specials::ieee; }
constexpr bool is_norm(const encoding& e) { return e.kind == family::unorm || e.kind == family::snorm; }
/// Steps of a norm from 0 to 1: the divisor of its codes.
constexpr std::uint64_t steps_to_one(const encoding& e) { return low_bits(e.fraction_bits); }
/// The exponent field, all ones: an infinity of an IEEE format.
constexpr std::uint64_t infinity_bits(const encoding& e) { return low_bits(e.exponent_bits) << e.fraction_bits; }

/// The largest code of a positive number.
constexpr std::uint64_t max_bits(const encoding& e) {
  switch (e.kind) {
    case family::binary:
      return e.special == specials::single_nan ? low_bits(e.exponent_bits + e.fraction_bits) - 1
                                               : infinity_bits(e) - 1;
    case family::unorm:
    case family::ufixed: return low_bits(e.width);
    case family::snorm:
    case family::fixed: return low_bits(e.width - 1);
  }
  return 0;
}
/// A positive quiet NaN with an empty payload; 0 for norms and fixed point, which have none.
constexpr std::uint64_t nan_bits(const encoding& e) {
  if (e.kind != family::binary) return 0;
  if (e.special == specials::single_nan) return low_bits(e.exponent_bits + e.fraction_bits);
  return infinity_bits(e) | (std::uint64_t{1} << (e.fraction_bits - 1));
}
constexpr std::uint64_t min_normal_bits(const encoding& e) {
  return e.kind == family::binary ? std::uint64_t{1} << e.fraction_bits : 1;
}

}  // namespace bitshade
