// <cmath> for real: every function the exact result, rounded once.
//
// Error    correctly rounded wherever the format has at most 24 bits of precision; above that wherever the exact
//          result is farther than 2^-108 (relative) from a tie or number of the format, else within 1 ulp. Of a norm, the
//          elementary functions take the binary64 nearest to its value; hypot, fmod, remainder and ldexp the value.
// Source   long_float.hpp, exponential.hpp, trigonometric.hpp; docs/contract.md.
#pragma once

#include <limits>
#include <utility>

#include "bitshade/arithmetic/real_classes.hpp"
#include "bitshade/arithmetic/real_numbers.hpp"
#include "bitshade/arithmetic/trigonometric.hpp"

namespace bitshade {

namespace detail {

/// An integer near x: exact in every direction; the sign of a zero is x's.
constexpr double integral(double x, rounding direction) {
  const std::uint64_t sign = std::bit_cast<std::uint64_t>(x) & (std::uint64_t{1} << 63);
  const double size = elementary::magnitude(x);
  if (!(size < 0x1p52)) return x;
  const exact_result u = unpack(size);
  rules r;
  r.direction = direction;
  const std::uint64_t whole = round_quotient(scaled(u.n, u.exponent), sign != 0, r, 0);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(static_cast<double>(whole)) | sign);
}

/// x - n y with n = x / y truncated, or rounded to nearest even: exact. The 31 last bits of n, with its sign, go to
/// `quotient` where asked for.
constexpr double modulo(double x, double y, bool nearest, int* quotient = nullptr) {
  if (quotient != nullptr) *quotient = 0;
  const exact_result a = unpack(x), b = unpack(y);
  if (!a.is_finite() || b.what == exact_result::kind::nan || b.is_zero())
    return std::bit_cast<double>(nan_bits(binary_encoding(11, 52)));
  if (!b.is_finite() || a.is_zero()) return x;
  // Both on the grid of the finer one; where x's is coarser, its excess of twos goes in modulo y.
  const std::int64_t low = a.exponent < b.exponent ? a.exponent : b.exponent;
  if (b.exponent - low > 60) {
    // |x| < 2^53 units, |y| at least 2^60 of them: n = 0.
    return x;
  }
  const uint128 d = b.n << (b.exponent - low);
  uint128 rest = a.n % d;
  auto n = static_cast<std::uint32_t>(a.n / d);
  for (std::int64_t i = a.exponent - low; i > 0; --i) {
    rest <<= 1;
    n <<= 1;
    if (rest < d) continue;
    rest -= d;
    n |= 1;
  }
  bool negative = a.negative;
  if (nearest && (2 * rest > d || (2 * rest == d && (n & 1) != 0))) {
    rest = d - rest;
    negative = !negative;
    n += 1;
  }
  if (quotient != nullptr) {
    const int last = static_cast<int>(n & 0x7fffffff);
    *quotient = a.negative != b.negative ? -last : last;
  }
  constexpr encoding wide = binary_encoding(11, 52);
  if (rest == 0) negative = a.negative;
  return std::bit_cast<double>(encode_scaled(wide, negative, rest, low, false, {}, 0));
}

/// sqrt(x^2 + y^2 + z^2): one infinite leg is enough, whatever the others.
constexpr exact_result hypotenuse(double x, double y, double z = 0) {
  exact_result leg[] = {unpack(x), unpack(y), unpack(z)};
  using kind = exact_result::kind;
  for (const exact_result& a : leg)
    if (a.what == kind::infinite) return exact_result::infinity(false);
  for (exact_result& a : leg) {
    if (a.what == kind::nan) return exact_result::nan();
    a = {kind::finite, false, a.n * a.n, 2 * a.exponent, false};
  }
  // The longest last: what the sum of the others may lose lies below 2^-124 of it.
  const auto lead = [](const exact_result& a) {
    return a.n == 0 ? std::numeric_limits<std::int64_t>::min() : a.exponent + bit_width(a.n);
  };
  for (exact_result* a : {&leg[0], &leg[1]})
    if (lead(*a) > lead(leg[2])) std::swap(*a, leg[2]);
  const exact_result rest = sum_of(leg[0], leg[1], rounding::nearest_even);
  exact_result square = sum_of(rest, leg[2], rounding::nearest_even);
  square.sticky = square.sticky || rest.sticky;
  if (square.is_zero()) return exact_result::zero(false);
  exact_result result = root_of(square);
  result.sticky = result.sticky || square.sticky;
  return result;
}

}  // namespace detail

// What elementary:: has of one argument. Stays defined: counted_math.hpp and pack_math.hpp make their own of each.
#define BITSHADE_ELEMENTARY(make) \
  make(exp) make(exp2) make(expm1) make(log) make(log2) make(log10) make(log1p) make(cbrt) make(sin) make(cos) \
  make(tan) make(asin) make(acos) make(atan) make(sinh) make(cosh) make(tanh) make(asinh) make(acosh) make(atanh)

#define BITSHADE_REAL template <class F, rules R, class C> constexpr real<F, R, C>
#define BITSHADE_FUNCTION(name) \
  BITSHADE_REAL name(real<F, R, C> x) { return real<F, R, C>::from_exact(elementary::name(x.operand())); }
BITSHADE_ELEMENTARY(BITSHADE_FUNCTION)
#undef BITSHADE_FUNCTION

/// sqrt and abs are friends that only lookup by argument finds; these a qualified call finds as well.
BITSHADE_REAL square_root_of(real<F, R, C> x) { return sqrt(x); }
BITSHADE_REAL magnitude_of(real<F, R, C> x) { return abs(x); }

// std::type_identity_t lets the second argument be a float or an int, as it may for float.
BITSHADE_REAL pow(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y) {
  return real<F, R, C>::from_exact(elementary::pow(x.operand(), y.operand()));
}
BITSHADE_REAL atan2(real<F, R, C> y, std::type_identity_t<real<F, R, C>> x) {
  return real<F, R, C>::from_exact(elementary::atan2(y.operand(), x.operand()));
}
/// sqrt(x^2 + y^2) without overflow or underflow on the way, rounded once.
BITSHADE_REAL hypot(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y) {
  return real<F, R, C>::from_grid(detail::hypotenuse(x.on_grid(), y.on_grid()));
}

BITSHADE_REAL hypot(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y, std::type_identity_t<real<F, R, C>> z) {
  return real<F, R, C>::from_grid(detail::hypotenuse(x.on_grid(), y.on_grid(), z.on_grid()));
}

BITSHADE_REAL floor(real<F, R, C> x) { return detail::integral(x.operand(), rounding::down); }
BITSHADE_REAL ceil(real<F, R, C> x) { return detail::integral(x.operand(), rounding::up); }
BITSHADE_REAL trunc(real<F, R, C> x) { return detail::integral(x.operand(), rounding::toward_zero); }
BITSHADE_REAL round(real<F, R, C> x) { return detail::integral(x.operand(), rounding::nearest_away); }
BITSHADE_REAL rint(real<F, R, C> x) { return detail::integral(x.operand(), rounding::nearest_even); }
BITSHADE_REAL nearbyint(real<F, R, C> x) { return rint(x); }
BITSHADE_REAL fmod(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y) {
  return real<F, R, C>::from_grid(unpack(detail::modulo(x.on_grid(), y.on_grid(), false)));
}
BITSHADE_REAL remainder(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y) {
  return real<F, R, C>::from_grid(unpack(detail::modulo(x.on_grid(), y.on_grid(), true)));
}
/// The remainder, and the last bits of the rounded quotient with its sign.
BITSHADE_REAL remquo(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y, int* quotient) {
  return real<F, R, C>::from_grid(unpack(detail::modulo(x.on_grid(), y.on_grid(), true, quotient)));
}
BITSHADE_REAL modf(real<F, R, C> x, real<F, R, C>* whole) {
  *whole = trunc(x);
  return isinf(x) ? copysign(real<F, R, C>(0), x) : copysign(x - *whole, x);
}

BITSHADE_REAL copysign(real<F, R, C> x, std::type_identity_t<real<F, R, C>> sign) {
  return signbit(x) == signbit(sign) ? x : -x;
}

// As <cmath> has them: a NaN gives way to a number. std::min and std::max work as they are.
BITSHADE_REAL fmin(real<F, R, C> a, std::type_identity_t<real<F, R, C>> b) {
  return isnan(a) || b < a ? b : a;
}
BITSHADE_REAL fmax(real<F, R, C> a, std::type_identity_t<real<F, R, C>> b) {
  return isnan(a) || a < b ? b : a;
}
BITSHADE_REAL fdim(real<F, R, C> a, std::type_identity_t<real<F, R, C>> b) {
  return a <= b ? real<F, R, C>(0) : a - b;
}

/// x 2^n, rounded once.
BITSHADE_REAL ldexp(real<F, R, C> x, int n) {
  exact_result u = unpack(x.on_grid());
  if (u.is_finite()) u.exponent += n;
  return real<F, R, C>::from_grid(u);
}
BITSHADE_REAL scalbn(real<F, R, C> x, int n) { return ldexp(x, n); }
BITSHADE_REAL scalbln(real<F, R, C> x, long n) {
  // Beyond 2^20 every number is 0 or beyond the largest already.
  constexpr long most = 1 << 20;
  return ldexp(x, static_cast<int>(n < -most ? -most : n > most ? most : n));
}
template <class F, rules R, class C> constexpr int ilogb(real<F, R, C> x) {
  const exact_result u = unpack(x.operand());
  if (!u.is_finite()) return u.what == exact_result::kind::nan ? FP_ILOGBNAN : std::numeric_limits<int>::max();
  return u.n == 0 ? FP_ILOGB0 : static_cast<int>(u.exponent) + bit_width(u.n) - 1;
}
BITSHADE_REAL logb(real<F, R, C> x) {
  if (!isfinite(x)) return abs(x);
  if (x == real<F, R, C>(0)) return real<F, R, C>::from_exact(exact_result::infinity(true));
  return ilogb(x);
}
/// x = f 2^n with 1/2 <= |f| < 1.
BITSHADE_REAL frexp(real<F, R, C> x, int* n) {
  *n = 0;
  if (!isfinite(x) || x == real<F, R, C>(0)) return x;
  *n = ilogb(x) + 1;
  return ldexp(x, -*n);
}
/// The neighbour of x toward y.
BITSHADE_REAL nextafter(real<F, R, C> x, std::type_identity_t<real<F, R, C>> y) {
  using T = real<F, R, C>;
  if (isnan(x) || isnan(y)) return T::from_exact(exact_result::nan());
  if (x == y) return y;
  const bool up = x < y;
  constexpr encoding e = F::value;
  const auto code = [](std::uint64_t bits) { return T::from_bits(static_cast<typename T::bits_type>(bits)); };
  if (e.kind != family::binary) {
    // Codes are integers: one more or one less, unless x is at that end already.
    const T next = code((x.bits() + (up ? 1 : ~std::uint64_t{0})) & low_bits(e.width));
    return (x < next) == up && x != next ? next : x;
  }
  if (x == T(0)) return up || !e.has_sign ? code(1) : code(sign_bit(e) | 1);
  return code(signbit(x) == up ? x.bits() - std::uint64_t{1} : x.bits() + std::uint64_t{1});
}
#undef BITSHADE_REAL

// As for float, a number that its type does not hold gives an unspecified one.
#define BITSHADE_INTEGER(name, type, direction) \
  template <class F, rules R, class C> constexpr type name(real<F, R, C> x) { \
    return static_cast<type>(detail::integral(x.operand(), rounding::direction)); \
  }
BITSHADE_INTEGER(lround, long, nearest_away)
BITSHADE_INTEGER(llround, long long, nearest_away)
BITSHADE_INTEGER(lrint, long, nearest_even)
BITSHADE_INTEGER(llrint, long long, nearest_even)
#undef BITSHADE_INTEGER

// The first argument may be a float or an int, as the second may.
#define BITSHADE_EITHER(name) \
  template <class A, class F, rules R, class C> \
    requires std::is_arithmetic_v<A> \
  constexpr real<F, R, C> name(A x, real<F, R, C> y) { return name(real<F, R, C>(x), y); }
BITSHADE_EITHER(pow)
BITSHADE_EITHER(atan2)
BITSHADE_EITHER(hypot)
BITSHADE_EITHER(fmod)
BITSHADE_EITHER(remainder)
BITSHADE_EITHER(fmin)
BITSHADE_EITHER(fmax)
BITSHADE_EITHER(fdim)
BITSHADE_EITHER(copysign)
#undef BITSHADE_EITHER

}  // namespace bitshade
