// What holds an emulated number: a scalar here, a SIMD pack elsewhere. One source serves all of them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "bitshade/arithmetic/operations.hpp"

#if defined(__F16C__)
#include <immintrin.h>
#endif

namespace bitshade {

/// How `real` works on a carrier C. A pack specialises it with lanes > 1; it must offer, beside this,
/// + - * / (IEEE, to nearest, lane by lane), unary -, comparisons that give `mask`, and select(mask, C, C).
///
///   scalar                   float or double: what a lane is
///   lanes                    how many
///   mask                     what comparisons give
///   broadcast(scalar)        the same number in every lane
///   round<E, R>(C)           each lane rounded to E by R; binary formats to nearest suffice for a pack
///   sqrt(C), abs(C)          IEEE square root; the sign cleared
///   fused<E, R>(a, b, c)     a b + c, rounded to E once
template <class C>
struct carrier_traits;

/// Whether one IEEE operation of a carrier with p bits, then one rounding to nearest of e, is one rounding of the
/// exact result: + - x / and square root.
///
/// p >= 2 precision(e) + 2 keeps results that are no ties of e off its ties [Figueroa95]; a product of two of e's
/// smallest numbers must be exact, so that the same holds among e's subnormals; and what overflows the carrier
/// overflows e.
constexpr bool carries(const encoding& e, int p, int least_exponent, int most_exponent) {
  return e.kind == family::binary && e.has_sign && p >= 2 * precision(e) + 2 &&
         2 * min_ulp_exponent(e) >= least_exponent && bias(e) + 2 <= most_exponent;
}
constexpr bool carried_by_float(const encoding& e) { return carries(e, 24, -149, 128); }
constexpr bool carried_by_double(const encoding& e) { return carries(e, 53, -1074, 1024); }

constexpr bool is_nearest(rounding d) { return d == rounding::nearest_even || d == rounding::nearest_away; }

namespace detail {

template <class T> struct shape_of;
template <> struct shape_of<float> {
  using bits = std::uint32_t;
  static constexpr encoding value = binary_encoding(8, 23);
};
template <> struct shape_of<double> {
  using bits = std::uint64_t;
  static constexpr encoding value = binary_encoding(11, 52);
};

/// x rounded to a narrower binary format, to nearest even: a few integer instructions, and one addition among
/// the subnormals.
template <encoding E, rules R, class T>
constexpr T round_narrower(T x) {
  using U = typename shape_of<T>::bits;
  constexpr encoding wide = shape_of<T>::value;
  constexpr int drop = wide.fraction_bits - E.fraction_bits;
  constexpr auto field = [=](int exponent) { return static_cast<U>(exponent + bias(wide)) << wide.fraction_bits; };
  constexpr U sign_mask = static_cast<U>(sign_bit(wide)), infinite = static_cast<U>(infinity_bits(wide));
  constexpr U least_normal = field(min_exponent(E)), mask = (U{1} << drop) - 1;
  // E's largest number, read as a pattern of T.
  constexpr U largest = (static_cast<U>(max_bits(E)) << drop) + (field(min_exponent(E)) - (U{1} << wide.fraction_bits));
  constexpr U beyond = R.overflow == overflow::saturate ? largest
                       : has_infinity(E)                ? infinite
                                                        : static_cast<U>(nan_bits(wide));
  const U bits = std::bit_cast<U>(x);
  const U sign = bits & sign_mask;
  U r = bits ^ sign;
  if (r >= least_normal) {
    if (r > infinite) return x;
    r = (r + (mask >> 1) + ((r >> drop) & 1)) & ~mask;
    if (r > largest) r = beyond;
  } else {
    // The sum's unit in the last place is E's smallest number: the addition rounds, the subtraction is exact.
    constexpr T magic = std::bit_cast<T>(field(min_ulp_exponent(E) + wide.fraction_bits));
    r = std::bit_cast<U>((std::bit_cast<T>(r) + magic) - magic);
    if constexpr (flushes_output(R.subnormal)) r = r < least_normal ? 0 : r;
  }
  return std::bit_cast<T>(sign | r);
}

/// Whether round_narrower can do it.
template <class T>
constexpr bool is_narrower(const encoding& e, const rules& r) {
  constexpr encoding wide = shape_of<T>::value;
  return e.kind == family::binary && e.has_sign && r.direction == rounding::nearest_even &&
         e.fraction_bits < wide.fraction_bits && min_ulp_exponent(e) + wide.fraction_bits <= bias(wide) &&
         bias(e) < bias(wide) && min_exponent(e) > min_exponent(wide);
}

template <class T>
struct scalar_carrier {
  using scalar = T;
  using mask = bool;
  static constexpr int lanes = 1;
  static constexpr encoding shape = shape_of<T>::value;

  static constexpr T broadcast(T x) { return x; }
  static constexpr T abs(T x) {
    using U = typename shape_of<T>::bits;
    return std::bit_cast<T>(static_cast<U>(std::bit_cast<U>(x) & ~static_cast<U>(sign_bit(shape))));
  }
  static constexpr T sqrt(T x) {
    if (std::is_constant_evaluated()) {
      const std::uint64_t bits = square_root(shape, encode(shape, static_cast<double>(x)));
      return static_cast<T>(decode(shape, bits));
    }
    return std::sqrt(x);
  }

  template <encoding E, rules R>
  static constexpr T round(T x) {
#if defined(__F16C__)
    if constexpr (std::is_same_v<T, float> && E == binary_encoding(5, 10) && R.direction == rounding::nearest_even &&
                  R.subnormal == subnormals::preserve && R.overflow != overflow::saturate) {
      // Compilers fold the integer way of a constant, but not the instruction.
      // In vector registers all the way: the scalar intrinsics pass the code through an integer one.
      if (!std::is_constant_evaluated() && !__builtin_constant_p(x)) {
        return _mm_cvtss_f32(_mm_cvtph_ps(_mm_cvtps_ph(_mm_set_ss(x), _MM_FROUND_TO_NEAREST_INT)));
      }
    }
#endif
    if constexpr (E == shape && R.direction == rounding::nearest_even && R.overflow != overflow::saturate &&
                  !flushes_output(R.subnormal)) {
      return x;
    } else if constexpr (is_narrower<T>(E, R)) {
      return round_narrower<E, R>(x);
    } else {
      return static_cast<T>(decode(E, encode(E, static_cast<double>(x), R)));
    }
  }

  /// a b + c: the product is exact in binary64, and an error-free sum, rounded to odd, keeps what the rounding
  /// to E has to know [BoldoMelquiond08].
  template <encoding E, rules R>
  static constexpr T fused(T a, T b, T c) {
    static_assert(carried_by_double(E));
    const double product = static_cast<double>(a) * static_cast<double>(b), term = static_cast<double>(c);
    double sum = product + term;
    const double back = sum - product;
    const double error = (product - (sum - back)) + (term - back);
    if (error > 0 || error < 0) {
      const auto bits = std::bit_cast<std::uint64_t>(sum);
      if ((bits & 1) == 0) sum = std::bit_cast<double>((error > 0) == (sum > 0) ? bits + 1 : bits - 1);
    }
    return static_cast<T>(scalar_carrier<double>::template round<E, R>(sum));
  }
};

}  // namespace detail

template <> struct carrier_traits<float> : detail::scalar_carrier<float> {};
template <> struct carrier_traits<double> : detail::scalar_carrier<double> {};

/// The cheapest scalar that holds a format and, where one does, carries its operations.
template <class Format>
using default_carrier =
    std::conditional_t<carried_by_float(Format::value) || Format::value == binary_encoding(8, 23), float, double>;

}  // namespace bitshade
