// A float of 128 bits in integers, truncated: the wider evaluation behind the elementary functions.
#pragma once

#include "bitshade/arithmetic/exact_result.hpp"

namespace bitshade {

/// The high half of a 256-bit product.
constexpr uint128 high_product(uint128 a, uint128 b) {
  const auto a0 = static_cast<std::uint64_t>(a), a1 = static_cast<std::uint64_t>(a >> 64);
  const auto b0 = static_cast<std::uint64_t>(b), b1 = static_cast<std::uint64_t>(b >> 64);
  const uint128 low = uint128{a0} * b0, mid1 = uint128{a1} * b0, mid2 = uint128{a0} * b1;
  const uint128 carry = (low >> 64) + static_cast<std::uint64_t>(mid1) + static_cast<std::uint64_t>(mid2);
  return uint128{a1} * b1 + (mid1 >> 64) + (mid2 >> 64) + (carry >> 64);
}

/// (-1)^negative m 2^e; m is 0 or has its top bit set.
///
/// Error    + - * and division by a small integer truncate: less than 2^-126 relative each. Division and square
///          root of two long floats: less than 2^-114.
struct long_float {
  bool negative = false;
  uint128 m = 0;
  std::int64_t e = 0;

  constexpr long_float() = default;
  constexpr long_float(bool sign, uint128 n, std::int64_t exponent) : negative(sign), m(n), e(exponent) {
    if (m == 0) return;
    const int up = 128 - bit_width(m);
    m <<= up;
    e -= up;
  }
  constexpr explicit long_float(double x) : long_float(unpack(x).negative, unpack(x).n, unpack(x).exponent) {}
  /// An integer.
  constexpr explicit long_float(int x) : long_float(x < 0, static_cast<uint128>(x < 0 ? -static_cast<std::int64_t>(x) : x), 0) {}

  constexpr bool is_zero() const { return m == 0; }
  /// floor(log2 |x|) of a nonzero number.
  constexpr std::int64_t lead() const { return e + 127; }
  constexpr long_float halved(int times = 1) const {
    long_float r = *this;
    r.e -= times;
    return r;
  }

  friend constexpr long_float operator-(long_float a) {
    a.negative = !a.negative;
    return a;
  }
  friend constexpr long_float operator*(const long_float& a, const long_float& b) {
    return {a.negative != b.negative, high_product(a.m, b.m), a.e + b.e + 128};
  }
  friend constexpr long_float operator+(const long_float& a, const long_float& b) {
    if (a.m == 0) return b;
    if (b.m == 0) return a;
    const bool swap = a.e < b.e || (a.e == b.e && a.m < b.m);
    const long_float &x = swap ? b : a, &y = swap ? a : b;
    const std::int64_t d = x.e - y.e;
    if (d >= 128) return x;
    if (x.negative != y.negative) {
      // One bit of guard keeps a borrow below the last place.
      if (d == 0) return {x.negative, x.m - y.m, x.e};
      const uint128 half = y.m >> (d - 1);
      const uint128 twice_low = (half & 1);
      const uint128 n = x.m - (half >> 1) - twice_low;
      return {x.negative, n, x.e};
    }
    const uint128 n = x.m + (y.m >> d);
    if (n < x.m) return {x.negative, (n >> 1) | (uint128{1} << 127), x.e + 1};
    return {x.negative, n, x.e};
  }
  friend constexpr long_float operator-(const long_float& a, const long_float& b) { return a + (-b); }
  friend constexpr long_float operator/(const long_float& a, std::uint64_t n) {
    // 128 bits of dividend, then 64 more, so that a small quotient keeps its bits.
    const uint128 high = a.m / n, rest = a.m % n;
    const uint128 low = (rest << 64) / n;
    const int up = 128 - bit_width(high);
    if (high == 0) return {};
    const uint128 q = up == 0 ? high : up <= 64 ? (high << up) | (low >> (64 - up)) : high << up;
    return {a.negative, q, a.e - up};
  }
  friend constexpr long_float operator/(const long_float& a, const long_float& b) {
    // One digit of 64 bits, then its remainder's: the divisor keeps all its bits through a correction step.
    const auto divisor = static_cast<std::uint64_t>(b.m >> 64);
    const uint128 guess = ((a.m >> 1) / divisor) << 63;  // a / b, to 63 bits
    long_float q{a.negative != b.negative, guess, a.e - b.e - 126};
    for (int i = 0; i < 2; ++i) {
      const long_float rest = a - q * b;
      if (rest.is_zero()) break;
      const uint128 more = ((rest.m >> 1) / divisor) << 63;
      q = q + long_float{rest.negative != b.negative, more, rest.e - b.e - 126};
    }
    return q;
  }
};

/// The square root of a number that is not negative: 117 good bits.
constexpr long_float root(const long_float& x) {
  if (x.is_zero()) return x;
  const exact_result r = root_of({exact_result::kind::finite, false, x.m, x.e, false});
  return {false, r.n, r.exponent};
}

// The leading bits of constants; tests/exhaustive/arithmetic/elementary.cpp holds what they give against MPFR.
inline constexpr long_float long_half_pi{false, (uint128{0xc90fdaa22168c234} << 64) | 0xc4c6628b80dc1cd1, -127};
inline constexpr long_float long_ln2{false, (uint128{0xb17217f7d1cf79ab} << 64) | 0xc9e3b39803f2f6af, -128};
inline constexpr long_float long_ln10{false, (uint128{0x935d8dddaaa8ac16} << 64) | 0xea56d62b82d30a28, -126};
/// ln 2 in two parts: the first has 112 bits, so that a product with 16 bits is exact.
inline constexpr long_float long_ln2_high{false, long_ln2.m >> 16, -112};
inline constexpr long_float long_ln2_low{false,
                                         ((long_ln2.m & 0xffff) << 112) | (uint128{0x40f343267298b62d} << 48), -240};

/// What an elementary function hands to the rounding: values nearer than 2^-108 relative to a number of at most 55
/// bits are taken to be that number, since only exact cases come so near (docs/contract.md); the rest is inexact.
constexpr exact_result settled(const long_float& x) {
  constexpr int slack = 20, low = 128 - 55;
  if (x.is_zero()) return exact_result::zero(x.negative);
  const uint128 unit = uint128{1} << low, mask = unit - 1;
  const uint128 rest = x.m & mask;
  exact_result r{exact_result::kind::finite, x.negative, x.m, x.e, true};
  if (rest < (uint128{1} << slack)) {
    r.n = x.m >> low;
    r.exponent = x.e + low;
    r.sticky = false;
  } else if (rest > mask - (uint128{1} << slack)) {
    r.n = (x.m >> low) + 1;
    r.exponent = x.e + low;
    r.sticky = false;
  }
  return r;
}

/// A value just above or below a double in magnitude: nearer than any step of a format.
constexpr exact_result beside(double x, bool farther_from_zero) {
  exact_result r = unpack(x);
  const int up = 124 - bit_width(r.n);
  r.n <<= up;
  r.exponent -= up;
  if (!farther_from_zero) r.n -= 1;
  r.sticky = true;
  return r;
}

}  // namespace bitshade
