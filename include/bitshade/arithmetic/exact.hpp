// Arithmetic that loses nothing, over any rational type.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
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

  const Q& value() const { return value_; }
  template <class T>
    requires std::is_arithmetic_v<T>
  explicit operator T() const {
    return static_cast<T>(value_);
  }

  exact& operator+=(const exact& b) { value_ += b.value_; return *this; }
  exact& operator-=(const exact& b) { value_ -= b.value_; return *this; }
  exact& operator*=(const exact& b) { value_ *= b.value_; return *this; }
  exact& operator/=(const exact& b) { value_ /= b.value_; return *this; }
  friend exact operator+(exact a, const exact& b) { return a += b; }
  friend exact operator-(exact a, const exact& b) { return a -= b; }
  friend exact operator*(exact a, const exact& b) { return a *= b; }
  friend exact operator/(exact a, const exact& b) { return a /= b; }
  friend exact operator-(const exact& a) { return exact(Q(-a.value_)); }
  friend exact operator+(const exact& a) { return a; }
  friend bool operator==(const exact& a, const exact& b) { return a.value_ == b.value_; }
  friend bool operator!=(const exact& a, const exact& b) { return !(a == b); }
  friend bool operator<(const exact& a, const exact& b) { return a.value_ < b.value_; }
  friend bool operator>(const exact& a, const exact& b) { return b < a; }
  friend bool operator<=(const exact& a, const exact& b) { return !(b < a); }
  friend bool operator>=(const exact& a, const exact& b) { return !(a < b); }
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
    Q power(1), base(2);
    for (int n = e < 0 ? -e : e; n != 0; n >>= 1) {
      if (n & 1) power *= base;
      base *= base;
    }
    const Q magnitude = e < 0 ? Q(Q(m) / power) : Q(Q(m) * power);
    return (bits >> 63) != 0 ? Q(-magnitude) : magnitude;
  }

  Q value_;
};

template <class T> inline constexpr bool is_exact = false;
template <class Q> inline constexpr bool is_exact<exact<Q>> = true;

}  // namespace bitshade
