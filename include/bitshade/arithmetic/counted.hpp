// Any number type, counting what its operations do. A policy that does not name it does not contain it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

/// What the operations of one stage did.
struct operation_counts {
  std::uint64_t operations = 0;
  std::uint64_t roundings = 0;      ///< inexact results
  std::uint64_t cancellations = 0;  ///< sums that lost at least half of their leading bits
  std::uint64_t overflows = 0;      ///< finite operands, a result beyond the largest number
  std::uint64_t subnormals = 0;     ///< results below the smallest normal number, zero excepted

  friend bool operator==(const operation_counts&, const operation_counts&) = default;
};

/// One row a stage; stages are numbered by whoever counts.
template <std::size_t Stages>
using tally = std::array<operation_counts, Stages>;

/// A T that reports to the counts it was given; results inherit the pointer of either operand, so that there is no
/// global state. Constants have none and cost nothing until they meet a number that has.
///
/// Shapes   T: float, double or real<F>.
template <class T>
class counted {
  static constexpr encoding E = [] {
    if constexpr (real_number<T>) return T::encoding_value;
    else return detail::shape_of<T>::value;
  }();

 public:
  counted() = default;
  template <class U>
    requires std::constructible_from<T, U>
  constexpr counted(const U& x) : value_(T(x)) {}
  constexpr counted(const T& x, operation_counts* where) : value_(x), where_(where) {}

  constexpr const T& value() const { return value_; }
  constexpr operation_counts* where() const { return where_; }
  /// The same number, from now on counted elsewhere: how a value enters another stage.
  constexpr counted at(operation_counts* where) const { return {value_, where}; }
  template <class U>
    requires std::is_arithmetic_v<U>
  explicit constexpr operator U() const {
    return static_cast<U>(value_);
  }

  friend constexpr counted operator+(const counted& a, const counted& b) {
    return sum(a, b, a.value_ + b.value_, [](auto x, auto y, const rules& r) { return add(E, x, y, r); });
  }
  friend constexpr counted operator-(const counted& a, const counted& b) {
    return sum(a, b, a.value_ - b.value_, [](auto x, auto y, const rules& r) { return subtract(E, x, y, r); });
  }
  friend constexpr counted operator*(const counted& a, const counted& b) {
    return record(a.value_ * b.value_, [](auto x, auto y, const rules& r) { return multiply(E, x, y, r); }, a, b);
  }
  friend constexpr counted operator/(const counted& a, const counted& b) {
    return record(a.value_ / b.value_, [](auto x, auto y, const rules& r) { return divide(E, x, y, r); }, a, b);
  }
  friend constexpr counted sqrt(const counted& a) {
    using std::sqrt;
    return record(T(sqrt(a.value_)), [](auto x, const rules& r) { return square_root(E, x, r); }, a);
  }
  friend constexpr counted operator-(const counted& a) { return {-a.value_, a.where_}; }
  friend constexpr counted operator+(const counted& a) { return a; }
  friend constexpr counted abs(const counted& a) { return {a.value_ < T(0) ? -a.value_ : a.value_, a.where_}; }
  constexpr counted& operator+=(const counted& b) { return *this = *this + b; }
  constexpr counted& operator-=(const counted& b) { return *this = *this - b; }
  constexpr counted& operator*=(const counted& b) { return *this = *this * b; }
  constexpr counted& operator/=(const counted& b) { return *this = *this / b; }
  friend constexpr bool operator==(const counted& a, const counted& b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(const counted& a, const counted& b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(const counted& a, const counted& b) { return a.value_ < b.value_; }
  friend constexpr bool operator<=(const counted& a, const counted& b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>(const counted& a, const counted& b) { return a.value_ > b.value_; }
  friend constexpr bool operator>=(const counted& a, const counted& b) { return a.value_ >= b.value_; }

 private:
  static constexpr std::uint64_t bits(const counted& x) { return encode(E, static_cast<double>(x.value_)); }

  /// An operation is exact where rounding it down and up is the same.
  template <class Operation, class... Operands>
  static constexpr counted record(const T& result, Operation operation, const Operands&... x) {
    operation_counts* where = nullptr;
    ((where = where != nullptr ? where : x.where_), ...);
    if (where != nullptr) {
      where->operations += 1;
      const std::uint64_t low = operation(bits(x)..., rules{rounding::down});
      const std::uint64_t high = operation(bits(x)..., rules{rounding::up});
      const auto number = [](double d) { return d - d == 0; };
      const bool finite = (number(static_cast<double>(x.value_)) && ...);
      const double r = static_cast<double>(result);
      // A sum that is exactly 0 differs in its sign alone.
      if (decode(E, low) < decode(E, high)) where->roundings += 1;
      if (finite && r == r && decode(E, high) - decode(E, low) > 0 &&
          (!number(decode(E, high)) || !number(decode(E, low))))
        where->overflows += 1;
      const double size = r < 0 ? -r : r;
      if (E.kind == family::binary && size > 0 && size < decode(E, min_normal_bits(E))) where->subnormals += 1;
    }
    return {result, where};
  }
  template <class Operation>
  static constexpr counted sum(const counted& a, const counted& b, const T& result, Operation operation) {
    const counted r = record(result, operation, a, b);
    if (r.where_ != nullptr) {
      const exact_result x = unpack(static_cast<double>(a.value_)), y = unpack(static_cast<double>(b.value_)),
                         z = unpack(static_cast<double>(result));
      const auto lead = [](const exact_result& u) { return u.exponent + bit_width(u.n); };
      if (x.is_finite() && y.is_finite() && z.is_finite() && x.n != 0 && y.n != 0) {
        const auto most = lead(x) > lead(y) ? lead(x) : lead(y);
        if (z.n == 0 || most - lead(z) >= (precision(E) + 1) / 2) r.where_->cancellations += 1;
      }
    }
    return r;
  }

  T value_{};
  operation_counts* where_ = nullptr;
};

}  // namespace bitshade
