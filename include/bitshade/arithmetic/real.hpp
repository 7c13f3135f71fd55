// A number that is rounded after every operation: drop-in for float, in any format.
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include "bitshade/formats/round_to.hpp"

namespace bitshade {

/// A value of a format, carried in a wider type.
///
/// Policy   every operation is the exact result rounded once by R.
template <class Format, rules R = rules{}, class Carrier = double>
class real {
 public:
  using format_type = Format;
  using carrier_type = Carrier;
  static constexpr encoding encoding_value = Format::value;
  static constexpr rules rules_value = R;

  real() = default;
  /// Rounds once; implicit, since every operation rounds as well.
  template <class T>
    requires std::is_arithmetic_v<T>
  constexpr real(T x) : value_(static_cast<Carrier>(round_to(Format::value, static_cast<double>(x), R))) {}

  static constexpr real from_bits(typename Format::bits_type bits) {
    real r;
    r.value_ = static_cast<Carrier>(decode(Format::value, bits));
    return r;
  }
  constexpr typename Format::bits_type bits() const {
    return static_cast<typename Format::bits_type>(encode(Format::value, static_cast<double>(value_), R));
  }
  constexpr Carrier carrier() const { return value_; }

  template <class T>
    requires std::is_arithmetic_v<T>
  explicit constexpr operator T() const {
    return static_cast<T>(value_);
  }

  friend constexpr real operator+(real a, real b) { return real(a.value_ + b.value_); }
  friend constexpr real operator-(real a, real b) { return real(a.value_ - b.value_); }
  friend constexpr real operator*(real a, real b) { return real(a.value_ * b.value_); }
  friend constexpr real operator/(real a, real b) { return real(a.value_ / b.value_); }
  friend constexpr real operator-(real a) {
    a.value_ = -a.value_;
    return a;
  }
  friend constexpr real operator+(real a) { return a; }
  constexpr real& operator+=(real b) { return *this = *this + b; }
  constexpr real& operator-=(real b) { return *this = *this - b; }
  constexpr real& operator*=(real b) { return *this = *this * b; }
  constexpr real& operator/=(real b) { return *this = *this / b; }
  friend constexpr bool operator==(real a, real b) { return a.value_ == b.value_; }
  friend constexpr auto operator<=>(real a, real b) { return a.value_ <=> b.value_; }

  friend real sqrt(real a) { return real(std::sqrt(a.value_)); }
  friend constexpr real abs(real a) { return a.value_ < 0 ? -a : a; }

 private:
  Carrier value_;
};

}  // namespace bitshade
