// Rounding a vector to the numbers of a binary format with as many exponent bits as the lanes, or more, whose signs,
// subnormals and NaNs are kept and whose overflow is IEEE's. No branch, no memory: the same operations for every input.
#pragma once

#include "bulk/lane_shape.hpp"

namespace bitshade::bulk_kernels {

/// The unit is a fixed bit of the lane's, and overflow carries into the exponent of infinity by itself. `Wider`: numbers
/// that are subnormal in the lane are normal ones of the format.
template <class V, rounding D, bool Wider>
struct shared_exponent_value : lane_shape<V> {
  using n = lane_shape<V>;
  using f = typename n::f;
  using i = typename n::i;
  using m = typename n::m;
  using word = typename n::word;
  static constexpr setting wants = setting::nearest;  // a last carry overflows to infinity

  const i quiet = n::all(n::quiet_word);
  i kept, low, half, shift, one, left, random_mask, top_bit, scale, inverse;
  f magic, splitter, below_all, minus_zero;

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
    if constexpr (Wider) {
      top_bit = n::all(n::unit_word << (V::exponent_bits - 1));
      scale = V::bits(n::power(n::lane_bias / 2 + 1));
      inverse = n::all(static_cast<word>(2 * n::lane_bias) << n::fraction);
      minus_zero = V::value(n::all(n::ones ^ n::ones >> 1));
      splitter = V::add(n::power(s), n::power(0));
      below_all = V::sub(V::value(n::all(0)), n::power(n::lane_bias - 1));
    }
  }

  [[gnu::always_inline]] i operator()(i x) const { return round(x, x); }
  [[gnu::always_inline]] i operator()(i x, i random, m&) const { return round(x, V::and_(random, random_mask)); }

 private:
  [[gnu::always_inline]] i round(i x, i random) const {
    if constexpr (!Wider) {
      return V::select(V::nan(V::value(x)), V::and_(V::or_(x, quiet), kept), V::and_(added(x, x, random), kept));
    } else if constexpr (D == rounding::nearest_even && V::has_exponents) {
      // Of a significand from 1 to 2 the format's last bit has one place.
      const f rounded = V::sub(V::add(V::significand(V::value(x)), magic), magic);
      const i v = V::bits(V::scale(rounded, V::exponent(V::value(x))));
      return V::select(V::nan(V::value(x)), V::and_(V::or_(x, quiet), kept), v);
    } else {
      // x times 2^64 below 2 in magnitude, else times 2^-64, is neither subnormal nor too large to be split.
      const i k = V::xor_(V::and_(x, top_bit), scale);
      const f y = product(V::value(x), V::value(k));
      i v = V::bits(y);
      if constexpr (D == rounding::nearest_even) v = split(y);
      else v = V::select(V::nan(y), v, added(v, v, random));
      return V::bits(product(V::value(V::and_(v, kept)), V::value(V::isub(inverse, k))));
    }
  }

  /// To nearest even by Veltkamp's splitting [Dekker71], c = fl((2^s + 1) y), c - fl(c - y). c - y is NaN for infinities
  /// and NaNs alone; any finite number in its place gives the former back, and the latter are in c already.
  [[gnu::always_inline]] i split(f y) const {
    const f c = V::mul(y, splitter);
    return V::bits(V::sub(c, V::max(V::sub(c, y), below_all)));
  }
  /// Plain multiplication stalls where subnormal numbers are among normal ones (AMD family 26); the fused one does not.
  [[gnu::always_inline]] f product(f a, f b) const {
    if constexpr (V::has_fma) return V::fma(a, b, minus_zero);
    else return V::mul(a, b);
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
