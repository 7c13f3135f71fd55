// sin, cos, tan and their inverses on doubles, to 108 bits, in integers; any argument, up to the largest double.
#pragma once

#include <array>

#include "bitshade/arithmetic/exponential.hpp"

namespace bitshade::elementary {

/// 2 / pi: 1,280 bits, enough for an argument of 2^1024 [PayneHanek83].
inline constexpr std::array<std::uint64_t, 20> two_over_pi{
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561, 0xb7246e3a424dd2e0,
    0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4,
    0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

/// |x| = (4 j + quadrant) pi/2 + r, |r| <= pi/4.
struct reduced {
  int quadrant = 0;
  long_float r;
};

constexpr reduced reduce(double x) {
  reduced out;
  const exact_result u = unpack(magnitude(x));
  out.r = long_float(magnitude(x));
  if (magnitude(x) < 0.78) return out;
  // u.n 2^exponent times six words of 2/pi; words whose products are multiples of 4 are left out.
  const auto e = static_cast<int>(u.exponent);
  const int first = e > 66 ? (e - 2) / 64 - 1 : 0;
  std::array<std::uint64_t, 7> product{};
  std::uint64_t carry = 0;
  for (int i = 5; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(first + i);
    const uint128 sum = uint128{at < two_over_pi.size() ? two_over_pi[at] : 0} * static_cast<std::uint64_t>(u.n) + carry;
    product[static_cast<std::size_t>(5 - i)] = static_cast<std::uint64_t>(sum);
    carry = static_cast<std::uint64_t>(sum >> 64);
  }
  product[6] = carry;
  const int point = 64 * (first + 6) - e;  // fraction bits
  const auto bit = [&](int i) { return (product[static_cast<std::size_t>(i / 64)] >> (i % 64)) & 1; };
  const auto at_or_zero = [&](int i) { return i >= 0 && i < 448 ? bit(i) : 0; };
  int quadrant = static_cast<int>(at_or_zero(point) + 2 * at_or_zero(point + 1));
  const bool upper = at_or_zero(point - 1) != 0;
  if (upper) quadrant += 1;
  // The fraction, or its distance to 1: the first 128 bits that differ from the sign.
  int i = point - 1;
  const std::uint64_t filler = upper ? 1 : 0;
  while (i >= 0 && at_or_zero(i) == filler) --i;
  uint128 n = 0;
  const int top = i;
  for (int k = 0; k < 128; ++k, --i) n = (n << 1) | (at_or_zero(i) ^ filler);
  out.quadrant = quadrant & 3;
  out.r = long_float(upper, n, top - 127 - point) * long_half_pi;
  return out;
}

/// sin r and cos r for |r| <= 0.79: terms up to r^35/35! < 2^-144.
constexpr long_float sin_series(const long_float& r) {
  const long_float square = r * r, one(1);
  long_float sum = one;
  for (std::uint64_t n = 34; n >= 2; n -= 2) sum = one - (square * sum) / (n * (n + 1));
  return r * sum;
}
constexpr long_float cos_series(const long_float& r) {
  const long_float square = r * r, one(1);
  long_float sum = one;
  for (std::uint64_t n = 36; n >= 2; n -= 2) sum = one - (square * sum) / ((n - 1) * n);
  return sum;
}

constexpr exact_result sin(double x) {
  if (is_nan(x) || is_infinite(x)) return exact_result::nan();
  if (x == 0) return exactly(x);
  if (lead_of(x) < -30) return beside(x, false);
  const reduced a = reduce(x);
  long_float y = (a.quadrant & 1) != 0 ? cos_series(a.r) : sin_series(a.r);
  if ((a.quadrant & 2) != 0) y = -y;
  return settled(x < 0 ? -y : y);
}
constexpr exact_result cos(double x) {
  if (is_nan(x) || is_infinite(x)) return exact_result::nan();
  if (x == 0) return exactly(1);
  if (lead_of(x) < -30) return beside(1, false);
  const reduced a = reduce(x);
  const long_float y = (a.quadrant & 1) != 0 ? sin_series(a.r) : cos_series(a.r);
  return settled(a.quadrant == 1 || a.quadrant == 2 ? -y : y);
}
constexpr exact_result tan(double x) {
  if (is_nan(x) || is_infinite(x)) return exact_result::nan();
  if (x == 0) return exactly(x);
  if (lead_of(x) < -30) return beside(x, true);
  const reduced a = reduce(x);
  const long_float s = sin_series(a.r), c = cos_series(a.r);
  const long_float y = (a.quadrant & 1) != 0 ? -(c / s) : s / c;
  return settled(x < 0 ? -y : y);
}

/// atan t for 0 <= t <= 1: three halvings, t / (1 + sqrt(1 + t^2)), bring it below 0.0985; 27 terms.
constexpr long_float atan_long(long_float t) {
  const long_float one(1);
  for (int i = 0; i < 3; ++i) t = t / (one + root(one + t * t));
  const long_float square = t * t;
  long_float sum;
  for (std::uint64_t n = 55; n >= 3; n -= 2) sum = (long_float(1) / n - sum) * square;
  return (t - t * sum).halved(-3);
}
/// The angle of a point (x, y) with y >= 0, x of either sign, not both zero.
constexpr long_float angle(const long_float& y, const long_float& x) {
  const long_float size{false, x.m, x.e};
  const bool steep =
      size.is_zero() || (!y.is_zero() && (y.e > size.e || (y.e == size.e && y.m > size.m)));
  const long_float small = atan_long(steep ? size / y : y / size);
  if (steep) return x.negative ? long_half_pi + small : long_half_pi - small;
  return x.negative ? long_half_pi.halved(-1) - small : small;
}

constexpr exact_result atan2(double y, double x) {
  if (is_nan(x) || is_nan(y)) return exact_result::nan();
  const bool negative = unpack(y).negative, left = unpack(x).negative;
  const auto fraction_of_pi = [&](std::uint64_t eighths) {
    long_float a = long_half_pi * long_float(static_cast<int>(eighths));
    a.negative = negative;
    return settled(a.halved(2));
  };
  if (y == 0) return left ? fraction_of_pi(8) : exact_result::zero(negative);
  if (is_infinite(y)) return fraction_of_pi(is_infinite(x) ? (left ? 6 : 2) : 4);
  if (is_infinite(x)) return left ? fraction_of_pi(8) : exact_result::zero(negative);
  if (x == 0) return fraction_of_pi(4);
  const int slope = lead_of(y) - lead_of(x);
  if (slope < -31 && !left) {
    // atan q = q (1 - q^2/3 ...): just below the quotient, which may be exact.
    exact_result q = quotient_of(unpack(magnitude(y)), unpack(magnitude(x)));
    q.negative = negative;
    if (!q.sticky) q.n -= 1;
    q.sticky = true;
    return q;
  }
  long_float a = angle(long_float(magnitude(y)), long_float(x));
  a.negative = negative;
  return settled(a);
}
constexpr exact_result atan(double x) { return atan2(x, 1); }

constexpr exact_result asin(double x) {
  if (!(magnitude(x) <= 1)) return exact_result::nan();
  if (x == 0) return exactly(x);
  if (lead_of(x) < -30) return beside(x, true);
  const long_float size(magnitude(x)), one(1);
  long_float a = angle(size, root((one - size) * (one + size)));
  a.negative = x < 0;
  return settled(a);
}
constexpr exact_result acos(double x) {
  if (!(magnitude(x) <= 1)) return exact_result::nan();
  if (x == 1) return exact_result::zero(false);
  const long_float size(magnitude(x)), one(1);
  return settled(angle(root((one - size) * (one + size)), long_float(x)));
}

}  // namespace bitshade::elementary
