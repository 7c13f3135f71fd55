// GLM vectors and matrices of real and interval.
//
// Works, real of IEEE formats and rules: construction, + - * / and comparison of vec and mat, dot, cross, length,
// distance, normalize, reflect, mix, clamp, min, max, abs, floor, ceil, fract, mod, sqrt, inversesqrt, exp, log, pow,
// sin, cos, transpose, determinant, inverse.
// Works, interval and every other real: construction, + - * / of vec and mat; GLM's functions ask for
// numeric_limits<T>::is_iec559, which norms, fixed point, e4m3, saturation and flushing do not fulfil.
// Does not: vectors of exact<Q> where Q has a destructor (GLM keeps members in unions); comparison of intervals; and,
// since GLM 0.9.9.8 names float's bits or functions in the body, glm::packHalf and kin, glm::floatBitsToInt and
// glm::intBitsToFloat, glm::isnan and glm::isinf.
// tests/conformance and tests/refused hold each of these.
#pragma once

#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"

// GLM calls std::sqrt and its like by qualified name, where lookup by argument does not reach: for user types the
// standard leaves no other place for these names, and they take bitshade's types alone.
namespace std {
using bitshade::acos;
using bitshade::acosh;
using bitshade::asin;
using bitshade::asinh;
using bitshade::atan;
using bitshade::atan2;
using bitshade::atanh;
using bitshade::ceil;
using bitshade::cos;
using bitshade::cosh;
using bitshade::exp;
using bitshade::exp2;
using bitshade::floor;
using bitshade::fmod;
using bitshade::log;
using bitshade::log2;
using bitshade::pow;
using bitshade::round;
using bitshade::sin;
using bitshade::sinh;
using bitshade::tan;
using bitshade::tanh;
using bitshade::trunc;
template <class F, bitshade::rules R, class C>
constexpr bitshade::real<F, R, C> sqrt(bitshade::real<F, R, C> x) {
  return bitshade::square_root_of(x);
}
template <class F, bitshade::rules R, class C>
constexpr bitshade::real<F, R, C> abs(bitshade::real<F, R, C> x) {
  return bitshade::magnitude_of(x);
}
}  // namespace std

#include <glm/geometric.hpp>
#include <glm/glm.hpp>
