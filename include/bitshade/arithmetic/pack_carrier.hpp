// A pack as the carrier of an emulated format: how its lanes are rounded.
#pragma once

#include "bitshade/arithmetic/carrier.hpp"
#include "bitshade/arithmetic/wide_pack.hpp"

namespace bitshade {

/// Several registers: each half by itself.
template <class T, int N>
  requires takes_registers<T, N>
struct carrier_traits<pack<T, N>> {
  using carrier = pack<T, N>;
  using scalar = T;
  using mask = typename carrier::mask;
  using part = carrier_traits<pack<T, N / 2>>;
  static constexpr int lanes = N;

  [[gnu::always_inline]] static carrier broadcast(T x) { return carrier(x); }
  [[gnu::always_inline]] static carrier abs(const carrier& x) { return x.magnitude(); }
  [[gnu::always_inline]] static carrier sqrt(const carrier& x) { return x.square_root(); }
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier round(const carrier& x) {
    return {part::template round<E, R>(x.low()), part::template round<E, R>(x.high())};
  }
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier fused(const carrier& a, const carrier& b, const carrier& c) {
    return {part::template fused<E, R>(a.low(), b.low(), c.low()),
            part::template fused<E, R>(a.high(), b.high(), c.high())};
  }
};

/// Formats that a lane carries without rounding twice, to nearest even (carrier.hpp).
template <class T, int N>
struct carrier_traits<pack<T, N>> {
  using carrier = pack<T, N>;
  using scalar = T;
  using mask = typename carrier::mask;
  using vector = typename carrier::vector;
  using bits = typename mask::bits;
  static constexpr int lanes = N;
  static constexpr encoding shape = detail::shape_of<T>::value;

  [[gnu::always_inline]] static carrier broadcast(T x) { return carrier(x); }
  [[gnu::always_inline]] static carrier abs(const carrier& x) { return x.magnitude(); }
  [[gnu::always_inline]] static carrier sqrt(const carrier& x) { return x.square_root(); }

  /// To nearest even. Adding a power of two pushes what lies below the format's unit out of the lane's significand;
  /// its exponent is that of the number, but at least that of the smallest normal one. No branch, no table:
  /// subnormals take the same time.
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier round(const carrier& x) {
    if constexpr (E == shape && R.overflow != overflow::saturate && !flushes_output(R.subnormal)) {
      return x;
    } else {
      static_assert(detail::is_narrower<T>(E, R),
                    "bitshade: a pack rounds binary formats narrower than its lanes, to nearest even");
      if constexpr (std::is_same_v<T, float> && E == binary_encoding(5, 10) &&
                    R.subnormal == subnormals::preserve && R.overflow != overflow::saturate) {
#if defined(__AVX512F__)
        if constexpr (N == 16) {
          return opaque(_mm512_maskz_cvtph_ps(0xffff, _mm512_maskz_cvtps_ph(0xffff, x.lanes_of(), nearest)));
        }
#endif
#if defined(__F16C__)
        if constexpr (N == 8) return opaque(_mm256_cvtph_ps(_mm256_cvtps_ph(x.lanes_of(), nearest)));
        if constexpr (N == 4) return opaque(_mm_cvtph_ps(_mm_cvtps_ph(x.lanes_of(), nearest)));
#endif
      }
      using word = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
      constexpr int drop = shape.fraction_bits - E.fraction_bits;
      constexpr auto field = [](int exponent) {
        return static_cast<word>(exponent + bias(shape)) << shape.fraction_bits;
      };
      constexpr word infinity = static_cast<word>(infinity_bits(shape));
      constexpr T largest = std::bit_cast<T>(static_cast<word>(
          (static_cast<word>(max_bits(E)) << drop) + field(min_exponent(E)) - (word{1} << shape.fraction_bits)));
      constexpr T beyond = R.overflow == overflow::saturate ? largest
                           : has_infinity(E) ? std::bit_cast<T>(infinity)
                                             : std::numeric_limits<T>::quiet_NaN();
      const bits magnitude = std::bit_cast<bits>(x.lanes_of()) & (bits{} + std::numeric_limits<word>::max());
      const bits sign = std::bit_cast<bits>(x.lanes_of()) ^ magnitude;
      bits exponent = magnitude & (bits{} + infinity);
      exponent = exponent > field(min_exponent(E)) ? exponent : bits{} + field(min_exponent(E));
      // Beyond the largest exponent the power need only be large enough, and finite.
      exponent = exponent < field(bias(E) + 2) ? exponent : bits{} + field(bias(E) + 2);
      const vector power = std::bit_cast<vector>(exponent + (word{drop} << shape.fraction_bits));
      vector r = (std::bit_cast<vector>(magnitude) + power) - power;
      r = r > largest ? vector{} + beyond : r;
      if constexpr (flushes_output(R.subnormal)) {
        r = r < std::bit_cast<T>(field(min_exponent(E))) ? vector{} : r;
      }
      return carrier(std::bit_cast<vector>(std::bit_cast<bits>(r) | sign));
    }
  }

  /// a b + c: the product is exact in a lane that carries the format; an error-free sum, rounded to odd, keeps what
  /// the rounding to E has to know [BoldoMelquiond08].
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier fused(const carrier& a, const carrier& b, const carrier& c) {
    static_assert(std::is_same_v<T, float> ? carried_by_float(E) : carried_by_double(E));
    const vector product = a.lanes_of() * b.lanes_of(), term = c.lanes_of();
    const vector sum = product + term;
    // Without the larger of the two, the sum leaves the other and the exact error [Dekker71]; without the smaller one it is
    // rounded to the larger one or past it, to the error's side. So the two errors never differ in sign.
    const vector error = (term - (sum - product)) + (product - (sum - term));
    // To odd: toward zero, where the error has the other sign than the sum, then the last bit set.
    const bits less = error < 0, more = error > 0, pattern = std::bit_cast<bits>(sum);
    const bits toward_zero = pattern + (pattern < 0 ? more : less);
    return round<E, R>(carrier(std::bit_cast<vector>(toward_zero | ((less | more) & 1))));
  }

 private:
  /// clang 16 turns a comparison of converted halves into one of halves, lane by lane: hide where they came from.
  static carrier opaque(vector x) {
#if defined(__clang__) && defined(__SSE2__)
    asm("" : "+x"(x));
#endif
    return carrier(x);
  }
  static constexpr int nearest = 0x8;  // to nearest even whatever the processor is set to, no exceptions
};

}  // namespace bitshade
