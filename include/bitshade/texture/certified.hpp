// Exact filtering at speed: error-free and bounded arithmetic with a rounding test, integers where
// the test cannot decide, rationals where the integers would be too wide.
//
// All three agree bit for bit: each returns the exact value rounded once, to nearest even.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>

#include "bitshade/arithmetic/exact.hpp"
#include "bitshade/texture/exact_rounding.hpp"
#include "bitshade/texture/trilinear.hpp"

namespace bitshade {

/// Texels as the fast path reads them: integers of at most 24 bits (codes) or binary32 values, and
/// what they are divided by: 2^n - 1 for norms, 1 for all others.
struct exact_source {
  const image<float>* texels = nullptr;
  double divisor = 1;
};

namespace certified_detail {

/// Where (u, v) falls, without a rounding; nothing where binary64 cannot say it exactly.
struct located {
  bilinear_taps<double> at;
  bool exact = false;
};

inline located locate_exactly(float u, float v, int w, int h, address mode) {
  u = within_period(u, mode);
  v = within_period(v, mode);
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
/// more; the sum by 1: 5 a row. The second direction makes as many, and the rows' own come in by
/// their weights, which sum to 1: 10. The division adds 1, the interval's end that is rounded to
/// binary64 another; second-order terms stay far under the rest.
inline constexpr double bilinear_bounded_error = 22;

/// Error of bilinear_pairs in units of 2^-106 * max |texel| / divisor.
///
/// With M = max |texel|, sums and products of high parts lose nothing; low parts are sums of terms
/// under 2^-53 of M each, which err by as many 2^-106. A row of texels without low parts: the low
/// product 2, with the other half of the product 4, with the sum's rest 5: 11. The second
/// direction: differences of low parts 2 and 4, the low product 4, sums 6, 7 and 8: 31, and the
/// rows' own by their weights: 42. The division's remainder is exact; its sum with the low part
/// errs by 2, the second quotient by 2.
inline constexpr double bilinear_pairs_error = 46;

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

/// Bilinear in pairs of binary64: the high part is the sum rounded to nearest.
inline two bilinear_pairs(double a, double b, double c, double d, double fx, double fy,
                          double divisor) {
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
  return two_sum(q1, q2);
}

/// The binary64 that every number near the pairs' sum rounds to, if there is one; the radius is
/// twice the bound, so that its own roundings do not count.
inline bool decide_wide(double a, double b, double c, double d, double fx, double fy,
                        double divisor, double& result) {
  const two value = bilinear_pairs(a, b, c, d, fx, fy, divisor);
  const double most =
      std::max(std::max(std::fabs(a), std::fabs(b)), std::max(std::fabs(c), std::fabs(d)));
  const double radius = most * (2 * bilinear_pairs_error * 0x1p-106) / divisor;
  result = value.high;
  return value.high + (value.low - radius) == value.high &&
         value.high + (value.low + radius) == value.high && std::fabs(value.high) > 0x1p-900;
}

/// Whether a border, times the divisor, stands among the texels without a rounding.
inline bool border_is_exact(double border, double divisor) {
  if (border == 0 || divisor == 1) return true;
  const double size = std::fabs(border);
  return size > 0x1p-900 && size < 0x1p900 && two_product(border, divisor).low == 0;
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
  const bilinear_taps<T> at = locate<T>(static_cast<T>(within_period(u, mode)),
                                        static_cast<T>(within_period(v, mode)), w, h, mode);
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
/// Shapes   u and v finite, |border| < 2^900; T: exact<Q>, needed only where the integers are too
///          narrow.
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
  const bool exact =
      where.exact && (mode != address::border || border_is_exact(border, in.divisor));
  R result{};
  if (exact) {
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
  if (exact) {
    if (const auto value = bilinear_integer<R>(a, b, c, d, at.fx, at.fy, in.divisor)) {
      if (counts) ++counts->integer;
      return *value;
    }
  }
  if (counts) ++counts->rational;
  return bilinear_rational<R, T>(in, u, v, mode, channel, border);
}

}  // namespace bitshade
