// Rounding a vector to the numbers of a binary format whose signs, subnormals and NaNs are kept, in the fewest
// operations that we know: what bulk::round runs unless a rule is unusual. No branch on values, no memory: the same time
// for every input. Each step says which of the processor's rounding directions it needs.
#pragma once

#include "bulk/binary_step.hpp"

namespace bitshade::bulk_kernels {

/// e k + b, where k is a power of two.
template <class V>
[[gnu::always_inline]] inline typename V::f scaled_sum(typename V::f e, typename V::f k, typename V::f b) {
  if constexpr (V::has_fma) return V::fma(e, k, b);
  else return V::add(V::mul(e, k), b);
}
/// b - e k.
template <class V>
[[gnu::always_inline]] inline typename V::f scaled_difference(typename V::f e, typename V::f k, typename V::f b) {
  if constexpr (V::has_fma) return V::fnma(e, k, b);
  else return V::sub(b, V::mul(e, k));
}

/// What the steps of one pair of lanes and direction share.
template <class V, rounding D>
struct value_numbers {
  using f = typename V::f;
  using i = typename V::i;
  using m = typename V::m;
  using word = typename V::word;
  static constexpr int fraction = V::fraction_bits;
  static constexpr int lane_bits = static_cast<int>(sizeof(word)) * 8;
  static constexpr int lane_bias = (1 << (V::exponent_bits - 1)) - 1;
  static constexpr word ones = ~word{0};
  static constexpr word unit_word = word{1} << fraction;
  static constexpr word infinity_word = ((word{1} << V::exponent_bits) - 1) << fraction;

  [[gnu::always_inline]] static i all(std::uint64_t w) { return V::all_bits(static_cast<word>(w)); }
  /// 2^e in every lane.
  [[gnu::always_inline]] static f power(int e) { return V::value(all(static_cast<word>(e + lane_bias) << fraction)); }
};

/// Fewer exponent bits than the lanes: subnormals are a matter of clamping. `Infinities`: else NaN stands for them.
/// `Few`: fewer random bits than the lane's fraction has.
///
/// To nearest even (processor: to nearest): with t = max(|x|, 3/2 of the smallest normal number) and s bits to lose,
/// c = fl(2^s t + |x|), then c - fl(c - |x|) [Dekker71, Veltkamp's splitting]. Where c stays in the binade of 2^s t its
/// unit is the format's; where it crosses into the next one, the inner difference still has that unit. Ties: the
/// low s bits of |x| are 10...0, hence 2^s t is an even multiple of the unit and the processor's own rule to even does
/// the same for the sum. Half as much again, since the difference must not fall below a power of two.
/// Others (processor: toward zero): E is the power of two in t. |x| + 2^s E, cut to its 24 bits, less 2^s E, is |x| cut
/// to the format's grid. To nearest away adds half a unit to |x| first, stochastic rounding a random part of a unit:
/// cutting twice is cutting once, since each grid holds the next.
template <class V, rounding D, bool Infinities, bool Few = false>
struct narrow_value : value_numbers<V, D> {
  using n = value_numbers<V, D>;
  using f = typename n::f;
  using i = typename n::i;
  using m = typename n::m;
  using word = typename n::word;

  const i one = n::all(1), quiet = n::all(n::infinity_word | n::unit_word >> 1);
  i magnitude, infinity, least, highest, kept, over_positive, over_negative, infinite, random_mask, random_unit, last_below;
  f up, up_and_unit, half, limit, largest;

  [[gnu::always_inline]] explicit narrow_value(const plan& p) {
    const lane_numbers& l = sizeof(word) == 4 ? p.single : p.wide;
    const int s = n::fraction - p.fraction_bits, low = 1 - p.bias;
    const word unit = word{1} << s;
    magnitude = n::all(l.magnitude);
    infinity = n::all(l.infinity);
    least = n::all(l.min_normal | (D == rounding::nearest_even ? n::unit_word >> 1 : 0));
    highest = V::bits(n::power(p.bias + 2));
    kept = n::all(~(unit - 1));
    over_positive = n::all(l.overflow[0]);
    over_negative = n::all(l.overflow[1]);
    infinite = n::all(l.infinite);
    largest = V::value(n::all(l.largest));
    up = n::power(s);
    // What is cut has a unit added for certain, which is taken away again with the power.
    up_and_unit = V::value(V::iadd(V::bits(up), one));
    half = n::power(-p.fraction_bits - 1);
    random_unit = V::bits(n::power(-p.fraction_bits));
    // The largest |x|, with what was added to it, that does not overflow.
    limit = V::value(n::all(l.limit));
    if constexpr (D == rounding::nearest_away) limit = V::value(n::all(l.largest + unit - 1));
    if constexpr (D == rounding::stochastic) {
      const i two_units = n::all((l.largest & n::infinity_word) - (word(p.fraction_bits - 1) << n::fraction));
      limit = V::value(V::isub(V::bits(V::add(largest, V::value(two_units))), one));
    }
    last_below = n::all((static_cast<word>(low - p.fraction_bits + 1 + n::lane_bias) << n::fraction) - 1);
    random_mask = n::all(Few ? ~(n::ones >> p.random_bits) : n::ones);
  }

  [[gnu::always_inline]] i operator()(i x) const {
    const i a = V::and_(x, magnitude), t = V::imax(a, least);
    if constexpr (D == rounding::nearest_even) {
      const f c = scaled_sum<V>(V::value(t), up, V::value(a));
      return overflowing(V::sub(c, V::sub(c, V::value(a))), V::value(a), x, a);
    } else if constexpr (D == rounding::nearest_away) {
      const f e = V::value(V::and_(t, infinity));
      const f b = scaled_sum<V>(e, half, V::value(a));
      return overflowing(scaled_difference<V>(e, up, scaled_sum<V>(e, up, b)), b, x, a);
    } else {
      const f e = V::value(V::imin(V::and_(t, infinity), highest));
      const f sum = scaled_sum<V>(e, up, V::value(a));
      f v = scaled_difference<V>(e, up, sum);
      if constexpr (D != rounding::toward_zero) {
        i step = one;
        if constexpr (D == rounding::up) step = V::without(V::spread_sign(x), one);
        if constexpr (D == rounding::down) step = V::and_(V::spread_sign(x), one);
        step = V::keep(V::gt(V::value(a), v), step);  // inexact; no NaN is
        const i next = D == rounding::to_odd ? V::or_(V::bits(sum), step) : V::iadd(V::bits(sum), step);
        v = scaled_difference<V>(e, up, V::value(next));
      }
      return directed(V::bits(v), x, a);
    }
  }

  /// Stochastic: the leading bits of `random` make the fraction of a number from 1 to 2, in units; `undecided` where
  /// more of them would matter. They can where |x| has bits below the last of them, which is below one unit, and the
  /// sum with one unit falls short of two units by less than that last bit.
  [[gnu::always_inline]] i operator()(i x, i random, bool& undecided) const {
    const i a = V::and_(x, magnitude);
    const f e = V::value(V::and_(V::imax(a, least), infinity));
    if constexpr (Few) random = V::and_(random, random_mask);
    const i drawn = V::or_(V::leading(random), random_unit);
    const f b = V::fma(V::value(drawn), e, V::value(a));
    if constexpr (!Few) undecided = V::any(V::ieq(V::bits(b), last_below));
    return overflowing(V::fnma(e, up_and_unit, V::fma(e, up, b)), b, x, a);
  }

 private:
  /// One magnitude for everything too large, which `sum` tells.
  [[gnu::always_inline]] i overflowing(f v, f sum, i x, i a) const {
    const m over = Infinities ? V::gt(sum, limit) : V::nle(sum, limit);
    return signed_as(V::select(over, over_positive, V::bits(v)), x, a);
  }
  [[gnu::always_inline]] i directed(i v, i x, i a) const {
    i over = over_positive;
    if constexpr (D == rounding::up || D == rounding::down) over = V::select_negative(x, over_negative, over_positive);
    v = V::select(V::gt(V::value(v), largest), over, v);
    v = V::select(V::ieq(a, infinity), infinite, v);
    if constexpr (!Infinities) v = V::select(V::igt(a, infinity), quiet, v);
    return signed_as(v, x, a);
  }
  /// Numbers have no bits there; a NaN's payload is cut.
  [[gnu::always_inline]] i signed_as(i v, i x, i a) const { return V::or_(V::and_(v, kept), V::xor_(x, a)); }
};

/// As many exponent bits as the lanes, or more: the unit is a fixed bit of the lane's, and overflow carries into the
/// exponent of infinity by itself. (Processor: to nearest for nearest_even, else toward zero.) `Wider`: numbers that
/// are subnormal in the lane are normal ones of the format.
template <class V, rounding D, bool Wider>
struct shared_exponent_value : value_numbers<V, D> {
  using n = value_numbers<V, D>;
  using f = typename n::f;
  using i = typename n::i;
  using m = typename n::m;
  using word = typename n::word;

  const i quiet = n::all(n::infinity_word | n::unit_word >> 1), smallest = n::all(n::unit_word);
  i magnitude, kept, low, half, shift, one, left, random_mask;
  f magic;

  [[gnu::always_inline]] explicit shared_exponent_value(const plan& p) {
    const int s = n::fraction - p.fraction_bits;
    const word below = (word{1} << s) - 1;
    kept = n::all(~below);
    low = n::all(below);
    half = n::all(D == rounding::nearest_even ? below >> 1 : below - (below >> 1));
    shift = n::all(static_cast<word>(s));
    one = n::all(s == 0 ? 0 : 1);
    left = n::all(static_cast<word>(n::lane_bits - s));
    random_mask = n::all(p.random_bits < s ? ~(n::ones >> p.random_bits) : n::ones);
    magic = V::add(n::power(s), n::power(s - 1));
    magnitude = n::all(sizeof(word) == 4 ? p.single.magnitude : p.wide.magnitude);
  }

  [[gnu::always_inline]] i operator()(i x) const { return round(x, x); }
  [[gnu::always_inline]] i operator()(i x, i random, bool&) const {
    return round(x, V::and_(random, random_mask));
  }

 private:
  [[gnu::always_inline]] i round(i x, i random) const {
    const m is_nan = V::nan(V::value(x));
    const i nan = V::and_(V::or_(x, quiet), kept);
    if constexpr (!Wider) {
      return V::select(is_nan, nan, V::and_(added(x, x, random), kept));
    } else if constexpr (D == rounding::nearest_even && V::has_exponents) {
      // Of a significand from 1 to 2 the format's last bit has one place.
      const f rounded = V::sub(V::add(V::significand(V::value(x)), magic), magic);
      return V::select(is_nan, nan, V::bits(V::scale(rounded, V::exponent(V::value(x)))));
    } else {
      // Integers become normal numbers and back: arithmetic on subnormal ones is slow.
      const i a = V::and_(x, magnitude);
      const m tiny = V::igt(smallest, a);
      const i u = V::select(tiny, V::bits(V::to_float(a)), a);
      i v = V::and_(added(u, x, random), kept);
      v = V::select(tiny, V::to_int(V::value(v)), v);
      return V::select(is_nan, nan, V::or_(v, V::xor_(x, a)));
    }
  }

  /// u with as much added to its low bits that cutting them rounds; the sign bit may be among u's.
  [[gnu::always_inline]] i added(i u, i x, i random) const {
    if constexpr (D == rounding::nearest_even) {
      return V::iadd(V::iadd(u, half), V::and_(V::shr(u, shift), one));
    } else if constexpr (D == rounding::nearest_away) {
      return V::iadd(u, half);
    } else if constexpr (D == rounding::up) {
      return V::iadd(u, V::without(V::spread_sign(x), low));
    } else if constexpr (D == rounding::down) {
      return V::iadd(u, V::and_(V::spread_sign(x), low));
    } else if constexpr (D == rounding::to_odd) {
      return V::or_(u, V::iadd(V::and_(u, low), low));
    } else if constexpr (D == rounding::stochastic) {
      return V::iadd(u, V::shr(random, left));
    }
    return u;
  }
};

}  // namespace bitshade::bulk_kernels
