// Certified values: two bounds with the exact result between them, and comparisons that may not know.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "bitshade/arithmetic/directed.hpp"
#include "bitshade/arithmetic/exponential.hpp"

namespace bitshade {

/// What a comparison of intervals can say.
enum class truth : std::uint8_t { no, maybe, yes };

constexpr bool certainly(truth t) { return t == truth::yes; }
constexpr bool possibly(truth t) { return t != truth::no; }
constexpr truth operator!(truth t) { return static_cast<truth>(2 - static_cast<int>(t)); }
constexpr truth operator&(truth a, truth b) { return a < b ? a : b; }
constexpr truth operator|(truth a, truth b) { return a < b ? b : a; }

/// [lower, upper]: every operation encloses its exact results on all numbers of its operands.
///
/// Shapes   T: float, double, real<F> with infinities, or exact<Q>.
/// Error    each bound is the nearest T on its side, of a number that T does not hold too (fma: of the product, then of
///          the sum); none for exact<Q>.
/// Failure  dividing by an interval that holds 0 gives everything; sqrt and log take a part below 0 for 0.
///          NaN bounds are not meant.
template <class T>
class interval {
  using bounds = directed<T>;

 public:
  constexpr interval() : interval(T(0)) {}
  constexpr interval(const T& x) : lower_(x), upper_(x) {}
  template <class U>
    requires(std::is_arithmetic_v<U> && !std::same_as<U, T> && std::constructible_from<T, U>)
  constexpr interval(U x) : interval(enclosing(x)) {}
  constexpr interval(const T& lower, const T& upper) : lower_(lower), upper_(upper) {}

  constexpr const T& lower() const { return lower_; }
  constexpr const T& upper() const { return upper_; }
  constexpr bool contains(const T& x) const { return !(x < lower_) && !(upper_ < x); }
  constexpr T width() const { return bounds::add(upper_, -lower_).second; }

  friend constexpr interval operator+(const interval& a, const interval& b) {
    return {bounds::add(a.lower_, b.lower_).first, bounds::add(a.upper_, b.upper_).second};
  }
  friend constexpr interval operator-(const interval& a) { return {-a.upper_, -a.lower_}; }
  friend constexpr interval operator+(const interval& a) { return a; }
  friend constexpr interval operator-(const interval& a, const interval& b) { return a + (-b); }
  friend constexpr interval operator*(const interval& a, const interval& b) {
    interval r = product(a.lower_, b.lower_);
    r = hull(r, product(a.lower_, b.upper_));
    r = hull(r, product(a.upper_, b.lower_));
    return hull(r, product(a.upper_, b.upper_));
  }
  friend constexpr interval operator/(const interval& a, const interval& b) {
    if (b.contains(T(0))) return everything(a, b);
    interval r = ratio(a.lower_, b.lower_);
    r = hull(r, ratio(a.lower_, b.upper_));
    r = hull(r, ratio(a.upper_, b.lower_));
    return hull(r, ratio(a.upper_, b.upper_));
  }
  constexpr interval& operator+=(const interval& b) { return *this = *this + b; }
  constexpr interval& operator-=(const interval& b) { return *this = *this - b; }
  constexpr interval& operator*=(const interval& b) { return *this = *this * b; }
  constexpr interval& operator/=(const interval& b) { return *this = *this / b; }

  friend constexpr truth operator<(const interval& a, const interval& b) {
    return a.upper_ < b.lower_ ? truth::yes : a.lower_ < b.upper_ ? truth::maybe : truth::no;
  }
  friend constexpr truth operator>(const interval& a, const interval& b) { return b < a; }
  friend constexpr truth operator<=(const interval& a, const interval& b) { return !(b < a); }
  friend constexpr truth operator>=(const interval& a, const interval& b) { return !(a < b); }
  friend constexpr truth operator==(const interval& a, const interval& b) {
    if (a.upper_ < b.lower_ || b.upper_ < a.lower_) return truth::no;
    return a.lower_ == a.upper_ && b.lower_ == b.upper_ ? truth::yes : truth::maybe;
  }
  friend constexpr truth operator!=(const interval& a, const interval& b) { return !(a == b); }

  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out, const interval& a) {
    return out << '[' << a.lower_ << ", " << a.upper_ << ']';
  }

  /// The smallest interval that holds both.
  friend constexpr interval hull(const interval& a, const interval& b) {
    return {b.lower_ < a.lower_ ? b.lower_ : a.lower_, a.upper_ < b.upper_ ? b.upper_ : a.upper_};
  }
  /// Where the condition may be either, both sides' values are possible.
  friend constexpr interval select(truth t, const interval& a, const interval& b) {
    return t == truth::yes ? a : t == truth::no ? b : hull(a, b);
  }
  friend constexpr interval min(const interval& a, const interval& b) {
    return {b.lower_ < a.lower_ ? b.lower_ : a.lower_, b.upper_ < a.upper_ ? b.upper_ : a.upper_};
  }
  friend constexpr interval max(const interval& a, const interval& b) {
    return {a.lower_ < b.lower_ ? b.lower_ : a.lower_, a.upper_ < b.upper_ ? b.upper_ : a.upper_};
  }
  friend constexpr interval abs(const interval& a) {
    if (!(a.lower_ < T(0))) return a;
    if (a.upper_ < T(0)) return -a;
    return {T(0), -a.lower_ < a.upper_ ? a.upper_ : -a.lower_};
  }
  friend constexpr interval fma(const interval& a, const interval& b, const interval& c) { return a * b + c; }
  friend constexpr interval sqrt(const interval& a)
    requires requires { bounds::sqrt(T(0)); }
  {
    return {bounds::sqrt(not_negative(a.lower_)).first, bounds::sqrt(not_negative(a.upper_)).second};
  }
  friend constexpr interval exp(const interval& a)
    requires requires { bounds::round(exact_result{}); }
  {
    return {bounds::round(elementary::exp(static_cast<double>(a.lower_))).first,
            bounds::round(elementary::exp(static_cast<double>(a.upper_))).second};
  }
  friend constexpr interval log(const interval& a)
    requires requires { bounds::round(exact_result{}); }
  {
    return {bounds::round(elementary::log(static_cast<double>(not_negative(a.lower_)))).first,
            bounds::round(elementary::log(static_cast<double>(not_negative(a.upper_)))).second};
  }

 private:
  static constexpr T not_negative(const T& x) { return x < T(0) ? T(0) : x; }
  template <class U>
  static constexpr interval enclosing(U x) {
    if constexpr (requires { bounds::round(exact_result{}); }) {
      const auto both = bounds::round(unpack_any(x));
      return {both.first, both.second};
    } else {
      return interval(T(x));
    }
  }
  static constexpr interval product(const T& a, const T& b) {
    const auto p = bounds::multiply(a, b);
    return {p.first, p.second};
  }
  static constexpr interval ratio(const T& a, const T& b) {
    const auto q = bounds::divide(a, b);
    return {q.first, q.second};
  }
  static constexpr interval everything(const interval& a, const interval& b) {
    if constexpr (requires { bounds::infinity(); }) {
      return {-bounds::infinity(), bounds::infinity()};
    } else {
      return ratio(a.lower_, b.lower_ - b.lower_);  // division by zero, as Q reports it
    }
  }

  T lower_, upper_;
};

template <class T> inline constexpr bool is_interval = false;
template <class T> inline constexpr bool is_interval<interval<T>> = true;

}  // namespace bitshade
