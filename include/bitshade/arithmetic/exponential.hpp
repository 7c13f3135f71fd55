// exp, log, pow and their kin on doubles, to 108 bits, in integers: no libm, the same bits everywhere.
#pragma once

#include "bitshade/arithmetic/long_float.hpp"

namespace bitshade::elementary {

constexpr bool is_nan(double x) { return x != x; }
constexpr bool is_infinite(double x) { return x - x != 0 && x == x; }
constexpr double magnitude(double x) { return x < 0 ? -x : x; }
/// The exponent k of 2^k <= |x| for a nonzero finite x.
constexpr int lead_of(double x) {
  const exact_result u = unpack(x);
  return static_cast<int>(u.exponent) + bit_width(u.n) - 1;
}
constexpr exact_result exactly(double x) { return unpack(x); }
/// Beyond every format's range, or below half of every smallest number.
constexpr exact_result huge(bool negative) { return {exact_result::kind::finite, negative, 1, 100000, true}; }
constexpr exact_result tiny(bool negative) { return {exact_result::kind::finite, negative, 1, -100000, true}; }

/// e^r - 1 for |r| <= 0.7: 38 terms leave 0.7^39/39! < 2^-168.
constexpr long_float exp_minus_1_series(const long_float& r) {
  const long_float one(1);
  long_float sum = one;
  for (std::uint64_t n = 38; n >= 2; --n) sum = one + (r * sum) / n;
  return r * sum;
}

/// Splits x = k ln 2 + r, |r| <= 0.35, for |x| < 2^15.
struct exp_parts {
  int k = 0;
  long_float r;
};
constexpr exp_parts split_exp(const long_float& x) {
  exp_parts p;
  // x / ln 2 to 50 bits suffices for the nearest integer.
  const long_float q = x * long_float(0x1.71547652b82fep+0);
  if (x.is_zero() || q.lead() < -1) {  // |q| < 1/2
    p.r = x;
    return p;
  }
  const auto half_up = static_cast<std::int64_t>((q.m >> (-q.e - 1)) + 1) >> 1;
  p.k = static_cast<int>(q.negative ? -half_up : half_up);
  const long_float k(p.k);
  p.r = (x - k * long_ln2_high) - k * long_ln2_low;
  return p;
}

constexpr long_float exp_long(const long_float& x) {
  const exp_parts p = split_exp(x);
  long_float y = long_float(1) + exp_minus_1_series(p.r);
  y.e += p.k;
  return y;
}
constexpr long_float exp_minus_1_long(const long_float& x) {
  const exp_parts p = split_exp(x);
  const long_float y = exp_minus_1_series(p.r);
  if (p.k == 0) return y;
  long_float z = long_float(1) + y;
  z.e += p.k;
  return z - long_float(1);
}

/// 2 artanh(s) = log((1 + s) / (1 - s)) for |s| <= 0.172: 27 terms leave s^55 < 2^-139.
constexpr long_float log_ratio(const long_float& s) {
  const long_float square = s * s;
  long_float sum;
  for (std::uint64_t n = 53; n >= 3; n -= 2) sum = (sum + long_float(1) / n) * square;
  return (s + s * sum).halved(-1);
}
constexpr long_float log_long(const long_float& x) {
  // x = 2^k m with m in [0.7, 1.42): then s lies within 0.172.
  long_float m = x;
  std::int64_t k = x.lead();
  m.e = -127;
  if (m.m > ((uint128{0xb504f333f9de6484} << 64))) {
    m.e -= 1;
    k += 1;
  }
  const long_float one(1);
  const long_float part = log_ratio((m - one) / (m + one));
  return long_float(static_cast<int>(k)) * long_ln2_high + (long_float(static_cast<int>(k)) * long_ln2_low + part);
}
constexpr long_float log_1_plus_long(const long_float& x) {
  if (x.is_zero()) return x;
  if (x.lead() < -3) return log_ratio(x / (long_float(2) + x));
  return log_long(long_float(1) + x);
}

constexpr exact_result exp(double x) {
  if (is_nan(x)) return exact_result::nan();
  if (is_infinite(x)) return x > 0 ? exact_result::infinity(false) : exact_result::zero(false);
  if (x == 0) return exactly(1);
  if (x > 20000) return huge(false);
  if (x < -20000) return tiny(false);
  if (lead_of(x) < -70) return beside(1, x > 0);
  return settled(exp_long(long_float(x)));
}
constexpr exact_result exp2(double x) {
  if (is_nan(x) || is_infinite(x) || x == 0) return exp(x);
  if (x > 20000) return huge(false);
  if (x < -20000) return tiny(false);
  if (lead_of(x) < -70) return beside(1, x > 0);
  // The integer part is exact; the rest, below 1, is multiplied by ln 2.
  const auto k = static_cast<int>(x);
  long_float y = exp_long(long_float(x - k) * long_ln2);
  y.e += k;
  return settled(y);
}
constexpr exact_result expm1(double x) {
  if (is_nan(x)) return exact_result::nan();
  if (is_infinite(x)) return x > 0 ? exact_result::infinity(false) : exactly(-1);
  if (x == 0) return exactly(x);
  if (x > 20000) return huge(false);
  if (x < -45) return beside(-1, false);
  if (lead_of(x) < -70) return beside(x, x > 0);
  return settled(exp_minus_1_long(long_float(x)));
}

/// What log, log2 and log10 share: ends and signs.
constexpr bool log_end(double x, exact_result& out) {
  if (is_nan(x) || x < 0) {
    out = exact_result::nan();
    return true;
  }
  if (x == 0 || is_infinite(x)) {
    out = exact_result::infinity(x == 0);
    return true;
  }
  return false;
}
constexpr exact_result log(double x) {
  exact_result out;
  if (log_end(x, out)) return out;
  return settled(log_long(long_float(x)));
}
constexpr exact_result log2(double x) {
  exact_result out;
  if (log_end(x, out)) return out;
  return settled(log_long(long_float(x)) / long_ln2);
}
constexpr exact_result log10(double x) {
  exact_result out;
  if (log_end(x, out)) return out;
  return settled(log_long(long_float(x)) / long_ln10);
}
constexpr exact_result log1p(double x) {
  if (x < -1 || is_nan(x)) return exact_result::nan();
  if (x == -1) return exact_result::infinity(true);
  if (is_infinite(x)) return exact_result::infinity(false);
  if (x == 0) return exactly(x);
  if (lead_of(x) < -70) return beside(x, x < 0);
  return settled(log_1_plus_long(long_float(x)));
}

constexpr exact_result cbrt(double x) {
  if (is_nan(x) || is_infinite(x) || x == 0) return is_nan(x) ? exact_result::nan() : exactly(x);
  long_float y = exp_long(log_long(long_float(magnitude(x))) / 3);
  y.negative = x < 0;
  return settled(y);
}

/// 0 no integer, 1 odd, 2 even.
constexpr int integer_kind(double x) {
  if (!(magnitude(x) < 0x1p53)) return 2;
  const auto i = static_cast<std::int64_t>(x);
  if (static_cast<double>(i) != x) return 0;
  return (i & 1) != 0 ? 1 : 2;
}

/// x^y with the special cases of IEEE 754-2019, 9.2.1.
constexpr exact_result pow(double x, double y) {
  if (y == 0 || x == 1) return exactly(1);
  if (is_nan(x) || is_nan(y)) return exact_result::nan();
  const double size = magnitude(x);
  const bool sign_of_zero = unpack(x).negative;
  if (is_infinite(y)) {
    if (size == 1) return exactly(1);
    return (size > 1) == (y > 0) ? exact_result::infinity(false) : exact_result::zero(false);
  }
  const int kind = integer_kind(y);
  const bool negative = sign_of_zero && kind == 1;
  if (x == 0 || is_infinite(x))
    return (x == 0) == (y < 0) ? exact_result::infinity(negative) : exact_result::zero(negative);
  if (x < 0 && kind == 0) return exact_result::nan();
  if (size == 1) return exactly(negative ? -1 : 1);
  const long_float power = log_long(long_float(size)) * long_float(y);
  const bool up = !power.negative;
  if (power.lead() >= 15) return up ? huge(negative) : tiny(negative);
  if (power.lead() < -70) return beside(negative ? -1 : 1, up);
  long_float r = exp_long(power);
  r.negative = negative;
  return settled(r);
}

constexpr exact_result sinh(double x) {
  if (is_nan(x) || is_infinite(x) || x == 0) return is_nan(x) ? exact_result::nan() : exactly(x);
  if (magnitude(x) > 20000) return huge(x < 0);
  if (lead_of(x) < -30) return beside(x, true);
  const long_float t = exp_minus_1_long(long_float(magnitude(x)));
  long_float y = (t + t / (t + long_float(1))).halved();
  y.negative = x < 0;
  return settled(y);
}
constexpr exact_result cosh(double x) {
  if (is_nan(x)) return exact_result::nan();
  if (is_infinite(x)) return exact_result::infinity(false);
  if (x == 0) return exactly(1);
  if (magnitude(x) > 20000) return huge(false);
  if (lead_of(x) < -30) return beside(1, true);
  const long_float t = exp_long(long_float(magnitude(x)));
  return settled((t + long_float(1) / t).halved());
}
constexpr exact_result tanh(double x) {
  if (is_nan(x) || x == 0) return is_nan(x) ? exact_result::nan() : exactly(x);
  if (magnitude(x) > 25) return is_infinite(x) ? exactly(x < 0 ? -1 : 1) : beside(x < 0 ? -1 : 1, false);
  if (lead_of(x) < -30) return beside(x, false);
  const long_float t = exp_minus_1_long(long_float(2 * magnitude(x)));
  long_float y = t / (t + long_float(2));
  y.negative = x < 0;
  return settled(y);
}

constexpr exact_result asinh(double x) {
  if (is_nan(x) || is_infinite(x) || x == 0) return is_nan(x) ? exact_result::nan() : exactly(x);
  if (lead_of(x) < -30) return beside(x, false);
  const long_float t(magnitude(x)), one(1), square = t * t;
  long_float y = log_1_plus_long(t + square / (one + root(one + square)));
  y.negative = x < 0;
  return settled(y);
}
constexpr exact_result acosh(double x) {
  if (is_nan(x) || x < 1) return exact_result::nan();
  if (is_infinite(x) || x == 1) return x == 1 ? exact_result::zero(false) : exactly(x);
  const long_float t = long_float(x) - long_float(1);
  return settled(log_1_plus_long(t + root(t * (t + long_float(2)))));
}
constexpr exact_result atanh(double x) {
  if (!(magnitude(x) <= 1)) return exact_result::nan();
  if (x == 0) return exactly(x);
  if (magnitude(x) == 1) return exact_result::infinity(x < 0);
  if (lead_of(x) < -30) return beside(x, true);
  const long_float t(magnitude(x));
  long_float y = log_1_plus_long((t + t) / (long_float(1) - t)).halved();
  y.negative = x < 0;
  return settled(y);
}

}  // namespace bitshade::elementary
