// Lanes of SSE2, which every x86-64 has. Included by the baseline kernels alone.
#pragma once

#include <emmintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bitshade::bulk_kernels::sse2 {

/// Four binary32 lanes. Shift counts are the same in every lane; predicates are lanes of ones or zeros.
struct lanes32 {
  using element = float;
  using word = std::uint32_t;
  using f = __m128;
  using i = __m128i;
  using m = __m128i;
  static constexpr std::size_t width = 4;
  static constexpr int fraction_bits = 23;
  static constexpr int exponent_bits = 8;
  static constexpr bool has_fma = false;
  static constexpr bool has_exponents = false;  ///< takes numbers apart by instructions
  static constexpr bool has_half = false;
  static constexpr bool has_random = false;

  static f load(const float* p) { return _mm_loadu_ps(p); }
  static void store(float* p, f v) { _mm_storeu_ps(p, v); }
  static f value(i v) { return _mm_castsi128_ps(v); }
  static i bits(f v) { return _mm_castps_si128(v); }
  static f all(float v) { return _mm_set1_ps(v); }
  static i all_bits(word v) { return _mm_set1_epi32(static_cast<int>(v)); }

  static f add(f a, f b) { return _mm_add_ps(a, b); }
  static f sub(f a, f b) { return _mm_sub_ps(a, b); }
  static f mul(f a, f b) { return _mm_mul_ps(a, b); }
  static f div(f a, f b) { return _mm_div_ps(a, b); }
  static f sqrt(f a) { return _mm_sqrt_ps(a); }
  // The second operand where either is NaN.
  static f max(f a, f b) { return _mm_max_ps(a, b); }
  static f min(f a, f b) { return _mm_min_ps(a, b); }

  static i and_(i a, i b) { return _mm_and_si128(a, b); }
  static i or_(i a, i b) { return _mm_or_si128(a, b); }
  static i xor_(i a, i b) { return _mm_xor_si128(a, b); }
  static i without(i where, i a) { return _mm_andnot_si128(where, a); }
  static i merge(i where, i a, i b) { return or_(and_(where, a), _mm_andnot_si128(where, b)); }
  static i iadd(i a, i b) { return _mm_add_epi32(a, b); }
  static i isub(i a, i b) { return _mm_sub_epi32(a, b); }
  static i imax(i a, i b) { return select(igt(a, b), a, b); }
  static i imin(i a, i b) { return select(igt(a, b), b, a); }
  static i count(i n) { return _mm_srli_epi64(_mm_slli_epi64(n, 32), 32); }
  static i shl(i a, i n) { return _mm_sll_epi32(a, count(n)); }
  static i shr(i a, i n) { return _mm_srl_epi32(a, count(n)); }
  static i spread_sign(i a) { return _mm_srai_epi32(a, 31); }
  static f to_float(i a) { return _mm_cvtepi32_ps(a); }
  static i to_int(f a) { return _mm_cvttps_epi32(a); }

  static m gt(f a, f b) { return bits(_mm_cmpgt_ps(a, b)); }
  static m eq(f a, f b) { return bits(_mm_cmpeq_ps(a, b)); }
  static m ne(f a, f b) { return bits(_mm_cmpneq_ps(a, b)); }
  static m nle(f a, f b) { return bits(_mm_cmpnle_ps(a, b)); }
  static m nan(f a) { return bits(_mm_cmpunord_ps(a, a)); }
  static m igt(i a, i b) { return _mm_cmpgt_epi32(a, b); }
  static m ieq(i a, i b) { return _mm_cmpeq_epi32(a, b); }
  static m inot(m a) { return xor_(a, all_bits(~word{0})); }
  static i select(m k, i a, i b) { return merge(k, a, b); }
  /// a where s is negative, else b.
  static i select_negative(i s, i a, i b) { return merge(spread_sign(s), a, b); }
  static i keep(m k, i a) { return and_(k, a); }

  static i load_codes(const std::uint8_t* p) {
    return _mm_set_epi32(p[3], p[2], p[1], p[0]);
  }
  static i load_codes(const std::uint16_t* p) {
    return _mm_unpacklo_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)), _mm_setzero_si128());
  }
  static i load_codes(const std::uint32_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
  static void store_codes(std::uint32_t* p, i v) { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), v); }
  static void store_codes(std::uint16_t* p, i v) {
    // Packing saturates as signed; shifting by half a range before and after keeps the 16 bits.
    const i shifted = isub(v, all_bits(0x8000));
    const i packed = _mm_xor_si128(_mm_packs_epi32(shifted, shifted), _mm_set1_epi16(static_cast<short>(0x8000)));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(p), packed);
  }
  static void store_codes(std::uint8_t* p, i v) {
    const i words = _mm_packs_epi32(v, v);
    const int four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
    std::memcpy(p, &four, 4);
  }
};

}  // namespace bitshade::bulk_kernels::sse2
