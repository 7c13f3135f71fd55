// Any number type, counting what its operations do. A policy that does not name it does not contain it.
#pragma once

#include <compare>
#include <iosfwd>
#include <limits>

#include "bitshade/arithmetic/counting.hpp"
#include "bitshade/arithmetic/real_limits.hpp"

namespace bitshade {

/// A T that reports to the counts it was given; results inherit the pointer of the first operand that has one, so that
/// there is no global state. Constants have none and cost nothing until they meet a number that has.
///
/// Shapes   T: float, double or real<F>. <cmath> for it is counted_math.hpp.
template <class T>
class counted {
  using traits = detail::arithmetic_of<T>;
  static constexpr encoding E = traits::format;
  static constexpr encoding wide = detail::with_room(E);

 public:
  using value_type = T;

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

  /// A result of operands that report somewhere, and the operation as a function from rules to the result's bits.
  template <class Operation, class... Operands>
  static constexpr counted record(const T& result, Operation operation, const Operands&... x) {
    operation_counts* where = nullptr;
    ((where = where != nullptr ? where : x.where_), ...);
    const auto finite = [](double d) { return d - d == 0; };
    if (where != nullptr)
      detail::count_operation<E, traits::policy>(*where, (finite(static_cast<double>(x.value_)) && ...), operation);
    return {result, where};
  }

  friend constexpr counted operator+(const counted& a, const counted& b) {
    return sum(exactly(a), exactly(b),
               record(a.value_ + b.value_, [&](const rules& r) { return add(wide, bits(a), bits(b), r); }, a, b));
  }
  friend constexpr counted operator-(const counted& a, const counted& b) {
    exact_result minus_b = exactly(b);
    minus_b.negative = !minus_b.negative;
    return sum(exactly(a), minus_b,
               record(a.value_ - b.value_, [&](const rules& r) { return subtract(wide, bits(a), bits(b), r); }, a, b));
  }
  friend constexpr counted operator*(const counted& a, const counted& b) {
    return record(a.value_ * b.value_, [&](const rules& r) { return multiply(wide, bits(a), bits(b), r); }, a, b);
  }
  friend constexpr counted operator/(const counted& a, const counted& b) {
    return record(a.value_ / b.value_, [&](const rules& r) { return divide(wide, bits(a), bits(b), r); }, a, b);
  }
  friend constexpr counted sqrt(const counted& a) {
    using std::sqrt;
    return record(T(sqrt(a.value_)), [&](const rules& r) { return square_root(wide, bits(a), r); }, a);
  }
  /// One operation, rounded once, that may cancel.
  friend constexpr counted fma(const counted& a, const counted& b, const counted& c) {
    using emulated = typename traits::emulated;
    const auto result = static_cast<T>(fma(emulated(a.value_), emulated(b.value_), emulated(c.value_)));
    exact_result product = exactly(a);
    const exact_result factor = exactly(b);
    product.negative = product.negative != factor.negative;
    product.n *= factor.n;
    product.exponent += factor.exponent;
    if (!factor.is_finite()) product.what = factor.what;
    const auto operation = [&](const rules& r) { return fused_multiply_add(wide, bits(a), bits(b), bits(c), r); };
    return sum(product, exactly(c), record(result, operation, a, b, c));
  }
  friend constexpr counted operator-(const counted& a) { return {-a.value_, a.where_}; }
  friend constexpr counted operator+(const counted& a) { return a; }
  friend constexpr counted abs(const counted& a) { return {a.value_ < T(0) ? -a.value_ : a.value_, a.where_}; }
  constexpr counted& operator+=(const counted& b) { return *this = *this + b; }
  constexpr counted& operator-=(const counted& b) { return *this = *this - b; }
  constexpr counted& operator*=(const counted& b) { return *this = *this * b; }
  constexpr counted& operator/=(const counted& b) { return *this = *this / b; }
  constexpr counted& operator++() { return *this += counted(1); }
  constexpr counted& operator--() { return *this -= counted(1); }
  constexpr counted operator++(int) {
    const counted old = *this;
    ++*this;
    return old;
  }
  constexpr counted operator--(int) {
    const counted old = *this;
    --*this;
    return old;
  }
  friend constexpr auto operator<=>(const counted& a, const counted& b) { return a.value_ <=> b.value_; }
  friend constexpr bool operator==(const counted& a, const counted& b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(const counted& a, const counted& b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(const counted& a, const counted& b) { return a.value_ < b.value_; }
  friend constexpr bool operator<=(const counted& a, const counted& b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>(const counted& a, const counted& b) { return a.value_ > b.value_; }
  friend constexpr bool operator>=(const counted& a, const counted& b) { return a.value_ >= b.value_; }

 private:
  static constexpr std::uint64_t bits(const counted& x) {
    return detail::roomy_bits<E>(static_cast<double>(x.value_));
  }
  static constexpr exact_result exactly(const counted& x) { return unpack(static_cast<double>(x.value_)); }
  /// r, which is the sum of two exact terms.
  static constexpr counted sum(const exact_result& a, const exact_result& b, const counted& r) {
    if (r.where_ != nullptr && detail::cancels(E, a, b)) r.where_->cancellations += 1;
    return r;
  }

  T value_{};
  operation_counts* where_ = nullptr;
};

}  // namespace bitshade

/// T's limits, as numbers that count nothing.
template <class T>
struct std::numeric_limits<bitshade::counted<T>> : std::numeric_limits<T> {
 private:
  using limits = std::numeric_limits<T>;
  using number = bitshade::counted<T>;

 public:
  static constexpr number min() noexcept { return limits::min(); }
  static constexpr number max() noexcept { return limits::max(); }
  static constexpr number lowest() noexcept { return limits::lowest(); }
  static constexpr number epsilon() noexcept { return limits::epsilon(); }
  static constexpr number round_error() noexcept { return limits::round_error(); }
  static constexpr number infinity() noexcept { return limits::infinity(); }
  static constexpr number quiet_NaN() noexcept { return limits::quiet_NaN(); }
  static constexpr number signaling_NaN() noexcept { return limits::signaling_NaN(); }
  static constexpr number denorm_min() noexcept { return limits::denorm_min(); }
};
