// A number that is rounded after every operation: drop-in for float, in any format.
#pragma once

#include <compare>
#include <concepts>
#include <limits>
#include <type_traits>

#include "bitshade/arithmetic/carrier.hpp"
#include "bitshade/formats/round_to.hpp"

namespace bitshade {

/// Whether every number of `from` is one of `to`, so that a conversion loses nothing.
constexpr bool contains(const encoding& to, const encoding& from) {
  if (to == from) return true;
  if (to.kind != family::binary || (from.has_sign && !to.has_sign)) return false;
  if (from.kind == family::binary) {
    return to.fraction_bits >= from.fraction_bits && min_ulp_exponent(to) <= min_ulp_exponent(from) &&
           bias(to) >= bias(from) + (from.special != to.special ? 1 : 0) && (has_infinity(to) || !has_infinity(from));
  }
  if (from.kind == family::unorm || from.kind == family::snorm) return false;
  return precision(to) >= from.width && min_ulp_exponent(to) <= -from.fraction_bits &&
         bias(to) >= from.width - from.fraction_bits;
}

/// A value of a format.
///
/// Shapes   Carrier holds the value: float, double, or a pack of them (carrier.hpp).
/// Policy   R; every operation is the exactly computed result rounded once by it, whatever the carrier: where the
///          carrier's own operations would round twice, integers take over (operations.hpp).
/// Error    none beyond that rounding for + - * / sqrt fma and conversions; elementary functions say theirs.
/// Failure  as IEEE 754 says; NaN is one value, its payload and sign are not kept. Stochastic rounding needs random
///          bits, which an operator cannot ask for: call operations.hpp, or use samples.hpp.
///          The carrier's operations need the default floating-point environment (environment.hpp guards it).
template <class Format, rules R = rules{}, class Carrier = default_carrier<Format>>
class real {
  static constexpr encoding E = Format::value;
  using traits = carrier_traits<Carrier>;
  using scalar = typename traits::scalar;

  static_assert(R.direction != rounding::stochastic,
                "bitshade: real cannot round stochastically, since operators carry no random bits: use samples.hpp");
  static_assert(E.kind == family::binary || E.width <= 53, "bitshade: real holds formats of at most 53 bits");
  static_assert(std::is_same_v<scalar, double> || contains(binary_encoding(8, 23), E),
                "bitshade: this carrier does not hold every number of the format");

  /// The carrier's operation, then one rounding, is right.
  static constexpr bool direct =
      is_nearest(R.direction) && !flushes_input(R.subnormal) &&
      ((std::is_same_v<scalar, float> ? carried_by_float(E) : carried_by_double(E)) ||
       (E == detail::shape_of<scalar>::value && R.direction == rounding::nearest_even));
  static constexpr bool direct_fma = is_nearest(R.direction) && !flushes_input(R.subnormal) && carried_by_double(E);

 public:
  using format_type = Format;
  using carrier_type = Carrier;
  using bits_type = typename Format::bits_type;
  using mask_type = typename traits::mask;
  static constexpr encoding encoding_value = E;
  static constexpr rules rules_value = R;

  real() = default;

  /// Rounds once; implicit, since every operation rounds as well. Whatever the compiler calls an integer or a floating
  /// point type: 128-bit ones too, where it takes its extensions for standard (-std=gnu++20).
  template <std::floating_point T>
  constexpr real(T x) : value_(traits::broadcast(from_floating(x))) {}
  template <std::integral T>
  constexpr real(T x) : value_(traits::broadcast(from_integer(x))) {}
  /// Implicit where nothing is lost.
  template <class F, rules S, class C>
    requires(!std::is_same_v<real<F, S, C>, real> && carrier_traits<C>::lanes == 1)
  explicit(!contains(Format::value, F::value)) constexpr real(real<F, S, C> x)
      : value_(traits::broadcast(from_real(x))) {}

  // Always inline: over a pack an operation that is called passes its operands through memory.

  /// The lanes of a carrier, each rounded.
  [[gnu::always_inline]] static constexpr real from_carrier(Carrier x) { return make(traits::template round<E, R>(x)); }
  static constexpr real from_bits(bits_type bits) {
    return make(traits::broadcast(static_cast<scalar>(decode(E, bits))));
  }
  /// The value that an exact result rounds to: how functions outside this class finish.
  static constexpr real from_exact(const exact_result& x)
    requires(traits::lanes == 1)
  {
    return make(static_cast<scalar>(decode(E, round_result(E, x, R))));
  }
  /// The value that a result on the format's grid rounds to: for norms it counts steps, since values are ratios.
  static constexpr real from_grid(const exact_result& x)
    requires(traits::lanes == 1)
  {
    return make(static_cast<scalar>(decode(E, round_on_grid(E, x, R))));
  }
  /// The operand on that grid: a norm's code, any other number itself.
  constexpr double on_grid() const
    requires(traits::lanes == 1)
  {
    if constexpr (is_norm(E)) {
      const auto code = static_cast<std::int64_t>(std::uint64_t{bits()});
      return static_cast<double>(value_ < 0 ? code - (std::int64_t{1} << E.width) : code);
    } else {
      return operand();
    }
  }
  /// The value as an operand: a zero where R flushes subnormal inputs.
  constexpr double operand() const
    requires(traits::lanes == 1)
  {
    return flushes_input(R.subnormal) ? decode(E, bits(), R) : static_cast<double>(value_);
  }
  constexpr bits_type bits() const
    requires(traits::lanes == 1)
  {
    if (value_ != value_) return static_cast<bits_type>(nan_bits(E));
    return static_cast<bits_type>(encode(E, static_cast<double>(value_), code_rules));
  }
  constexpr Carrier carrier() const { return value_; }

  template <class T>
    requires(std::is_arithmetic_v<T> && traits::lanes == 1)
  explicit constexpr operator T() const {
    return static_cast<T>(value_);
  }

  [[gnu::always_inline]] friend constexpr real operator+(const real& a, const real& b) {
    if constexpr (direct) return from_carrier(a.value_ + b.value_);
    else return by_bits([](auto x, auto y) { return add(E, x, y, R); }, a, b);
  }
  [[gnu::always_inline]] friend constexpr real operator-(const real& a, const real& b) {
    if constexpr (direct) return from_carrier(a.value_ - b.value_);
    else return by_bits([](auto x, auto y) { return subtract(E, x, y, R); }, a, b);
  }
  [[gnu::always_inline]] friend constexpr real operator*(const real& a, const real& b) {
    if constexpr (direct) return from_carrier(a.value_ * b.value_);
    else return by_bits([](auto x, auto y) { return multiply(E, x, y, R); }, a, b);
  }
  [[gnu::always_inline]] friend constexpr real operator/(const real& a, const real& b) {
    if constexpr (direct) {
      if constexpr (traits::lanes == 1) {
        // Division by zero is no constant expression in the carrier.
        if (std::is_constant_evaluated()) return by_bits([](auto x, auto y) { return divide(E, x, y, R); }, a, b);
      }
      return from_carrier(a.value_ / b.value_);
    } else {
      return by_bits([](auto x, auto y) { return divide(E, x, y, R); }, a, b);
    }
  }
  [[gnu::always_inline]] friend constexpr real sqrt(const real& a) {
    if constexpr (direct) return from_carrier(traits::sqrt(a.value_));
    else return by_bits([](auto x) { return square_root(E, x, R); }, a);
  }
  /// a b + c, rounded once: its own, since a carrier's fma rounds twice.
  [[gnu::always_inline]] friend constexpr real fma(const real& a, const real& b, const real& c) {
    if constexpr (direct_fma) return make(traits::template fused<E, R>(a.value_, b.value_, c.value_));
    else return by_bits([](auto x, auto y, auto z) { return fused_multiply_add(E, x, y, z, R); }, a, b, c);
  }

  friend constexpr real operator+(const real& a) { return a; }
  friend constexpr real operator-(const real& a) {
    // A sign bit only flips; two's complement and unsigned formats have ends to clamp at.
    if constexpr (E.kind == family::binary && E.has_sign) return make(-a.value_);
    else if constexpr (E.kind == family::snorm) return make(traits::broadcast(0) - a.value_);  // no direction moves it
    else return from_carrier(-a.value_);
  }
  constexpr real& operator+=(const real& b) { return *this = *this + b; }
  constexpr real& operator-=(const real& b) { return *this = *this - b; }
  constexpr real& operator*=(const real& b) { return *this = *this * b; }
  constexpr real& operator/=(const real& b) { return *this = *this / b; }
  constexpr real& operator++() { return *this += real(1); }
  constexpr real& operator--() { return *this -= real(1); }
  constexpr real operator++(int) {
    const real old = *this;
    *this += real(1);
    return old;
  }
  constexpr real operator--(int) {
    const real old = *this;
    *this -= real(1);
    return old;
  }

  [[gnu::always_inline]] friend constexpr mask_type operator==(const real& a, const real& b) { return a.value_ == b.value_; }
  [[gnu::always_inline]] friend constexpr mask_type operator!=(const real& a, const real& b) { return a.value_ != b.value_; }
  [[gnu::always_inline]] friend constexpr mask_type operator<(const real& a, const real& b) { return a.value_ < b.value_; }
  [[gnu::always_inline]] friend constexpr mask_type operator<=(const real& a, const real& b) { return a.value_ <= b.value_; }
  [[gnu::always_inline]] friend constexpr mask_type operator>(const real& a, const real& b) { return a.value_ > b.value_; }
  [[gnu::always_inline]] friend constexpr mask_type operator>=(const real& a, const real& b) { return a.value_ >= b.value_; }

  friend constexpr std::partial_ordering operator<=>(const real& a, const real& b)
    requires(traits::lanes == 1)
  {
    return a.value_ <=> b.value_;
  }

  friend constexpr real abs(const real& a) {
    // Two's complement does not hold the opposite of its lowest number.
    if constexpr (E.kind == family::fixed) return from_carrier(traits::abs(a.value_));
    else return make(traits::abs(a.value_));
  }
  friend constexpr real fabs(const real& a) { return abs(a); }
  [[gnu::always_inline]] friend constexpr real select(mask_type m, const real& a, const real& b) {
    if constexpr (traits::lanes == 1) return m ? a : b;
    else return make(select(m, a.value_, b.value_));
  }

 private:
  /// The value is one of E's: no direction may move it, and infinity is not an overflow.
  static constexpr rules code_rules{};

  [[gnu::always_inline]] static constexpr real make(Carrier x) {
    real r;
    r.value_ = x;
    return r;
  }
  template <class Operation, class... Reals>
  static constexpr real by_bits(Operation operation, const Reals&... x) {
    static_assert(traits::lanes == 1, "bitshade: a pack holds formats that its lanes carry without rounding twice");
    real r;
    r.value_ = static_cast<scalar>(decode(E, operation(x.bits()...)));
    return r;
  }

  template <class Other>
  static constexpr scalar from_real(const Other& x) {
    constexpr encoding from = Other::encoding_value;
    // The carrier holds every other number as it is.
    if constexpr (is_norm(from)) return static_cast<scalar>(decode(E, convert(E, from, x.bits(), R)));
    else return from_floating(static_cast<double>(x.carrier()));
  }
  template <class T>
  static constexpr scalar from_floating(T x) {
    if constexpr (traits::lanes == 1 && std::is_same_v<T, scalar>) {
      return traits::template round<E, R>(x);
    } else if constexpr (sizeof(T) <= sizeof(double)) {
      // float to double is exact, so that this rounds once.
      return static_cast<scalar>(carrier_traits<double>::template round<E, R>(static_cast<double>(x)));
    } else {
      return static_cast<scalar>(decode(E, round_result(E, unpack_longer(x), R)));
    }
  }
  template <class T>
  static constexpr scalar from_integer(T x) {
    // Exact in binary64, and short enough for compilers to fold.
    if constexpr (sizeof(T) <= 4) return from_floating(static_cast<double>(x));
    return static_cast<scalar>(decode(E, round_result(E, unpack_any(x), R)));
  }

  Carrier value_;
};

template <class T> inline constexpr bool is_real = false;
template <class F, rules R, class C> inline constexpr bool is_real<real<F, R, C>> = true;

/// A real's format as data: what a generic function asks for.
template <class T>
concept real_number = is_real<T>;

}  // namespace bitshade
