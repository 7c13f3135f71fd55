// Rounding a vector to norms and fixed point: x * scale, rounded once.
#pragma once

#include "bulk/binary_step.hpp"

namespace bitshade::bulk_kernels {

/// One vector in direction D, for codes of fewer bits than the carrier's fraction. The processor's own direction
/// must be to nearest for nearest_even and toward zero for every other D.
///
/// fma(x, scale, 2^F) rounds the exact product at the unit of 2^F, which is 1: the code appears in the low bits, with
/// no second rounding. A plain x * scale, rounded to an integer afterwards, rounds twice.
template <class V, rounding D>
struct norm_step {
  using f = typename V::f;
  using i = typename V::i;
  using m = typename V::m;
  using word = typename V::word;
  using element = typename V::element;
  static constexpr word ones = ~word{0};
  static constexpr element unit = static_cast<element>(word{1} << V::fraction_bits);

  f scale, low, high, magic, magic_up, step, rest;
  i code_mask, random_mask;
  bool has_sign, divides, reciprocal;

  [[gnu::always_inline]] explicit norm_step(const plan& p) {
    scale = V::all(static_cast<element>(p.scale));
    low = V::all(static_cast<element>(p.low));
    high = V::all(static_cast<element>(p.high));
    has_sign = p.has_sign;
    // Half as much again keeps negative codes' sums in the same binade.
    magic = V::all(D == rounding::nearest_even && has_sign ? unit + unit / 2 : unit);
    magic_up = V::all(unit / 2 + element{0.5});
    divides = p.kind == family::unorm || p.kind == family::snorm;
    reciprocal = divides && p.norm == norm_decode::reciprocal;
    step = V::all(sizeof(word) == 4 || reciprocal ? static_cast<element>(p.single_step)
                                                  : static_cast<element>(p.wide_step));
    rest = V::all(static_cast<element>(p.single_rest));
    code_mask = V::all_bits(static_cast<word>(p.width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << p.width) - 1));
    random_mask = V::all_bits(p.random_bits >= 64 ? ones : static_cast<word>(~(ones >> p.random_bits)));
  }

  /// NaN gives 0 and everything else the nearest bound that it passes.
  [[gnu::always_inline]] f clamp(f x) const {
    if (has_sign) x = V::value(V::keep(V::eq(x, x), V::bits(x)));
    return V::min(V::max(x, low), high);
  }

  /// nearest_even: the code plus `magic`.
  [[gnu::always_inline]] f sum(f x) const { return V::fma(clamp(x), scale, magic); }

  [[gnu::always_inline]] i to_code(f x, i random) const {
    if constexpr (D == rounding::nearest_even) {
      return V::and_(V::isub(V::bits(sum(x)), V::bits(magic)), code_mask);
    } else {
      const f y = clamp(x);
      const i s = V::spread_sign(V::bits(y));
      const f a = V::value(V::and_(V::bits(y), V::all_bits(ones >> 1)));
      i c;
      if constexpr (D == rounding::nearest_away) {
        // 2^(F-1) has the unit 1/2: the product plus 1/2, cut there, then to an integer.
        const f t = V::fma(a, scale, magic_up);
        c = V::shr(V::isub(V::bits(t), V::bits(V::all(unit / 2))), V::all_bits(1));
      } else {
        const f t = V::fma(a, scale, magic);
        c = V::isub(V::bits(t), V::bits(magic));
        if constexpr (D != rounding::toward_zero) {
          // Exact for the inputs that reach this kernel stochastically; of the right sign for all.
          const f part = V::fma(a, scale, V::sub(magic, t));
          c = nudge(c, part, s, random);
        }
      }
      return V::and_(V::isub(V::xor_(c, s), s), code_mask);
    }
  }

  /// The number of a code that is still in floating point; to nearest.
  [[gnu::always_inline]] f to_value(f c) const {
    if constexpr (sizeof(word) == 4) {
      // 1 / scale in two parts: for every code of at most 22 bits the quotient rounded once; a test tries all of them. Of
      // fixed point the second part is 0.
      return V::fma(c, step, V::mul(c, rest));
    } else {
      if (!divides) return V::mul(c, step);
      if (reciprocal) return V::as_single(V::mul(V::as_single(c), step));
      const f q = V::mul(c, step);
      // One step of Newton's with an exact remainder: the quotient rounded once [Markstein90]; tests try every code.
      return V::fma(V::fnma(q, scale, c), step, q);
    }
  }

 private:
  [[gnu::always_inline]] i nudge(i c, f part, i s, i random) const {
    const i one = V::all_bits(1);
    if constexpr (D == rounding::stochastic) {
      // part * 2^64 as an integer: its significand, shifted to where its exponent says.
      constexpr int fraction = V::fraction_bits;
      const i unit_bits = V::all_bits(word{1} << fraction);
      const i significand = V::or_(V::and_(V::bits(part), V::all_bits((word{1} << fraction) - 1)), unit_bits);
      const i place = V::isub(V::shr(V::bits(part), V::all_bits(fraction)),
                              V::all_bits(static_cast<word>((1 << (V::exponent_bits - 1)) - 1 + fraction - 64)));
      const i bits = V::or_(V::shl(significand, place), V::shr(significand, V::isub(V::all_bits(0), place)));
      const i drawn = V::and_(random, random_mask);
      const i missing = V::xor_(V::and_(bits, random_mask), V::all_bits(ones));
      return V::iadd(c, V::keep(V::ugt(drawn, missing), one));
    } else {
      const i step_up = V::keep(V::ne(part, V::all(0)), one);
      if constexpr (D == rounding::to_odd) return V::or_(c, step_up);
      return V::iadd(c, V::and_(step_up, D == rounding::down ? s : V::xor_(s, V::all_bits(ones))));
    }
  }
};

}  // namespace bitshade::bulk_kernels
