// std::numeric_limits and std::hash of real, derived from the encoding.
#pragma once

#include <functional>
#include <limits>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/decimal_limits.hpp"

template <class Format, bitshade::rules R, class Carrier>
struct std::numeric_limits<bitshade::real<Format, R, Carrier>> {
 private:
  using T = bitshade::real<Format, R, Carrier>;
  static constexpr bitshade::encoding E = Format::value;
  static constexpr bool floats = E.kind == bitshade::family::binary;
  static constexpr T code(std::uint64_t bits) { return T::from_bits(static_cast<typename T::bits_type>(bits)); }

 public:
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = E.has_sign;
  static constexpr bool is_integer = false;
  static constexpr bool is_exact = false;
  static constexpr bool has_infinity = bitshade::has_infinity(E);
  static constexpr bool has_quiet_NaN = floats;
  static constexpr bool has_signaling_NaN = false;
  static constexpr std::float_denorm_style has_denorm =
      floats && !flushes_output(R.subnormal) ? std::denorm_present : std::denorm_absent;
  static constexpr bool has_denorm_loss = false;
  static constexpr std::float_round_style round_style =
      R.direction == bitshade::rounding::nearest_even || R.direction == bitshade::rounding::nearest_away
          ? std::round_to_nearest
      : R.direction == bitshade::rounding::toward_zero ? std::round_toward_zero
      : R.direction == bitshade::rounding::up          ? std::round_toward_infinity
      : R.direction == bitshade::rounding::down        ? std::round_toward_neg_infinity
                                                       : std::round_indeterminate;
  static constexpr bool is_iec559 = floats && E.has_sign && E.special == bitshade::specials::ieee &&
                                    R.subnormal == bitshade::subnormals::preserve &&
                                    R.overflow == bitshade::overflow::ieee;
  static constexpr bool is_bounded = true;
  static constexpr bool is_modulo = false;
  static constexpr int radix = 2;
  /// Bits of the significand; of norms and fixed point, of the largest code.
  static constexpr int digits = floats ? precision(E) : E.width - (E.has_sign ? 1 : 0);
  static constexpr int digits10 = bitshade::decimal_digits(digits);
  static constexpr int max_digits10 = bitshade::distinguishing_digits(digits);
  static constexpr int min_exponent = floats ? bitshade::min_exponent(E) + 1 : 0;
  static constexpr int max_exponent = floats ? bitshade::bias(E) + (E.special == bitshade::specials::ieee ? 1 : 2) : 0;
  static constexpr int min_exponent10 = floats ? bitshade::min_exponent10(E) : 0;
  static constexpr int max_exponent10 = floats ? bitshade::max_exponent10(E) : 0;
  static constexpr bool traps = false;
  static constexpr bool tinyness_before = false;

  static constexpr T min() noexcept { return code(bitshade::min_normal_bits(E)); }
  static constexpr T max() noexcept { return code(bitshade::max_bits(E)); }
  static constexpr T lowest() noexcept {
    if (!E.has_sign) return code(0);
    return floats ? -max() : code(bitshade::sign_bit(E));
  }
  /// The step above 1; of norms and fixed point the step.
  static constexpr T epsilon() noexcept {
    return floats ? code(bitshade::encode(E, bitshade::decode(E, bitshade::encode(E, 1.0) + 1) - 1)) : code(1);
  }
  static constexpr T round_error() noexcept { return T(round_style == std::round_to_nearest ? 0.5 : 1.0); }
  static constexpr T infinity() noexcept { return has_infinity ? code(bitshade::infinity_bits(E)) : max(); }
  static constexpr T quiet_NaN() noexcept { return code(bitshade::nan_bits(E)); }
  static constexpr T signaling_NaN() noexcept { return quiet_NaN(); }
  static constexpr T denorm_min() noexcept { return has_denorm == std::denorm_present ? code(1) : min(); }
};

template <class Format, bitshade::rules R, class Carrier>
struct std::hash<bitshade::real<Format, R, Carrier>> {
  std::size_t operator()(const bitshade::real<Format, R, Carrier>& x) const noexcept {
    // Equal numbers hash alike: both zeros are 0.
    return std::hash<double>()(static_cast<double>(x) + 0.0);
  }
};
