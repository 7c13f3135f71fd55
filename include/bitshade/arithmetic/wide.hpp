// Unsigned integers of a fixed, known width: what exact kernels compute in when a proof bounds
// every value's bits. Nothing is checked and nothing is allocated.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "bitshade/formats/wide_integer.hpp"

namespace bitshade {

/// An unsigned integer of 64 * Limbs bits, least significant limb first.
///
/// Policy   wraps like any unsigned integer; a caller proves that nothing is lost.
template <std::size_t Limbs>
struct wide {
  std::array<std::uint64_t, Limbs> limb{};

  constexpr wide() = default;
  constexpr wide(std::uint64_t value) { limb[0] = value; }
  constexpr wide(uint128 value) requires(Limbs >= 2) {
    limb[0] = static_cast<std::uint64_t>(value);
    limb[1] = static_cast<std::uint64_t>(value >> 64);
  }
  /// Widening: no bit is lost.
  template <std::size_t Fewer>
  requires(Fewer < Limbs) constexpr wide(const wide<Fewer>& other) {
    for (std::size_t i = 0; i < Fewer; ++i) limb[i] = other.limb[i];
  }

  constexpr wide& operator+=(const wide& other) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      const uint128 sum = static_cast<uint128>(limb[i]) + other.limb[i] + carry;
      limb[i] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    return *this;
  }
  constexpr wide& operator-=(const wide& other) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      const uint128 rest = static_cast<uint128>(limb[i]) - other.limb[i] - borrow;
      limb[i] = static_cast<std::uint64_t>(rest);
      borrow = static_cast<std::uint64_t>(rest >> 64) & 1;
    }
    return *this;
  }
  friend constexpr wide operator+(wide a, const wide& b) { return a += b; }
  friend constexpr wide operator-(wide a, const wide& b) { return a -= b; }

  friend constexpr wide operator<<(const wide& a, int bits) {
    wide result;
    const auto whole = static_cast<std::size_t>(bits / 64);
    const int part = bits % 64;
    for (std::size_t i = Limbs; i-- > whole;) {
      result.limb[i] = a.limb[i - whole] << part;
      if (part != 0 && i > whole) result.limb[i] |= a.limb[i - whole - 1] >> (64 - part);
    }
    return result;
  }

  friend constexpr wide operator>>(const wide& a, int bits) {
    wide result;
    const auto whole = static_cast<std::size_t>(bits / 64);
    const int part = bits % 64;
    for (std::size_t i = 0; i + whole < Limbs; ++i) {
      result.limb[i] = a.limb[i + whole] >> part;
      if (part != 0 && i + whole + 1 < Limbs) {
        result.limb[i] |= a.limb[i + whole + 1] << (64 - part);
      }
    }
    return result;
  }

  friend constexpr bool operator==(const wide&, const wide&) = default;
  friend constexpr std::strong_ordering operator<=>(const wide& a, const wide& b) {
    for (std::size_t i = Limbs; i-- > 0;) {
      if (a.limb[i] != b.limb[i]) return a.limb[i] <=> b.limb[i];
    }
    return std::strong_ordering::equal;
  }

  constexpr int bit_length() const {
    for (std::size_t i = Limbs; i-- > 0;) {
      if (limb[i] != 0) return static_cast<int>(64 * i) + static_cast<int>(std::bit_width(limb[i]));
    }
    return 0;
  }
};

/// The full product: no bit is lost.
template <std::size_t A, std::size_t B>
constexpr wide<A + B> operator*(const wide<A>& a, const wide<B>& b) {
  wide<A + B> product;
  for (std::size_t i = 0; i < A; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < B; ++j) {
      const uint128 sum = static_cast<uint128>(a.limb[i]) * b.limb[j] + product.limb[i + j] + carry;
      product.limb[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    product.limb[i + B] = carry;
  }
  return product;
}

/// Limbs that hold `bits` bits.
constexpr std::size_t limbs_for(int bits) { return static_cast<std::size_t>((bits + 63) / 64); }

/// The same number in fewer limbs; the caller proves that the others are zero.
template <std::size_t To, std::size_t From>
constexpr wide<To> narrowed(const wide<From>& a) {
  wide<To> result;
  for (std::size_t i = 0; i < To && i < From; ++i) result.limb[i] = a.limb[i];
  return result;
}

namespace detail {

/// The `Width` highest bits of a, the first of them set; a != 0.
template <class Word, int Width, std::size_t Limbs>
constexpr Word leading_bits(const wide<Limbs>& a) {
  const int drop = a.bit_length() - Width;
  Word bits = 0;
  for (std::size_t i = 0; i < Limbs; ++i) {
    const int place = static_cast<int>(64 * i) - drop;  // of this limb's lowest bit
    if (place >= Width || place <= -64) continue;
    bits |=
        place >= 0 ? static_cast<Word>(a.limb[i]) << place : static_cast<Word>(a.limb[i] >> -place);
  }
  return bits;
}

/// significand * 2^exponent to the nearest binary64, ties to even; `sticky` says that the true
/// number lies strictly between significand and significand + 1. The significand has 63 or 64 bits.
constexpr double round_to_double(std::uint64_t significand, bool sticky, int exponent) {
  const int width = static_cast<int>(std::bit_width(significand));
  const int drop = width - 53;
  std::uint64_t kept = significand >> drop;
  const std::uint64_t rest = significand & ((std::uint64_t{1} << drop) - 1);
  const std::uint64_t half = std::uint64_t{1} << (drop - 1);
  if (rest > half || (rest == half && (sticky || (kept & 1) != 0))) ++kept;
  // kept * 2^(exponent + drop): exact, since no result of quotient_to_double is subnormal.
  double value = static_cast<double>(kept);
  int scale = exponent + drop;
  const auto power = [](int e) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
  };
  for (; scale < -1000; scale += 1000) value *= power(-1000);
  for (; scale > 1000; scale -= 1000) value *= power(1000);
  return value * power(scale);
}

}  // namespace detail

/// num / den rounded once to binary64, ties to even.
///
/// Shapes   any num; den != 0.
/// Error    correctly rounded.
/// Failure  none while the quotient is a normal number or zero: a promise that widths below
///          1,000 bits keep.
template <std::size_t Limbs>
constexpr double quotient_to_double(const wide<Limbs>& num, const wide<Limbs>& den) {
  const int n = num.bit_length();
  if (n == 0) return 0;
  const int d = den.bit_length();
  // With A the 127 leading bits of num and B the 64 of den, num/den * 2^k lies in
  // (A/(B+1), (A+1)/B), hence in [q-2, q+2) for q = floor(A/B), since q < 2^64 and B >= 2^63.
  const auto a = detail::leading_bits<uint128, 127>(num);
  const auto b = detail::leading_bits<std::uint64_t, 64>(den);
  const auto q = static_cast<std::uint64_t>(a / b);
  const int exponent = (n - 127) - (d - 64);
  if (q >= (std::uint64_t{1} << 62) + 2 && q <= ~std::uint64_t{2}) {
    const double low = detail::round_to_double(q - 2, true, exponent);
    const double high = detail::round_to_double(q + 1, true, exponent);
    if (low == high) return low;
  }
  // Too close to call: one bit after the other, num and den aligned at their leading bits.
  const auto aligned = [](const wide<Limbs>& x, int length, int to) {
    return wide<Limbs + 1>(x) << (to - length);
  };
  const int top = n > d ? n : d;
  wide<Limbs + 1> rest = aligned(num, n, top);
  const wide<Limbs + 1> unit = aligned(den, d, top);
  int scale = n - d;
  if (rest < unit) {
    rest = rest << 1;
    --scale;
  }
  std::uint64_t bits = 0;
  for (int i = 0; i < 64; ++i) {
    bits <<= 1;
    if (rest >= unit) {
      bits |= 1;
      rest -= unit;
    }
    rest = rest << 1;
  }
  return detail::round_to_double(bits, rest != wide<Limbs + 1>{}, scale - 63);
}

}  // namespace bitshade
