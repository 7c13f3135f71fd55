// Rounding a vector to a binary format under any rules, to codes or numbers, by integers and by adding a power of two.
// No branch, no memory: the same time for every input, subnormals included. narrow_value.hpp and
// shared_exponent_value.hpp are faster where they serve.
#pragma once

#include "bulk/lane_shape.hpp"

namespace bitshade::bulk_kernels {

/// One vector, rounded in direction D. The processor's own direction must be to nearest for nearest_even and
/// toward zero for every other D.
///
/// narrow: let e be the exponent of |x|, but at least the format's smallest. Adding 2^(e + F - M) pushes everything
/// below the format's unit 2^(e - M) out of the carrier's F fraction bits, which rounds; what is left in the low bits
/// is the significand, hidden bit included, so that codes come out with one addition.
/// equal, wider: the unit is a fixed bit of the carrier's bits, so integer additions round. For `wider`, numbers
/// that are subnormal in the carrier are converted from integers to normal ones first.
template <class V, reach Reach, rounding D>
struct binary_step : lane_shape<V> {
  using shape = lane_shape<V>;
  using f = typename shape::f;
  using i = typename shape::i;
  using m = typename shape::m;
  using word = typename shape::word;
  using shape::all, shape::fraction, shape::infinity_word, shape::lane_bias, shape::lane_bits, shape::ones, shape::quiet_word,
      shape::unit_word;

  const i sign = V::all_bits(word{1} << (lane_bits - 1));
  const i magnitude = V::all_bits(ones >> 1);
  const i infinity = V::all_bits(infinity_word);
  const i quiet = V::all_bits(quiet_word);
  i lowest, highest, up, half, one, odd, shift, kept, low, left;
  i overflow_positive, overflow_negative, infinite, largest, smallest, nan, nan_payload, nan_shift, nan_sign;
  i sign_shift, sign_code, rebias, tiny_rebias, random_mask;
  bool has_sign, more_random;

  [[gnu::always_inline]] binary_step(const plan& p, bool to_codes) {
    const lane_numbers& n = sizeof(word) == 4 ? p.single : p.wide;
    const int s = fraction - p.fraction_bits;
    const word below = s == 0 ? 0 : (word{1} << s) - 1;
    lowest = all(static_cast<word>(lane_bias + 1 - p.bias) << fraction);
    highest = all(static_cast<word>(lane_bias + 1 + p.bias + 1) << fraction);
    up = all(static_cast<word>(s) << fraction);
    shift = all(static_cast<word>(s));
    left = all(static_cast<word>(lane_bits - s));
    low = all(below);
    kept = all(~below);
    if constexpr (Reach == reach::narrow) {
      one = all(1);
      half = all(static_cast<word>(fraction + 1) << fraction);
    } else {
      one = all(word{1} << s);
      half = all(D == rounding::nearest_even ? below >> 1 : below - (below >> 1));
    }
    odd = all(s == 0 ? 0 : 1);
    overflow_positive = all(to_codes ? p.overflow_code[0] : n.overflow[0]);
    overflow_negative = all(to_codes ? p.overflow_code[1] : n.overflow[1]);
    infinite = all(to_codes ? p.infinite_code : n.infinite);
    largest = all(to_codes ? p.max_code : n.largest);
    smallest = all(to_codes ? (p.flush_codes ? p.min_normal_code : 0) : (p.flush_values ? n.min_normal : 0));
    const bool payload = !p.canonical_nan && p.special != specials::single_nan;
    nan = all(to_codes ? p.nan_code : quiet_word);
    nan_payload = all(!payload ? 0 : (to_codes ? ones : ~below) & (unit_word - 1));
    nan_shift = all(to_codes ? static_cast<word>(s) : 0);
    nan_sign = all(p.canonical_nan ? 0 : ones);
    sign_shift = all(static_cast<word>(lane_bits - p.width));
    sign_code = all(p.sign);
    rebias = all(static_cast<word>(p.bias - lane_bias) << p.fraction_bits);
    tiny_rebias = all(static_cast<word>(lane_bias - 1 + fraction) << p.fraction_bits);
    random_mask = all(p.random_bits >= lane_bits ? ones : static_cast<word>(~(ones >> p.random_bits)));
    has_sign = p.has_sign;
    more_random = p.random_bits > lane_bits;
  }

  struct rounded {
    i sum;       ///< narrow: |x| plus the power, as bits; else the carrier's bits, the unit's bit the last that counts
    i power;     ///< narrow: the power of two
    m tiny;      ///< wider: where the carrier is subnormal
    i exponent;  ///< narrow: the clamped exponent, in place
    m undecided{};  ///< stochastic: the bits at hand are not enough; the scalar definition decides
  };

  [[gnu::always_inline]] rounded round(i x, i random) const {
    rounded r;
    const i a = V::and_(x, magnitude);
    if constexpr (Reach == reach::narrow) {
      r.exponent = V::imax(V::and_(x, infinity), lowest);
      r.exponent = V::imin(r.exponent, highest);
      r.power = V::iadd(r.exponent, up);
      const f power = V::value(r.power);
      f b = V::value(a);
      if constexpr (D == rounding::nearest_away) b = V::add(b, V::value(V::isub(r.power, half)));
      const f sum = V::add(b, power);
      r.sum = V::bits(sum);
      if constexpr (D == rounding::up || D == rounding::down || D == rounding::to_odd) {
        r.sum = nudge(r.sum, V::ne(V::sub(sum, power), V::value(a)), x);
      }
      if constexpr (D == rounding::stochastic) {
        // The discarded part of the significand, left-aligned in a word.
        const i unit = V::all_bits(unit_word), fraction_mask = V::all_bits(unit_word - 1);
        const i significand = V::or_(V::and_(a, fraction_mask), V::keep(V::igt(a, fraction_mask), unit));
        const i below = V::shr(V::isub(r.exponent, V::imax(V::and_(x, infinity), unit)), V::all_bits(fraction));
        carry(r, V::or_(V::shl(significand, V::isub(left, below)), V::shr(significand, V::isub(below, left))),
              random);
      }
    } else {
      i u = a;
      if constexpr (Reach == reach::wider) {
        r.tiny = V::igt(V::all_bits(unit_word), a);
        u = V::select(r.tiny, V::bits(V::to_float(a)), a);
      }
      r.sum = u;
      if constexpr (D == rounding::nearest_even) {
        r.sum = V::iadd(V::iadd(u, half), V::and_(V::shr(u, shift), odd));
      } else if constexpr (D == rounding::nearest_away) {
        r.sum = V::iadd(u, half);
      } else if constexpr (D == rounding::stochastic) {
        carry(r, V::shl(u, left), random);
      } else if constexpr (D != rounding::toward_zero) {
        r.sum = nudge(u, V::inot(V::ieq(V::and_(u, low), V::all_bits(0))), x);
      }
    }
    return r;
  }

  /// The bits of the rounded number in the carrier.
  [[gnu::always_inline]] i to_value(const rounded& r, i x) const {
    const i a = V::and_(x, magnitude);
    i v;
    if constexpr (Reach == reach::narrow) {
      v = V::bits(V::sub(V::value(r.sum), V::value(r.power)));
    } else {
      v = V::and_(r.sum, kept);
      if constexpr (Reach == reach::wider) v = V::select(r.tiny, V::to_int(V::value(v)), v);
    }
    return finish(v, a, x, V::and_(x, sign));
  }

  /// The code.
  [[gnu::always_inline]] i to_code(const rounded& r, i x) const {
    i c;
    const i a = V::and_(x, magnitude);
    if constexpr (Reach == reach::narrow) {
      c = V::iadd(V::isub(r.sum, r.power), V::shr(V::isub(r.exponent, lowest), shift));
    } else {
      c = V::iadd(V::shr(r.sum, shift), rebias);
      if constexpr (Reach == reach::wider) {
        // A subnormal carrier, read as an integer, was 2^(lane_bias - 1 + fraction) times as large.
        c = V::select(r.tiny, V::isub(c, tiny_rebias), c);
        c = V::keep(V::inot(V::ieq(a, V::all_bits(0))), c);
      }
    }
    return finish(c, a, x, V::and_(V::shr(x, sign_shift), sign_code));
  }

 private:
  /// One unit more in magnitude, where the direction asks for it.
  [[gnu::always_inline]] i nudge(i sum, m inexact, i x) const {
    const i step = V::keep(inexact, one);
    if constexpr (D == rounding::to_odd) return V::or_(sum, step);
    i away = V::spread_sign(x);
    if constexpr (D == rounding::up) away = V::xor_(away, V::all_bits(ones));
    return V::iadd(sum, V::and_(step, away));
  }

  /// One unit more where random bits and discarded bits add up to a unit: quotient.hpp, rounds_up.
  [[gnu::always_inline]] void carry(rounded& r, i part, i random) const {
    const i drawn = V::and_(random, random_mask);
    const i missing = V::xor_(V::and_(part, random_mask), V::all_bits(ones));
    r.sum = V::iadd(r.sum, V::keep(V::ugt(drawn, missing), one));
    // All bits at hand add up to ones: the ones that were cut off decide. Once in 2^32, or for n < 32 never.
    if (more_random) r.undecided = V::ieq(drawn, missing);
  }

  [[gnu::always_inline]] i finish(i v, i a, i x, i s) const {
    i over = overflow_positive;
    if constexpr (D == rounding::up || D == rounding::down) {
      over = V::merge(V::spread_sign(x), overflow_negative, overflow_positive);
    }
    v = V::select(V::igt(v, largest), over, v);
    v = V::keep(V::inot(V::igt(smallest, v)), v);
    v = V::select(V::ieq(a, infinity), infinite, v);
    const m is_nan = V::igt(a, infinity);
    const i nan_value = V::or_(V::shr(V::and_(a, nan_payload), nan_shift), nan);
    if (!has_sign) {  // negative numbers become zero, NaNs positive
      v = V::and_(v, V::xor_(V::spread_sign(x), V::all_bits(ones)));
      return V::select(is_nan, nan_value, v);
    }
    return V::select(is_nan, V::or_(nan_value, V::and_(s, nan_sign)), V::or_(v, s));
  }
};

}  // namespace bitshade::bulk_kernels
