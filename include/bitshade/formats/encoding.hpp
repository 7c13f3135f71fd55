// A number format is plain data: usable as a template argument and at run time alike.
#pragma once

#include <cstdint>
#include <type_traits>

#include "bitshade/formats/contract.hpp"
#include "bitshade/formats/wide_integer.hpp"

namespace bitshade {

enum class family : std::uint8_t { binary, unorm, snorm, ufixed, fixed };

/// What the largest exponent of a binary format means.
enum class specials : std::uint8_t {
  ieee,       ///< infinities, and NaN with a payload
  single_nan  ///< OCP FP8 e4m3: no infinities, one NaN a sign, the rest are numbers
};

/// What a bit pattern means.
///
///   binary   (-1)^s 2^(e-bias) 1.f, subnormals at the bottom   exponent_bits E, fraction_bits M
///   unorm    c / (2^N - 1)                                     fraction_bits N
///   snorm    max(c, -max) / max, max = 2^(N-1) - 1             fraction_bits N - 1
///   ufixed   c / 2^F                                           fraction_bits F, width I + F
///   fixed    c / 2^F, two's complement                         the same, I counts the sign
///
/// Source   [IEEE754] 3.4, [Vulkan] "fixed-point", [OFP8].
struct encoding {
  family kind = family::binary;
  int exponent_bits = 0;
  int fraction_bits = 0;
  int width = 0;
  specials special = specials::ieee;
  bool has_sign = true;  ///< of a binary format; R11G11B10's components have none

  friend constexpr bool operator==(const encoding&, const encoding&) = default;
};

constexpr encoding binary_encoding(int exponent_bits, int fraction_bits) {
  return {family::binary, exponent_bits, fraction_bits, 1 + exponent_bits + fraction_bits,
          specials::ieee, true};
}
constexpr encoding unsigned_binary_encoding(int exponent_bits, int fraction_bits) {
  return {family::binary, exponent_bits, fraction_bits, exponent_bits + fraction_bits,
          specials::ieee, false};
}
constexpr encoding unorm_encoding(int bits) {
  return {family::unorm, 0, bits, bits, specials::ieee, false};
}
constexpr encoding snorm_encoding(int bits) {
  return {family::snorm, 0, bits - 1, bits, specials::ieee, true};
}
constexpr encoding ufixed_encoding(int integer_bits, int fraction_bits) {
  return {family::ufixed, 0, fraction_bits, integer_bits + fraction_bits, specials::ieee, false};
}
constexpr encoding fixed_encoding(int integer_bits, int fraction_bits) {
  return {family::fixed, 0, fraction_bits, integer_bits + fraction_bits, specials::ieee, true};
}
constexpr encoding e4m3_encoding() {
  return {family::binary, 4, 3, 8, specials::single_nan, true};
}

/// Whether an encoding lies in the range that encode and decode are defined and tested for.
constexpr bool is_valid(const encoding& e) {
  switch (e.kind) {
    case family::binary:
      return e.exponent_bits >= 2 && e.exponent_bits <= 11 && e.fraction_bits >= 1 &&
             e.fraction_bits <= 52 && e.width == (e.has_sign ? 1 : 0) + e.exponent_bits + e.fraction_bits;
    case family::unorm: return e.width >= 1 && e.width <= 32 && e.fraction_bits == e.width;
    case family::snorm: return e.width >= 2 && e.width <= 32 && e.fraction_bits == e.width - 1;
    case family::ufixed: return e.fraction_bits >= 0 && e.width >= 1 && e.width <= 64 && e.width >= e.fraction_bits;
    case family::fixed: return e.fraction_bits >= 0 && e.width >= 2 && e.width <= 64 && e.width > e.fraction_bits;
  }
  return false;
}

/// An encoding as a type, for templates.
template <encoding E>
struct format {
  static_assert(is_valid(E), "bitshade: binary<E, M> needs 2 <= E <= 11 and 1 <= M <= 52, unorm<N> 1 <= N <= 32, "
                             "snorm<N> 2 <= N <= 32, fixed<I, F> at most 64 bits with I >= 1");
  static constexpr encoding value = E;
  using bits_type = std::conditional_t<
      E.width <= 8, std::uint8_t,
      std::conditional_t<E.width <= 16, std::uint16_t,
                         std::conditional_t<E.width <= 32, std::uint32_t, std::uint64_t>>>;
};

template <int E, int M> using binary = format<binary_encoding(E, M)>;
template <int N> using unorm = format<unorm_encoding(N)>;
template <int N> using snorm = format<snorm_encoding(N)>;
template <int I, int F> using ufixed = format<ufixed_encoding(I, F)>;
template <int I, int F> using fixed = format<fixed_encoding(I, F)>;

using binary16 = binary<5, 10>;
using bfloat16 = binary<8, 7>;
using tf32 = binary<8, 10>;
using binary32 = binary<8, 23>;
using binary64 = binary<11, 52>;
using fp8_e5m2 = binary<5, 2>;
using fp8_e4m3 = format<e4m3_encoding()>;
using unorm8 = unorm<8>;
using unorm16 = unorm<16>;
using unorm24 = unorm<24>;
using snorm16 = snorm<16>;

}  // namespace bitshade
