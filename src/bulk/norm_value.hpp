// Rounding a vector to the numbers of norms and fixed point in any direction, binary32 lanes.
#pragma once

#include "bulk/norm_step.hpp"

namespace bitshade::bulk_kernels {

/// NaN gives 0, everything else the nearest bound that it passes. Bits of negative numbers, read as unsigned ones, grow with
/// the magnitude.
template <class V, bool Signed>
struct norm_range {
  using f = typename V::f;
  using i = typename V::i;
  const f zero = V::all(0);
  const i low, high;

  [[gnu::always_inline]] explicit norm_range(const plan& p)
      : low(V::bits(V::all(static_cast<float>(p.low)))), high(V::bits(V::all(static_cast<float>(p.high)))) {}

  [[gnu::always_inline]] f clamp(f x) const {
    if (!Signed) return V::value(V::imin(V::bits(V::max(x, zero)), high));
    const i number = V::keep(V::eq(x, x), V::bits(x));
    return V::value(V::umin(V::imin(number, high), low));
  }
};

/// n, the integer nearest to x scale, moved where the sign of the rest d = x scale - n, which one fma finds, says that
/// another direction goes elsewhere; the processor must round to nearest.
template <class V, rounding D, bool Signed>
struct norm_value : norm_range<V, Signed> {
  using range = norm_range<V, Signed>;
  using f = typename V::f;
  using i = typename V::i;
  using range::zero;

  norm_step<V, rounding::nearest_even> step;
  const f one = V::all(1), two = V::all(2), half = V::all(0.5f);
  const i sign = V::all_bits(0x80000000u);

  [[gnu::always_inline]] explicit norm_value(const plan& p) : range(p), step(p) {}

  [[gnu::always_inline]] f operator()(f x) const {
    const f y = range::clamp(x), sum = V::fma(y, step.scale, step.magic), n = V::sub(sum, step.magic);
    if constexpr (D == rounding::nearest_even) return step.to_value(n);
    else return step.to_value(moved(y, sum, n));
  }

 private:
  [[gnu::always_inline]] f moved(f y, f sum, f n) const {
    if constexpr (D == rounding::nearest_away) {
      // A tie that went to the even one, toward zero: its rest is 1/2 with y's sign.
      const f rest = with_sign_of(y, half);
      const auto tie = V::eq(V::fnma(y, step.scale, V::add(n, rest)), zero);
      return V::fma(V::value(V::keep(tie, V::bits(rest))), two, n);
    } else {
      const f d = V::fms(y, step.scale, n);
      if constexpr (D == rounding::up) return V::add(n, where(V::gt(d, zero), one));
      if constexpr (D == rounding::down) return V::sub(n, where(V::gt(zero, d), one));
      if constexpr (D == rounding::toward_zero) {
        const f of_size = Signed ? V::value(V::xor_(V::bits(d), V::and_(V::bits(y), sign))) : d;
        return V::sub(n, where(V::gt(zero, of_size), with_sign_of(y, one)));
      }
      // To odd: the integer below, its last bit set where x scale is none.
      const f below = V::sub(sum, where(V::gt(zero, d), one));
      const i odd = V::keep(V::ne(d, zero), V::all_bits(1));
      return V::sub(V::value(V::or_(V::bits(below), odd)), step.magic);
    }
  }
  [[gnu::always_inline]] static f where(typename V::m m, f a) { return V::value(V::keep(m, V::bits(a))); }
  [[gnu::always_inline]] f with_sign_of(f y, f size) const {
    return Signed ? V::value(V::or_(V::and_(V::bits(y), sign), V::bits(size))) : size;
  }
};

/// Stochastic; the processor must round to nearest. n is the integer nearest to x scale, d the rest, from -1/2 to 1/2, and
/// R, from 0 to 1, the first 32 random bits, of x < 0 their complement, since these are drawn for |x|: the code is
/// n + floor(d + R), which is the integer nearest to n + h with h = d + R - 1/2. Rounding moves R by at most 2^-26 and d and
/// h by 2^-26 and 2^-25; the bits that follow add at most 2^-24 (where fewer than 32 count, they are among these). Only next
/// to a tie, |h| = 1/2, can that matter, and there h h + 4 is rounded to 4 + 1/4, as `undecided` tells; elsewhere it is
/// once in 2^21. A NaN of a signed format is undecided as well: it stays one up to h.
///
/// Goes through a group of vectors operation by operation, since each waits for the one before.
template <class V, bool Signed>
struct drawn_norm_value {
  using f = typename V::f;
  using i = typename V::i;
  using m = typename V::m;

  norm_step<V, rounding::nearest_even> step;
  /// Sums with h below 0 must not leave the binade whose unit is 1.
  const f magic = V::all(Signed ? 0x1.8p23f : 0x1p23f + 1);
  const f low, high, unit = V::all(0x1p-32f), four = V::all(4), tie = V::all(4.25f);
  const i half = V::all_bits(0x80000000u);

  [[gnu::always_inline]] explicit drawn_norm_value(const plan& p)
      : step(p), low(V::all(static_cast<float>(p.low))), high(V::all(static_cast<float>(p.high))) {}

  template <std::size_t Group, class Random>
  [[gnu::always_inline]] void operator()(const f (&x)[Group], Random random, m (&undecided)[Group], f (&r)[Group]) const {
    f y[Group], sum[Group], h[Group];
    const auto each = [](auto one) __attribute__((always_inline)) {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < Group; ++k) one(k);
    };
    each([&](auto k) { y[k] = clamp(x[k]); });
    each([&](auto k) { sum[k] = V::fma(y[k], step.scale, magic); });
    each([&](auto k) { h[k] = V::fms(y[k], step.scale, V::sub(sum[k], magic)); });
    each([&](auto k) {
      const f drawn = V::to_float(V::xor_(of_size(x[k], random(k)), half));  // 2^32 (R - 1/2)
      h[k] = V::fma(drawn, unit, h[k]);
    });
    each([&](auto k) { undecided[k] = V::eq_or_nan(V::fma(h[k], h[k], four), tie); });
    each([&](auto k) { r[k] = V::sub(V::add(sum[k], h[k]), magic); });
    each([&](auto k) { r[k] = step.to_value(r[k]); });
  }

 private:
  [[gnu::always_inline]] f clamp(f x) const {
    if constexpr (Signed) return V::min(high, V::max(low, x));
    return V::value(V::imin(V::bits(V::max(x, low)), V::bits(high)));
  }
  [[gnu::always_inline]] static i of_size(f x, i random) {
    if constexpr (Signed) return V::xor_(random, V::spread_sign(V::bits(x)));
    return random;
  }
};

/// Stochastic with at most 23 random bits; the processor must round toward zero. With those bits as a number R from 1 to 2,
/// |x| scale + R, cut to 24 bits and then to an integer, is one more than the code: cutting twice is cutting once. With a
/// sign it is the code that passes the bounds and is cut to them, as it is the code of a NaN that becomes 0.
template <class V, bool Signed>
struct drawn_norm : norm_range<V, Signed> {
  using range = norm_range<V, Signed>;
  using f = typename V::f;
  using i = typename V::i;
  using range::zero;

  const f unit = V::all(0x1p23f), unit_and_one = V::all(0x1p23f + 1), scale, least, largest;
  const i one = V::bits(V::all(1)), sign = V::all_bits(0x80000000u), random_mask;

  [[gnu::always_inline]] explicit drawn_norm(const plan& p)
      : range(p), scale(V::all(static_cast<float>(p.scale))),
        least(V::all(static_cast<float>(p.low * p.scale))),
        largest(V::all(static_cast<float>(p.high * p.scale))),
        random_mask(V::all_bits(~(0xffffffffu >> p.random_bits))) {}

  [[gnu::always_inline]] f operator()(f x, i random) const {
    const f drawn = V::value(V::or_(V::leading(V::and_(random, random_mask)), one));
    const f size = Signed ? V::value(V::without(sign, V::bits(x))) : range::clamp(x);
    const f code = V::sub(V::add(V::fma(size, scale, drawn), unit), unit_and_one);
    if constexpr (!Signed) return code;
    // As MAXPS: the second where either is NaN.
    const f y = V::value(V::or_(V::bits(V::max(code, zero)), V::and_(V::bits(x), sign)));
    return V::add(V::min(V::max(y, least), largest), zero);  // zero has no sign
  }
};

}  // namespace bitshade::bulk_kernels
