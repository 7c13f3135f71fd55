// Exact filtering at speed: error-free and bounded arithmetic with a rounding test, integers where
// the test cannot decide, rationals where the integers would be too wide.
//
// All three agree bit for bit: each returns the exact value rounded once, to nearest even.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "bitshade/arithmetic/exact.hpp"
#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/encode.hpp"
#include "bitshade/texture/trilinear.hpp"

namespace bitshade {

/// Texels as the fast path reads them: integers of at most 24 bits (codes) or binary32 values, and
/// what they are divided by: 2^n - 1 for norms, 1 for all others.
struct exact_source {
  const image<float>* texels = nullptr;
  double divisor = 1;
};

namespace certified_detail {

__extension__ typedef __int128 int128;

template <class R>
inline constexpr encoding target = std::is_same_v<R, float> ? binary_encoding(8, 23)
                                                            : binary_encoding(11, 52);
template <class R>
inline constexpr bool is_result = std::is_same_v<R, float> || std::is_same_v<R, double>;

/// Where (u, v) falls, without a rounding; nothing where binary64 cannot say it exactly.
struct located {
  bilinear_taps<double> at;
  bool exact = false;
};

inline located locate_exactly(float u, float v, int w, int h, address mode) {
  // 24 bits times 17 fit 53; taking 1/2 away loses bits only near 0, which the sum back shows.
  const double ux = static_cast<double>(u) * w, vy = static_cast<double>(v) * h;
  const double x = ux - 0.5, y = vy - 0.5;
  const int x0 = texel_floor(x), y0 = texel_floor(y);
  located result{{wrap(x0, w, mode), wrap(x0 + 1, w, mode), wrap(y0, h, mode),
                  wrap(y0 + 1, h, mode), x - x0, y - y0},
                 false};
  // Both weights on the grid of 2^-32: x - x0 is then exact as well, and so is 1 - weight.
  const double gx = result.at.fx * 0x1p32, gy = result.at.fy * 0x1p32;
  result.exact = x + 0.5 == ux && y + 0.5 == vy && std::fabs(ux) < 0x1p20 &&
                 std::fabs(vy) < 0x1p20 &&
                 gx == static_cast<double>(static_cast<std::int64_t>(gx)) &&
                 gy == static_cast<double>(static_cast<std::int64_t>(gy));
  return result;
}

/// a + b without loss.
struct two {
  double high, low;
};
inline two two_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
/// a * b without loss, by Dekker's splitting: no fma instruction is needed.
inline two two_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double p = a * b;
  const double ca = splitter * a, cb = splitter * b;
  const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

}  // namespace certified_detail

/// Error of bilinear_bounded in units of 2^-53 * max |texel| / divisor.
///
/// With M = max |texel|: a difference is at most 2M and errs by 2; its product with a weight by 2
/// more; the sum by 1: 5 a row. The second direction: 2 * 5 + 2 for the difference, 2 for the
/// product, 5 + 1 for the sum: 20. The division adds 1; second-order terms stay under 1.
inline constexpr double bilinear_bounded_error = 22;

namespace certified_detail {

/// Bilinear in plain binary64 and the radius of an interval that holds the exact value.
struct bounded {
  double value, radius;
};
inline bounded bilinear_bounded(double a, double b, double c, double d, double fx, double fy,
                                double divisor) {
  const double upper = a + fx * (b - a), lower = c + fx * (d - c);
  const double value = (upper + fy * (lower - upper)) / divisor;
  const double most =
      std::max(std::max(std::fabs(a), std::fabs(b)), std::max(std::fabs(c), std::fabs(d)));
  return {value, most * (bilinear_bounded_error * 0x1p-53) / divisor};
}

/// The binary32 that every number of the interval rounds to, if there is one.
inline bool decide(const bounded& x, float& result) {
  const auto low = static_cast<float>(x.value - x.radius * 1.0000001);
  const auto high = static_cast<float>(x.value + x.radius * 1.0000001);
  result = low;
  return low == high && low != 0;  // a zero's sign is left to the exact ways
}

/// The same in twice the precision, for binary64 results: |error| <= 2^-98 max |texel| / divisor
/// (theory: each of at most 12 operations on pairs errs by at most 2^-102 of 4 max |texel|).
inline bool decide_wide(double a, double b, double c, double d, double fx, double fy,
                        double divisor, double& result) {
  const auto lerp_pair = [](two from, two to, double f) {
    two difference = two_sum(to.high, -from.high);
    difference.low += to.low - from.low;
    two product = two_product(difference.high, f);
    product.low += difference.low * f;
    two sum = two_sum(from.high, product.high);
    sum.low += product.low + from.low;
    return two_sum(sum.high, sum.low);
  };
  const two upper = lerp_pair({a, 0}, {b, 0}, fx), lower = lerp_pair({c, 0}, {d, 0}, fx);
  const two value = lerp_pair(upper, lower, fy);
  const double q1 = value.high / divisor;
  const two back = two_product(q1, divisor);
  const double q2 = (((value.high - back.high) - back.low) + value.low) / divisor;
  const two quotient = two_sum(q1, q2);
  const double most =
      std::max(std::max(std::fabs(a), std::fabs(b)), std::max(std::fabs(c), std::fabs(d)));
  const double radius = most * 0x1p-98 / divisor;
  result = quotient.high;
  return quotient.high + (quotient.low - radius) == quotient.high &&
         quotient.high + (quotient.low + radius) == quotient.high && quotient.high != 0 &&
         std::fabs(quotient.high) > 0x1p-900;
}

/// Bilinear in 128-bit integers, rounded once by division with a sticky remainder; nothing where
/// weights or texels are too far apart for 126 bits.
template <class R>
std::optional<R> bilinear_integer(double a, double b, double c, double d, double fx, double fy,
                                  double divisor) {
  const double texel[4] = {a, b, c, d};
  int lowest = 1000, highest = -1000;
  for (const double t : texel) {
    if (t == 0) continue;
    const auto bits = std::bit_cast<std::uint64_t>(t);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
    if (exponent < -1000) return std::nullopt;
    const int zeros =
        std::countr_zero((bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52));
    lowest = std::min(lowest, exponent + zeros);
    highest = std::max(highest, exponent + 53);
  }
  if (lowest > highest) return R{0};  // all four are zero
  // The weights' own last bits: both lie on the grid of 2^-32.
  const auto wx = static_cast<std::uint64_t>(fx * 0x1p32),
             wy = static_cast<std::uint64_t>(fy * 0x1p32);
  const int gx = wx == 0 ? 0 : 32 - std::countr_zero(wx),
            gy = wy == 0 ? 0 : 32 - std::countr_zero(wy);
  if (highest - lowest + gx + gy > 126) return std::nullopt;
  const auto scaled = [&](double t) {
    const auto bits = std::bit_cast<std::uint64_t>(t);
    if (t == 0) return static_cast<int128>(0);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
    auto m =
        static_cast<int128>((bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52));
    const int shift = exponent - lowest;
    m = shift >= 0 ? m << shift : m >> -shift;
    return t < 0 ? -m : m;
  };
  const auto ox = static_cast<int128>(std::uint64_t{1} << gx),
             oy = static_cast<int128>(std::uint64_t{1} << gy);
  const auto ix = static_cast<int128>(gx == 0 ? 0 : wx >> (32 - gx));
  const auto iy = static_cast<int128>(gy == 0 ? 0 : wy >> (32 - gy));
  const int128 upper = (ox - ix) * scaled(a) + ix * scaled(b);
  const int128 lower = (ox - ix) * scaled(c) + ix * scaled(d);
  const int128 sum = (oy - iy) * upper + iy * lower;
  if (sum == 0) return R{0};
  const bool negative = sum < 0;
  uint128 magnitude = static_cast<uint128>(negative ? -sum : sum);
  std::int64_t exponent = lowest - gx - gy;
  bool sticky = false;
  if (divisor != 1) {
    const int room = 127 - bit_width(magnitude);
    magnitude <<= room;
    exponent -= room;
    const auto by = static_cast<uint128>(divisor);
    sticky = magnitude % by != 0;
    magnitude /= by;
  }
  const std::uint64_t code = encode_scaled(target<R>, negative, magnitude, exponent, sticky, {}, 0);
  return static_cast<R>(decode(target<R>, code));
}

/// The nearest R of an exact rational, ties to even.
///
/// Rationals know comparisons and a conversion that may err in its last bits: the guess is put
/// right by comparing with the midpoints to both neighbours.
template <class R, class T>
R nearest_of(const T& x) {
  using bits_type = std::conditional_t<std::is_same_v<R, float>, std::uint32_t, std::uint64_t>;
  const T zero = static_cast<T>(0);
  if (x == zero) return R{0};
  const bool negative = x < zero;
  const T size = negative ? zero - x : x;
  auto guess = std::bit_cast<bits_type>(static_cast<R>(static_cast<double>(size)));
  const auto value = [](bits_type bits) { return static_cast<double>(std::bit_cast<R>(bits)); };
  const auto middle = [&](bits_type lower) {
    return (static_cast<T>(value(lower)) + static_cast<T>(value(lower + 1))) / static_cast<T>(2);
  };
  constexpr bits_type largest =
      std::is_same_v<R, float> ? bits_type{0x7f7fffff} : static_cast<bits_type>(0x7fefffffffffffff);
  guess = std::min(guess, largest);
  while (guess < largest) {
    const T up = middle(guess);
    if (up < size || (up == size && (guess & 1) != 0))
      ++guess;
    else
      break;
  }
  while (guess > 0) {
    const T down = middle(static_cast<bits_type>(guess - 1));
    if (size < down || (size == down && (guess & 1) != 0))
      --guess;
    else
      break;
  }
  const R result = std::bit_cast<R>(guess);
  return negative ? -result : result;
}

}  // namespace certified_detail

/// How often each way decided, for reports and tests.
struct certified_counts {
  std::uint64_t fast = 0, integer = 0, rational = 0;
};

/// One texel of an exact source.
inline double exact_texel(const exact_source& in, int x, int y, int channel, double border) {
  return x < 0 || y < 0 ? border * in.divisor : static_cast<double>(in.texels->at(x, y, channel));
}

/// The exact bilinear value by rationals, rounded once: the definition.
template <class R, class T>
R bilinear_rational(const exact_source& in, float u, float v, address mode, int channel,
                    double border = 0) {
  const int w = in.texels->width, h = in.texels->height;
  const bilinear_taps<T> at = locate<T>(static_cast<T>(u), static_cast<T>(v), w, h, mode);
  const auto texel = [&](int x, int y) {
    return x < 0 || y < 0 ? static_cast<T>(border) * static_cast<T>(in.divisor)
                          : static_cast<T>(in.texels->at(x, y, channel));
  };
  const T upper = lerp(texel(at.x0, at.y0), texel(at.x1, at.y0), at.fx);
  const T lower = lerp(texel(at.x0, at.y1), texel(at.x1, at.y1), at.fx);
  return certified_detail::nearest_of<R, T>(lerp(upper, lower, at.fy) / static_cast<T>(in.divisor));
}

/// The exact bilinear value of finite texels, rounded once to R (float or double).
///
///   binary64 (pairs of them for R = double) with an error bound and a rounding test; where it
///   cannot decide, 128-bit integers; where those are too narrow, rationals T
///
/// Shapes   u and v finite; T: exact<Q>, needed only where the integers are too narrow.
/// Error    none beyond the one rounding: bit for bit bilinear_rational.
/// Failure  none; infinite or NaN texels give what binary64 arithmetic makes of them.
template <class R, class T>
R bilinear_certified(const exact_source& in, float u, float v, address mode, int channel,
                     double border = 0, certified_counts* counts = nullptr) {
  using namespace certified_detail;
  static_assert(is_result<R>, "bitshade: certified results are float or double");
  const located where = locate_exactly(u, v, in.texels->width, in.texels->height, mode);
  const bilinear_taps<double>& at = where.at;
  const double a = exact_texel(in, at.x0, at.y0, channel, border);
  const double b = exact_texel(in, at.x1, at.y0, channel, border);
  const double c = exact_texel(in, at.x0, at.y1, channel, border);
  const double d = exact_texel(in, at.x1, at.y1, channel, border);
  R result{};
  if (where.exact) {
    bool decided;
    if constexpr (std::is_same_v<R, float>)
      decided = decide(bilinear_bounded(a, b, c, d, at.fx, at.fy, in.divisor), result);
    else
      decided = decide_wide(a, b, c, d, at.fx, at.fy, in.divisor, result);
    if (decided) {
      if (counts) ++counts->fast;
      return result;
    }
  }
  const double plain = bilinear_bounded(a, b, c, d, at.fx, at.fy, in.divisor).value;
  if (!std::isfinite(a + b + c + d)) return static_cast<R>(plain);
  if (where.exact && (border == 0 || in.divisor == 1)) {
    if (const auto value = bilinear_integer<R>(a, b, c, d, at.fx, at.fy, in.divisor)) {
      if (counts) ++counts->integer;
      return *value;
    }
  }
  if (counts) ++counts->rational;
  return bilinear_rational<R, T>(in, u, v, mode, channel, border);
}

}  // namespace bitshade
