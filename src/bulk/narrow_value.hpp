// Rounding a vector to the numbers of a binary format with fewer exponent bits than the lanes have, whose signs,
// subnormals and NaNs are kept, in the fewest operations that we know: what bulk::round runs unless a rule is unusual.
// No branch on values, no memory: the same time for every input.
#pragma once

#include "bulk/lane_shape.hpp"

namespace bitshade::bulk_kernels {

/// One vector in direction D; `wants` is the processor's direction. `Few`: fewer random bits than the lane's fraction has.
///
/// E is the power of two in |x|, but at least the smallest normal number's, and s the bits that the format's fraction
/// lacks. The unit of the binade from 2^s E on is the format's, so that a sum there is rounded to the format's grid,
/// subnormals included, and the sum less what was added is the result.
///
///   to nearest even, up, down   c = fl(3/2 2^s E + x), in the processor's own direction: half as much again keeps the
///                               sums with negative x in the binade.
///   others                      c = fl(2^s E + |x|), cut. To nearest away adds half a unit to |x| first, stochastic
///                               rounding a random part of a unit: cutting twice is cutting once, since each grid holds
///                               the next. To odd sets the last bit of an inexact c.
///
/// Two products with powers of two, there and back, make what is beyond the format's largest exponent the lane's own
/// overflow. To nearest even the second one also gives zeros their sign: -(c's rest) + (x's zero).
/// Without infinities, to nearest even goes by Veltkamp's splitting [Dekker71] of |x|: t = max(|x|, 3/2 of the smallest
/// normal number), c = fl(2^s t + |x|), then c - fl(c - |x|). Where c crosses into the next binade, the inner difference
/// still has the format's unit; ties are even multiples of it in both.
template <class V, rounding D, ends Ends, bool Few = false>
struct narrow_value : lane_shape<V> {
  using n = lane_shape<V>;
  using f = typename n::f;
  using i = typename n::i;
  using m = typename n::m;
  using word = typename n::word;
  static constexpr bool directed = D == rounding::up || D == rounding::down;
  static constexpr bool to_even = D == rounding::nearest_even;
  static constexpr bool signed_sum = directed || (to_even && Ends == ends::natural);
  static constexpr setting wants = to_even                 ? setting::nearest
                                   : D == rounding::up     ? setting::up
                                   : D == rounding::down   ? setting::down
                                                           : setting::toward_zero;

  const i one = n::all(1), quiet = n::all(n::quiet_word);
  i magnitude, sign, infinity, least, highest, kept, payload, over_positive, over_negative, infinite, last_finite;
  i random_mask, random_unit, last_below;
  f up, up_and_unit, half, limit, largest, stretch, shrink;

  [[gnu::always_inline]] explicit narrow_value(const plan& p) {
    const lane_numbers& l = sizeof(word) == 4 ? p.single : p.wide;
    const int s = n::fraction - p.fraction_bits, low = 1 - p.bias;
    const word unit = word{1} << s;
    magnitude = n::all(l.magnitude);
    sign = n::all(~l.magnitude);
    infinity = n::all(l.infinity);
    last_finite = n::all(l.infinity - 1);
    least = n::all(l.min_normal | (to_even && !signed_sum ? n::unit_word >> 1 : 0));
    highest = V::bits(n::power(p.bias + 1));
    // To nearest even zeros have their sign before NaNs' payloads are cut.
    kept = n::all(~(unit - 1) & (directed ? l.magnitude : n::ones));
    payload = n::all(p.special == specials::ieee ? ~(unit - 1) : 0);
    over_positive = n::all(l.overflow[0]);
    over_negative = n::all(l.overflow[1]);
    infinite = n::all(l.infinite);
    largest = V::value(n::all(l.largest));
    up = V::value(V::or_(V::bits(n::power(s)), n::all(signed_sum ? n::unit_word >> 1 : 0)));
    stretch = n::power(n::lane_bias - p.bias);
    shrink = n::power(p.bias - n::lane_bias);
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
    if constexpr (signed_sum) {
      return with_sign(x);
    } else {
      const i a = V::and_(x, magnitude);
      if constexpr (to_even) {
        const f c = scaled_sum<V>(V::value(V::imax(a, least)), up, V::value(a));
        return overflowing(V::sub(c, V::sub(c, V::value(a))), V::value(a), x, a);
      } else if constexpr (D == rounding::nearest_away) {
        const f e = V::value(V::and_(V::imax(a, least), infinity));
        const f b = scaled_sum<V>(e, half, V::value(a));
        return overflowing(scaled_difference<V>(e, up, scaled_sum<V>(e, up, b)), b, x, a);
      } else {
        return cut(x, a);
      }
    }
  }

  /// Stochastic: the leading bits of `random` make the fraction of a number from 1 to 2, in units; `undecided` where
  /// more of them would matter. They can where |x| has bits below the last of them, which is below one unit, and the
  /// sum with one unit falls short of two units by less than that last bit.
  [[gnu::always_inline]] i operator()(i x, i random, m& undecided) const {
    const i a = V::and_(x, magnitude);
    const f e = V::value(V::and_(V::imax(a, least), infinity));
    if constexpr (Few) random = V::and_(random, random_mask);
    const i drawn = V::or_(V::leading(random), random_unit);
    const f b = V::fma(V::value(drawn), e, V::value(a));
    if constexpr (!Few) undecided = V::ieq(V::bits(b), last_below);
    return overflowing(V::fnma(e, up_and_unit, V::fma(e, up, b)), b, x, a);
  }

 private:
  [[gnu::always_inline]] f power_in(i x) const {
    return V::value(V::imin(V::imax(V::and_(x, infinity), least), highest));
  }

  /// To nearest even, up and down.
  [[gnu::always_inline]] i with_sign(i x) const {
    const f e = power_in(x), c = scaled_sum<V>(e, up, V::value(x));
    const i s = V::and_(x, sign);
    if constexpr (to_even) {
      const f v = V::mul(reduced_product<V>(e, up, c), stretch);
      return V::and_(V::bits(scaled_difference<V>(v, shrink, V::value(s))), kept);
    } else {
      f v = scaled_difference<V>(e, up, c);
      if constexpr (Ends == ends::natural) {
        return V::or_(V::and_(V::bits(V::mul(V::mul(v, stretch), shrink)), kept), s);
      } else {
        const i over = V::select_negative(x, over_negative, over_positive), w = V::and_(V::bits(v), magnitude);
        return V::or_(special(V::select(V::gt(V::value(w), largest), over, w), V::and_(x, magnitude)), s);
      }
    }
  }

  /// Toward zero and to odd.
  [[gnu::always_inline]] i cut(i x, i a) const {
    const f e = power_in(x), c = scaled_sum<V>(e, up, V::value(a));
    f v = scaled_difference<V>(e, up, c);
    if constexpr (D == rounding::to_odd) {
      const i inexact = V::keep(V::gt(V::value(a), v), one);  // no NaN is
      v = scaled_difference<V>(e, up, V::value(V::or_(V::bits(c), inexact)));
    }
    i w;
    if constexpr (Ends == ends::natural) w = V::and_(V::bits(V::mul(V::mul(v, stretch), shrink)), kept);
    else if constexpr (Ends == ends::nan) w = special(V::bits(V::min(v, largest)), a);
    else w = special(V::select(V::gt(v, largest), over_positive, V::bits(v)), a);
    return V::or_(w, V::xor_(x, a));
  }

  /// v, or what infinities and NaNs become.
  [[gnu::always_inline]] i special(i v, i a) const {
    if constexpr (Ends == ends::nan) return V::select(V::igt(a, last_finite), quiet, v);
    v = V::select(V::ieq(a, infinity), infinite, v);
    return V::select(V::igt(a, infinity), V::or_(V::and_(a, payload), quiet), v);
  }

  /// One magnitude for everything too large, which `sum` tells. Where it is NaN's, NaNs get it too; elsewhere their
  /// payload is cut: numbers have no bits there.
  [[gnu::always_inline]] i overflowing(f v, f sum, i x, i a) const {
    const m over = Ends == ends::nan ? V::nle(sum, limit) : V::gt(sum, limit);
    i w = V::select(over, over_positive, V::bits(v));
    if constexpr (Ends != ends::nan) w = V::and_(w, kept);
    return V::or_(w, V::xor_(x, a));
  }
};

}  // namespace bitshade::bulk_kernels
