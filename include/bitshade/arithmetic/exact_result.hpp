// An operation's exact result before it is rounded: integers, so that nothing in the environment reaches it.
#pragma once

#include <bit>
#include <type_traits>

#include "bitshade/formats/decode.hpp"

namespace bitshade {

/// (-1)^negative n 2^exponent (+ something below n's last bit if sticky), an infinity, or a NaN.
///
/// Where sticky, n has at least 117 bits: 53 of a significand and 64 for stochastic rounding.
struct exact_result {
  enum class kind : std::uint8_t { finite, infinite, nan };
  kind what = kind::finite;
  bool negative = false;
  uint128 n = 0;
  std::int64_t exponent = 0;
  bool sticky = false;

  constexpr bool is_zero() const { return what == kind::finite && n == 0 && !sticky; }
  constexpr bool is_finite() const { return what == kind::finite; }

  static constexpr exact_result nan() { return {kind::nan, false, 0, 0, false}; }
  static constexpr exact_result infinity(bool negative) { return {kind::infinite, negative, 0, 0, false}; }
  static constexpr exact_result zero(bool negative) { return {kind::finite, negative, 0, 0, false}; }
};

/// A double as it is.
constexpr exact_result unpack(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const bool negative = (bits >> 63) != 0;
  const int field = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction = bits & low_bits(52);
  if (field == 0x7ff) return fraction != 0 ? exact_result::nan() : exact_result::infinity(negative);
  const std::uint64_t n = field == 0 ? fraction : fraction | (std::uint64_t{1} << 52);
  return {exact_result::kind::finite, negative, n, (field == 0 ? 1 : field) - 1075, false};
}

/// A longer floating-point number as it is: x87's, or binary128 where the compiler has it. Every step is exact in T,
/// whatever direction it rounds in.
template <class T>
constexpr exact_result unpack_longer(T x) {
  if (x != x) return exact_result::nan();
  if (x == 0) return unpack(static_cast<double>(x));
  const bool negative = x < 0;
  if (negative) x = -x;
  if (x - x != 0) return exact_result::infinity(negative);
  T power[14] = {2};  // 2^(2^i)
  for (int i = 1; i < 14; ++i) power[i] = power[i - 1] * power[i - 1];
  std::int64_t exponent = 0;
  for (int i = 13; i >= 0; --i) {
    if (x >= power[i]) x /= power[i], exponent += std::int64_t{1} << i;
    else if (x < 1 && x * power[i] < 2) x *= power[i], exponent -= std::int64_t{1} << i;
  }
  // From 1 to 2, or subnormal and less: the last bit of binary128, 2^-16494, is 2^-111 by now, of the 127 that follow.
  x *= static_cast<T>(std::uint64_t{1} << 63);
  const auto high = static_cast<std::uint64_t>(x);
  x = (x - static_cast<T>(high)) * static_cast<T>(std::uint64_t{1} << 32) * static_cast<T>(std::uint64_t{1} << 32);
  return {exact_result::kind::finite, negative, uint128{high} << 64 | static_cast<std::uint64_t>(x), exponent - 127, false};
}

/// Any number of the language's as it is.
template <class T>
  requires std::is_arithmetic_v<T>
constexpr exact_result unpack_any(T x) {
  if constexpr (std::is_integral_v<T>) {
    const auto n = static_cast<uint128>(x);
    return {exact_result::kind::finite, x < 0, x < 0 ? ~n + 1 : n, 0, false};
  } else if constexpr (sizeof(T) <= sizeof(double)) {
    return unpack(static_cast<double>(x));
  } else {
    return unpack_longer(x);
  }
}

/// Its bits in a binary or fixed-point format; NaN is the canonical one.
constexpr std::uint64_t round_result(const encoding& e, const exact_result& x, const rules& r,
                                     std::uint64_t random = 0) {
  switch (x.what) {
    case exact_result::kind::nan: return nan_bits(e);
    case exact_result::kind::infinite: {
      const std::uint64_t inf = 0x7ff0000000000000u | (x.negative ? std::uint64_t{1} << 63 : 0);
      return encode(e, std::bit_cast<double>(inf), r, random);
    }
    case exact_result::kind::finite: break;
  }
  return encode_scaled(e, x.negative, x.n, x.exponent, x.sticky, r, random);
}

/// a + b of finite values of at most 126 bits, without sticky. An exact zero of unlike signs is -0 toward -infinity.
constexpr exact_result sum_of(exact_result a, exact_result b, rounding direction) {
  if (a.n == 0 && b.n == 0)
    return exact_result::zero(a.negative == b.negative ? a.negative : direction == rounding::down);
  if (a.n == 0) return b;
  if (b.n == 0) return a;
  // `a` leads: with it at 126 bits, whatever b loses lies below 2^-124 of the result, or nothing is lost.
  if (a.exponent + bit_width(a.n) < b.exponent + bit_width(b.n)) {
    const exact_result swap = a;
    a = b;
    b = swap;
  }
  const int up = 126 - bit_width(a.n);
  a.n <<= up;
  a.exponent -= up;
  const std::int64_t d = b.exponent - a.exponent;
  bool lost = false;
  uint128 n = 0;
  if (d >= 0) {
    n = b.n << d;
  } else if (d > -128) {
    n = b.n >> -d;
    lost = (n << -d) != b.n;
  } else {
    lost = true;
  }
  exact_result s = a;
  s.sticky = lost;
  if (a.negative == b.negative) {
    s.n = a.n + n;
  } else {
    if (a.n < n) {  // the same leading bit, nothing lost
      s.n = n - a.n;
      s.negative = b.negative;
    } else {
      s.n = a.n - n - (lost ? 1 : 0);
    }
    if (s.n == 0 && !lost) return exact_result::zero(direction == rounding::down);
  }
  return s;
}

/// a / b of nonzero finite values of at most 63 bits: 127 or 128 bits of the quotient.
constexpr exact_result quotient_of(const exact_result& a, const exact_result& b) {
  const int up = 63 + bit_width(b.n) - bit_width(a.n);
  const uint128 n = a.n << up;
  const uint128 high = n / b.n, rest = (n % b.n) << 64;
  return {exact_result::kind::finite, a.negative != b.negative, (high << 64) | (rest / b.n),
          a.exponent - b.exponent - up - 64, rest % b.n != 0};
}

/// The root of a positive value of at most 64 bits: 118 bits, two of the radicand at a time.
constexpr exact_result root_of(const exact_result& a) {
  const int width = bit_width(a.n);
  // Radicand n 2^up with an even exponent, its top bit pair first.
  const bool odd = ((a.exponent + width) & 1) != 0;
  const int pairs_top = odd ? 1 : 2;  // bits in the leading pair
  uint128 root = 0, rest = 0;
  int left = width;
  for (int i = 0; i < 118; ++i) {
    for (int k = 0; k < (i == 0 ? pairs_top : 2); ++k) {
      left -= 1;
      rest = (rest << 1) | (left >= 0 ? (a.n >> left) & 1 : 0);
    }
    const uint128 trial = (root << 2) | 1;
    root <<= 1;
    if (rest >= trial) {
      rest -= trial;
      root |= 1;
    }
  }
  // left bits of the radicand are used; left < 0 counts the zeros appended.
  return {exact_result::kind::finite, false, root, (a.exponent + left) / 2, rest != 0};
}

}  // namespace bitshade
