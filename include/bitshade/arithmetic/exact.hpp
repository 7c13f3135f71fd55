// Arithmetic that loses nothing, over any rational type.
#pragma once

#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "bitshade/formats/contract.hpp"

namespace bitshade {

/// A rational number: + - x / and comparisons are exact, conversions in are exact, conversions out are explicit.
///
/// Q needs construction from an integer, + - x / and comparisons, all exact. Boost's is interop/rational.hpp.
/// Failure  std::domain_error for an infinite or NaN number, which no rational is; division by zero is Q's.
template <class Q>
class exact {
 public:
  using rational_type = Q;

  exact() : value_(0) {}
  exact(Q value) : value_(std::move(value)) {}
  template <std::integral T>
  exact(T x) : value_(x) {}
  exact(float x) : value_(from_double(x)) {}
  exact(double x) : value_(from_double(x)) {}
  exact(long double x) : value_(from_longer(x)) {}

  const Q& value() const { return value_; }
  template <class T>
    requires std::is_arithmetic_v<T>
  explicit operator T() const {
    if constexpr (std::is_floating_point_v<T>) return nearest<T>();
    else return static_cast<T>(value_);
  }

  exact& operator+=(const exact& b) { value_ += b.value_; return *this; }
  exact& operator-=(const exact& b) { value_ -= b.value_; return *this; }
  exact& operator*=(const exact& b) { value_ *= b.value_; return *this; }
  exact& operator/=(const exact& b) { value_ /= b.value_; return *this; }
  friend exact operator+(exact a, const exact& b) { return a += b; }
  friend exact operator-(exact a, const exact& b) { return a -= b; }
  friend exact operator*(exact a, const exact& b) { return a *= b; }
  friend exact operator/(exact a, const exact& b) { return a /= b; }
  exact& operator++() { return *this += exact(1); }
  exact& operator--() { return *this -= exact(1); }
  exact operator++(int) {
    exact old = *this;
    ++*this;
    return old;
  }
  exact operator--(int) {
    exact old = *this;
    --*this;
    return old;
  }
  friend exact operator-(const exact& a) { return exact(Q(-a.value_)); }
  friend exact operator+(const exact& a) { return a; }
  friend bool operator==(const exact& a, const exact& b) { return a.value_ == b.value_; }
  friend bool operator!=(const exact& a, const exact& b) { return !(a == b); }
  friend bool operator<(const exact& a, const exact& b) { return a.value_ < b.value_; }
  friend bool operator>(const exact& a, const exact& b) { return b < a; }
  friend bool operator<=(const exact& a, const exact& b) { return !(b < a); }
  friend bool operator>=(const exact& a, const exact& b) { return !(a < b); }
  friend std::strong_ordering operator<=>(const exact& a, const exact& b) {
    if (a.value_ < b.value_) return std::strong_ordering::less;
    return b.value_ < a.value_ ? std::strong_ordering::greater : std::strong_ordering::equal;
  }
  /// As Q is written.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out, const exact& a) {
    return out << a.value_;
  }
  friend exact abs(const exact& a) { return a < exact(0) ? -a : a; }

 private:
  /// m 2^e by square and multiply: exact for every finite double.
  static Q from_double(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int field = static_cast<int>((bits >> 52) & 0x7ff);
    if (field == 0x7ff) throw std::domain_error("bitshade: exact takes finite numbers, not an infinity or a NaN");
    std::int64_t m = static_cast<std::int64_t>(bits & ((std::uint64_t{1} << 52) - 1));
    if (field != 0) m |= std::int64_t{1} << 52;
    if (m == 0) return Q(0);
    int e = (field == 0 ? 1 : field) - 1075;
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(m));
    m >>= zeros;
    e += zeros;
    const Q power = power_of_2(e < 0 ? -e : e);
    const Q magnitude = e < 0 ? Q(Q(m) / power) : Q(Q(m) * power);
    return (bits >> 63) != 0 ? Q(-magnitude) : magnitude;
  }

  /// The same by 32 bits at a time: what a long double is differs between machines.
  static Q from_longer(long double x) {
    if (!(x - x == 0)) throw std::domain_error("bitshade: exact takes finite numbers, not an infinity or a NaN");
    int e = 0;
    long double rest = std::frexp(x, &e);
    Q n(0);
    for (; rest != 0; e -= 32) {
      rest = std::ldexp(rest, 32);
      const auto digit = static_cast<std::int64_t>(rest);
      n = Q(n * Q(std::int64_t{1} << 32)) + Q(digit);
      rest -= static_cast<long double>(digit);
    }
    return e < 0 ? Q(n / power_of_2(-e)) : Q(n * power_of_2(e));
  }
  static Q power_of_2(int n) {
    Q power(1), base(2);
    for (; n != 0; n >>= 1) {
      if (n & 1) power *= base;
      base *= base;
    }
    return power;
  }

  /// Q's conversion; among T's subnormal numbers Boost's rounds twice, so that a neighbour may be nearer.
  template <class T>
  T nearest() const {
    using limits = std::numeric_limits<T>;
    const T x = static_cast<T>(value_);
    if constexpr (std::is_same_v<T, long double>) return x;
    if (!(x - x == 0) || (x < 0 ? -x : x) > limits::min() || value_ == Q(0)) return x;
    T best = x;
    exact least = off(x);
    for (const T end : {-limits::infinity(), limits::infinity()}) {
      const T other = std::nextafter(x, end);
      const exact distance = off(other);
      const bool even = (std::bit_cast<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>(other) & 1) == 0;
      if (distance < least || (distance == least && even)) best = other, least = distance;
    }
    return best;
  }
  exact off(double x) const { return abs(exact(x) - *this); }

  Q value_;
};

template <class T> inline constexpr bool is_exact = false;
template <class Q> inline constexpr bool is_exact<exact<Q>> = true;

}  // namespace bitshade
