// Rounding a vector to the numbers of norms and fixed point in any direction, binary32 lanes. The processor must round
// to nearest.
#pragma once

#include "bulk/norm_step.hpp"

namespace bitshade::bulk_kernels {

/// c, the integer nearest to |x| scale, and the sign of the exact error c - |x| scale, which one fma finds, give every
/// direction. Where zero is the middle of the scale, up and down work on x with its sign, the others on |x|.
template <class V, rounding D, bool Signed>
struct norm_value {
  using f = typename V::f;
  using i = typename V::i;
  static constexpr bool keeps_sign = D == rounding::up || D == rounding::down || D == rounding::nearest_even;

  norm_step<V, D> step;
  const i one = V::all_bits(1), sign = V::all_bits(0x80000000u), magnitude = V::all_bits(0x7fffffffu);
  const f zero = V::all(0), half = V::all(0.5f), unit = V::all(0x1p23f);
  i low, high, random_mask;
  f magic, random_scale, random_magic, random_limit, random_step;

  [[gnu::always_inline]] explicit norm_value(const plan& p) : step(p) {
    low = V::bits(step.low);
    high = V::bits(step.high);
    magic = keeps_sign && Signed ? V::all(0x1.8p23f) : unit;
    random_scale = V::mul(step.scale, V::all(0x1p25f));
    random_magic = V::all(0x1.8p48f);  // the unit of its binade is 2^25
    random_step = V::all(0x1p-25f);
    random_limit = V::all(0x1p24f - 16);
    random_mask = V::all_bits(p.random_bits >= 24 ? 0xffffff00u : ~(0xffffffffu >> p.random_bits));
  }

  [[gnu::always_inline]] f operator()(f x) const {
    const f y = clamp(x);
    if constexpr (keeps_sign || !Signed) return step.to_value(V::sub(V::value(code(y)), magic));
    const f c = V::sub(V::value(code(V::value(V::and_(V::bits(y), magnitude)))), magic);
    return step.to_value(with_sign(c, y));
  }

  /// Stochastic: |x| scale plus 24 random bits less a half, all times 2^25, to the nearest multiple of 2^25; `undecided`
  /// where that is nearer to a tie than what the roundings and the bits beyond the 24th may change.
  [[gnu::always_inline]] f operator()(f x, i random, bool& undecided) const {
    const f y = clamp(x);
    const f a = Signed ? V::value(V::and_(V::bits(y), magnitude)) : y;
    // Twice the bits, with their leading one flipped as a sign, and one for the half behind the last.
    const i odd = V::or_(V::template word_shift_signed<7>(V::xor_(V::and_(random, random_mask), sign)), one);
    const f part = V::to_float(odd);
    const f first = V::sub(V::add(V::fma(a, random_scale, part), random_magic), random_magic);
    const f over = V::add(V::sub(zero, V::fnma(a, random_scale, first)), part);
    // The sum's own rounding may have passed a tie: what is left of it tells.
    const f again = V::sub(V::add(over, random_magic), random_magic);
    const f c = V::add(first, again), rest = V::sub(over, again);
    undecided = V::any(V::gt(V::value(V::and_(V::bits(rest), magnitude)), random_limit));
    const f whole = V::mul(c, random_step);
    return step.to_value(Signed ? with_sign(whole, y) : whole);
  }

 private:
  /// NaN gives 0, everything else the nearest bound that it passes. Bits of negative numbers, read as unsigned ones, grow
  /// with the magnitude.
  [[gnu::always_inline]] f clamp(f x) const {
    if (!Signed) return V::value(V::imin(V::bits(V::max(x, zero)), high));
    const i number = V::keep(V::eq(x, x), V::bits(x));
    return V::value(V::umin(V::imin(number, high), low));
  }
  /// c with y's sign; zero has none.
  [[gnu::always_inline]] f with_sign(f c, f y) const {
    return V::add(V::value(V::or_(V::bits(c), V::and_(V::bits(y), sign))), zero);
  }

  /// Bits of `magic` plus the code.
  [[gnu::always_inline]] i code(f a) const {
    const f sum = V::fma(a, step.scale, magic);
    i c = V::bits(sum);
    if constexpr (D == rounding::nearest_even) return c;
    const f nearest = V::sub(sum, magic);
    if constexpr (D == rounding::nearest_away) {
      const f missing = V::fnma(a, step.scale, V::add(nearest, half));
      return V::iadd(c, V::keep(V::le(missing, zero), one));  // a tie that went to the even one below
    }
    const f error = V::fnma(a, step.scale, nearest);
    if constexpr (D == rounding::up) return V::iadd(c, V::keep(V::gt(zero, error), one));
    c = V::isub(c, V::keep(V::gt(error, zero), one));
    if constexpr (D == rounding::to_odd) c = V::or_(c, V::keep(V::ne(error, zero), one));
    return c;
  }
};

}  // namespace bitshade::bulk_kernels
