// <cmath> for counted: real_math.hpp's functions, each one operation.
#pragma once

#include "bitshade/arithmetic/counted.hpp"
#include "bitshade/arithmetic/real_math.hpp"

namespace bitshade {

namespace detail {

template <class T>
using emulated = typename arithmetic_of<T>::emulated;

/// What a function's operand is: a zero where the rules flush subnormal inputs; on a norm's grid its code.
template <class T>
constexpr double operand_of(const counted<T>& x) {
  return emulated<T>(x.value()).operand();
}
template <class T>
constexpr double on_grid(const counted<T>& x) {
  return emulated<T>(x.value()).on_grid();
}

/// An exact result, rounded once and counted.
template <class T, class... Operands>
constexpr counted<T> counted_result(const exact_result& exact, const Operands&... x) {
  const auto at = [&](const rules& r) { return round_result(with_room(arithmetic_of<T>::format), exact, r); };
  return counted<T>::record(static_cast<T>(emulated<T>::from_exact(exact)), at, x...);
}
template <class T, class... Operands>
constexpr counted<T> counted_on_grid(const exact_result& exact, const Operands&... x) {
  const auto at = [&](const rules& r) { return round_on_grid(with_room(arithmetic_of<T>::format), exact, r); };
  return counted<T>::record(static_cast<T>(emulated<T>::from_grid(exact)), at, x...);
}

}  // namespace detail

#define BITSHADE_COUNTED template <class T> constexpr counted<T>
#define BITSHADE_FUNCTION(name) \
  BITSHADE_COUNTED name(const counted<T>& x) { \
    return detail::counted_result<T>(elementary::name(detail::operand_of(x)), x); \
  }
BITSHADE_ELEMENTARY(BITSHADE_FUNCTION)
#undef BITSHADE_FUNCTION

BITSHADE_COUNTED pow(const counted<T>& x, const std::type_identity_t<counted<T>>& y) {
  return detail::counted_result<T>(elementary::pow(detail::operand_of(x), detail::operand_of(y)), x, y);
}
BITSHADE_COUNTED atan2(const counted<T>& y, const std::type_identity_t<counted<T>>& x) {
  return detail::counted_result<T>(elementary::atan2(detail::operand_of(y), detail::operand_of(x)), y, x);
}
BITSHADE_COUNTED hypot(const counted<T>& x, const std::type_identity_t<counted<T>>& y) {
  return detail::counted_on_grid<T>(detail::hypotenuse(detail::on_grid(x), detail::on_grid(y)), x, y);
}
BITSHADE_COUNTED hypot(const counted<T>& x, const std::type_identity_t<counted<T>>& y,
                       const std::type_identity_t<counted<T>>& z) {
  return detail::counted_on_grid<T>(detail::hypotenuse(detail::on_grid(x), detail::on_grid(y), detail::on_grid(z)), x, y, z);
}

// Exact before they are rounded, which a format too short for the integer does.
#define BITSHADE_INTEGER(name, direction) \
  BITSHADE_COUNTED name(const counted<T>& x) { \
    return detail::counted_result<T>(unpack(detail::integral(detail::operand_of(x), rounding::direction)), x); \
  }
BITSHADE_INTEGER(floor, down)
BITSHADE_INTEGER(ceil, up)
BITSHADE_INTEGER(trunc, toward_zero)
BITSHADE_INTEGER(round, nearest_away)
BITSHADE_INTEGER(rint, nearest_even)
BITSHADE_INTEGER(nearbyint, nearest_even)
#undef BITSHADE_INTEGER

BITSHADE_COUNTED fmod(const counted<T>& x, const std::type_identity_t<counted<T>>& y) {
  return detail::counted_on_grid<T>(unpack(detail::modulo(detail::on_grid(x), detail::on_grid(y), false)), x, y);
}
BITSHADE_COUNTED remainder(const counted<T>& x, const std::type_identity_t<counted<T>>& y) {
  return detail::counted_on_grid<T>(unpack(detail::modulo(detail::on_grid(x), detail::on_grid(y), true)), x, y);
}
BITSHADE_COUNTED remquo(const counted<T>& x, const std::type_identity_t<counted<T>>& y, int* n) {
  return detail::counted_on_grid<T>(unpack(detail::modulo(detail::on_grid(x), detail::on_grid(y), true, n)), x, y);
}
BITSHADE_COUNTED ldexp(const counted<T>& x, int n) {
  exact_result u = unpack(detail::on_grid(x));
  if (u.is_finite()) u.exponent += n;
  return detail::counted_on_grid<T>(u, x);
}
BITSHADE_COUNTED scalbn(const counted<T>& x, int n) { return ldexp(x, n); }
BITSHADE_COUNTED fdim(const counted<T>& a, const std::type_identity_t<counted<T>>& b) {
  return a <= b ? counted<T>(T(0), a.where()) : a - b;
}

// What chooses or asks is no arithmetic: nothing is counted.
BITSHADE_COUNTED fabs(const counted<T>& x) { return abs(x); }
BITSHADE_COUNTED fmin(const counted<T>& a, const std::type_identity_t<counted<T>>& b) {
  return isnan(a) || b < a ? b : a;
}
BITSHADE_COUNTED fmax(const counted<T>& a, const std::type_identity_t<counted<T>>& b) {
  return isnan(a) || a < b ? b : a;
}
BITSHADE_COUNTED copysign(const counted<T>& x, const std::type_identity_t<counted<T>>& sign) {
  return signbit(x) == signbit(sign) ? x : -x;
}
BITSHADE_COUNTED nextafter(const counted<T>& x, const std::type_identity_t<counted<T>>& y) {
  using emulated = detail::emulated<T>;
  return {static_cast<T>(nextafter(emulated(x.value()), emulated(y.value()))), x.where()};
}
BITSHADE_COUNTED frexp(const counted<T>& x, int* n) {
  return {static_cast<T>(frexp(detail::emulated<T>(x.value()), n)), x.where()};
}
BITSHADE_COUNTED logb(const counted<T>& x) {
  return {static_cast<T>(logb(detail::emulated<T>(x.value()))), x.where()};
}
BITSHADE_COUNTED modf(const counted<T>& x, counted<T>* whole) {
  detail::emulated<T> w;
  const auto rest = modf(detail::emulated<T>(x.value()), &w);
  *whole = {static_cast<T>(w), x.where()};
  return {static_cast<T>(rest), x.where()};
}
#define BITSHADE_QUESTION(type, name) \
  template <class T> constexpr type name(const counted<T>& x) { return name(detail::emulated<T>(x.value())); }
BITSHADE_QUESTION(bool, isnan)
BITSHADE_QUESTION(bool, isinf)
BITSHADE_QUESTION(bool, isfinite)
BITSHADE_QUESTION(bool, isnormal)
BITSHADE_QUESTION(bool, signbit)
BITSHADE_QUESTION(int, ilogb)
BITSHADE_QUESTION(int, fpclassify)
BITSHADE_QUESTION(long, lround)
BITSHADE_QUESTION(long long, llround)
BITSHADE_QUESTION(long, lrint)
BITSHADE_QUESTION(long long, llrint)
#undef BITSHADE_QUESTION
#undef BITSHADE_COUNTED

}  // namespace bitshade
