// Rounding a vector to the numbers of norms and fixed point in any direction, binary32 lanes.
#pragma once

#include "bulk/norm_step.hpp"

namespace bitshade::bulk_kernels {

/// What norms' steps share: NaN gives 0, everything else the nearest bound that it passes.
template <class V, bool Signed>
struct norm_range {
  using f = typename V::f;
  using i = typename V::i;
  const i sign = V::all_bits(0x80000000u), magnitude = V::all_bits(0x7fffffffu);
  const f zero = V::all(0);
  const i low, high;

  [[gnu::always_inline]] explicit norm_range(const plan& p)
      : low(V::bits(V::all(static_cast<float>(p.low)))), high(V::bits(V::all(static_cast<float>(p.high)))) {}

  /// Bits of negative numbers, read as unsigned ones, grow with the magnitude.
  [[gnu::always_inline]] f clamp(f x) const {
    if (!Signed) return V::value(V::imin(V::bits(V::max(x, zero)), high));
    const i number = V::keep(V::eq(x, x), V::bits(x));
    return V::value(V::umin(V::imin(number, high), low));
  }
  [[gnu::always_inline]] f size(f y) const { return Signed ? V::value(V::and_(V::bits(y), magnitude)) : y; }
  /// c with y's sign; zero has none.
  [[gnu::always_inline]] f with_sign(f c, f y) const {
    if (!Signed) return c;
    return V::add(V::value(V::or_(V::bits(c), V::and_(V::bits(y), sign))), zero);
  }
};

/// c, the integer nearest to |x| scale, and the sign of the exact error c - |x| scale, which one fma finds, give every
/// direction but the stochastic one; the processor must round to nearest. Where zero is the middle of the scale, up and
/// down work on x with its sign, the others on |x|.
template <class V, rounding D, bool Signed>
struct norm_value : norm_range<V, Signed> {
  using range = norm_range<V, Signed>;
  using f = typename V::f;
  using i = typename V::i;
  static constexpr bool keeps_sign = D == rounding::up || D == rounding::down || D == rounding::nearest_even;
  using range::zero;

  norm_step<V, D> step;
  const i one = V::all_bits(1);
  const f half = V::all(0.5f);
  const f magic = V::all(keeps_sign && Signed ? 0x1.8p23f : 0x1p23f);

  [[gnu::always_inline]] explicit norm_value(const plan& p) : range(p), step(p) {}

  [[gnu::always_inline]] f operator()(f x) const {
    const f y = range::clamp(x);
    if constexpr (keeps_sign || !Signed) return step.to_value(V::sub(V::value(code(y)), magic));
    const f c = V::sub(V::value(code(range::size(y))), magic);
    return step.to_value(range::with_sign(c, y));
  }

 private:
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

/// Stochastic; the processor must round to nearest. n is the integer nearest to |x| scale, d the rest, from -1/2 to 1/2, and
/// R, from 0 to 1, the first 23 random bits: the code is n + floor(d + R), which is the integer nearest to n + h with
/// h = d + R - 1/2. Rounding moves h by at most 2^-24; only next to a tie, |h| = 1/2, can that matter, or can the random bits
/// to come, whose part is below 2^-23. There h h + 4 is rounded to 4 + 1/4, as `undecided` tells; elsewhere it is once in 2^21.
template <class V, bool Signed>
struct drawn_norm_value : norm_range<V, Signed> {
  using range = norm_range<V, Signed>;
  using f = typename V::f;
  using i = typename V::i;

  norm_step<V, rounding::nearest_even> step;
  const i one = V::bits(V::all(1));
  const f magic = V::all(Signed ? 0x1.8p23f : 0x1p23f + 1), half_less = V::all(0x1p23f - 0.5f), three_halves = V::all(1.5f);
  const f four = V::all(4), tie = V::all(4.25f);

  [[gnu::always_inline]] explicit drawn_norm_value(const plan& p) : range(p), step(p) {}

  [[gnu::always_inline]] f operator()(f x, i random, typename V::m& undecided) const {
    const f y = range::clamp(x), drawn = V::value(V::or_(V::leading(random), one)), sum = V::fma(y, step.scale, magic);
    f h;
    if constexpr (Signed) {
      const i away = V::xor_(V::bits(V::sub(drawn, three_halves)), V::and_(V::bits(y), range::sign));
      h = V::add(V::fms(y, step.scale, V::sub(sum, magic)), V::value(away));
    } else {
      h = V::add(V::fms(y, step.scale, V::sub(sum, half_less)), drawn);
    }
    undecided = V::eq(V::fma(h, h, four), tie);
    return step.to_value(V::sub(V::add(sum, h), magic));
  }
};

/// Stochastic with at most 23 random bits; the processor must round toward zero. With those bits as a number R from 1 to 2,
/// |x| scale + R, cut to 24 bits and then to an integer, is one more than the code: cutting twice is cutting once.
template <class V, bool Signed>
struct drawn_norm : norm_range<V, Signed> {
  using range = norm_range<V, Signed>;
  using f = typename V::f;
  using i = typename V::i;

  const f unit = V::all(0x1p23f), unit_and_one = V::all(0x1p23f + 1), scale;
  const i one = V::bits(V::all(1)), random_mask;

  [[gnu::always_inline]] explicit drawn_norm(const plan& p)
      : range(p), scale(V::all(static_cast<float>(p.scale))), random_mask(V::all_bits(~(0xffffffffu >> p.random_bits))) {}

  [[gnu::always_inline]] f operator()(f x, i random) const {
    const f y = range::clamp(x), a = range::size(y);
    const f drawn = V::value(V::or_(V::leading(V::and_(random, random_mask)), one));
    return range::with_sign(V::sub(V::add(V::fma(a, scale, drawn), unit), unit_and_one), y);
  }
};

}  // namespace bitshade::bulk_kernels
