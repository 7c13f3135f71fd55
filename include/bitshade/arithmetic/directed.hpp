// + - x / and square root with both of their bounds, for every type of number here.
#pragma once

#include <concepts>
#include <utility>

#include "bitshade/arithmetic/exact.hpp"
#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

/// The greatest T not above, and the least not below, an operation's exact result.
template <class T>
struct directed;

namespace detail {

/// For types whose numbers are an encoding's: `operations.hpp` rounds both ways, whatever the environment.
template <class T, encoding E>
struct directed_by_bits {
  static constexpr rules below{rounding::down}, above{rounding::up};
  using bounds = std::pair<T, T>;

  static constexpr std::uint64_t bits(const T& x) { return encode(E, static_cast<double>(x)); }
  static constexpr T value(std::uint64_t b) { return T(decode(E, b)); }

  static constexpr bounds add(const T& a, const T& b) {
    return {value(bitshade::add(E, bits(a), bits(b), below)), value(bitshade::add(E, bits(a), bits(b), above))};
  }
  static constexpr bounds multiply(const T& a, const T& b) {
    // 0 times an unbounded end is 0: the end stands for numbers, all of them finite.
    if (a == T(0) || b == T(0)) return {T(0), T(0)};
    return {value(bitshade::multiply(E, bits(a), bits(b), below)), value(bitshade::multiply(E, bits(a), bits(b), above))};
  }
  static constexpr bounds divide(const T& a, const T& b) {
    // Of two unbounded ends likewise: a bounded number over ever greater ones comes as near to 0 as any quotient.
    if (!(a - a == T(0)) && !(b - b == T(0))) return {T(0), T(0)};
    return {value(bitshade::divide(E, bits(a), bits(b), below)), value(bitshade::divide(E, bits(a), bits(b), above))};
  }
  static constexpr bounds sqrt(const T& a) {
    return {value(square_root(E, bits(a), below)), value(square_root(E, bits(a), above))};
  }
  static constexpr bounds round(const exact_result& x) {
    return {value(round_result(E, x, below)), value(round_result(E, x, above))};
  }
  static constexpr T infinity() { return value(infinity_bits(E)); }
};

}  // namespace detail

template <> struct directed<float> : detail::directed_by_bits<float, binary_encoding(8, 23)> {};
template <> struct directed<double> : detail::directed_by_bits<double, binary_encoding(11, 52)> {};
template <class F, rules R, class C>
struct directed<real<F, R, C>> : detail::directed_by_bits<real<F, R, C>, F::value> {
  static_assert(has_infinity(F::value), "bitshade: an interval needs infinities for the bounds that it cannot hold");
};
/// Nothing is rounded, and nothing is infinite: dividing by an interval that holds 0 is Q's error.
template <class Q>
struct directed<exact<Q>> {
  using T = exact<Q>;
  using bounds = std::pair<T, T>;
  static bounds add(const T& a, const T& b) { return {a + b, a + b}; }
  static bounds multiply(const T& a, const T& b) { return {a * b, a * b}; }
  static bounds divide(const T& a, const T& b) { return {a / b, a / b}; }
};

}  // namespace bitshade
