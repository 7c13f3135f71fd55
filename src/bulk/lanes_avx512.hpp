// Lanes of AVX-512 (F, BW, DQ, VL). Included by the AVX-512 kernels alone.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace bitshade::bulk_kernels::avx512 {

/// 32-bit words of a register, whatever the lanes.
struct words {
  using i = __m512i;
  static i word_add(i a, i b) { return _mm512_add_epi32(a, b); }
  static i word_multiply(i a, i b) { return _mm512_mullo_epi32(a, b); }
  template <int N>
  static i word_shift(i a) { return _mm512_srli_epi32(a, N); }
  template <int N>
  static i word_shift_signed(i a) { return _mm512_srai_epi32(a, N); }
  static i word_reverse(i a) {
    return _mm512_shuffle_epi8(a, _mm512_set4_epi32(0x0c0d0e0f, 0x08090a0b, 0x04050607, 0x00010203));
  }
};

/// Sixteen binary32 lanes. Integer lanes are two's complement; predicates are mask registers.
struct lanes32 : words {
  using element = float;
  using word = std::uint32_t;
  using f = __m512;
  using i = __m512i;
  using m = __mmask16;
  static constexpr std::size_t width = 16;
  static constexpr int fraction_bits = 23;
  static constexpr int exponent_bits = 8;
  static constexpr bool has_fma = true;
  static constexpr bool has_exponents = true;  ///< takes numbers apart by instructions
  static constexpr bool has_half = true;
  static constexpr bool has_random = true;

  static f load(const float* p) { return _mm512_loadu_ps(p); }
  static void store(float* p, f v) { _mm512_storeu_ps(p, v); }
  static f value(i v) { return _mm512_castsi512_ps(v); }
  static i bits(f v) { return _mm512_castps_si512(v); }
  static f all(float v) { return _mm512_set1_ps(v); }
  static i all_bits(word v) { return _mm512_set1_epi32(static_cast<int>(v)); }

  static f add(f a, f b) { return _mm512_add_ps(a, b); }
  static f sub(f a, f b) { return _mm512_sub_ps(a, b); }
  static f mul(f a, f b) { return _mm512_mul_ps(a, b); }
  static f div(f a, f b) { return _mm512_div_ps(a, b); }
  static f sqrt(f a) { return _mm512_sqrt_ps(a); }
  static f fma(f a, f b, f c) { return _mm512_fmadd_ps(a, b, c); }
  static f fnma(f a, f b, f c) { return _mm512_fnmadd_ps(a, b, c); }
  static f fms(f a, f b, f c) { return _mm512_fmsub_ps(a, b, c); }
  /// a b + c to odd for an exact a b: where inexact, the odd one of the two neighbours.
  static f fma_to_odd(f a, f b, f c) {
    const f product = mul(a, b);
    const f below = _mm512_add_round_ps(product, c, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    const f above = _mm512_add_round_ps(product, c, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
    return _mm512_mask_blend_ps(_mm512_test_epi32_mask(bits(below), all_bits(1)), above, below);
  }
  /// x = significand * 2^exponent, the significand from 1 to 2; of subnormal numbers too.
  static f significand(f x) { return _mm512_getmant_ps(x, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_src); }
  static f exponent(f x) { return _mm512_getexp_ps(x); }
  static f scale(f x, f e) { return _mm512_scalef_ps(x, e); }
  // As MAXPS and MINPS: the second operand where either is NaN.
  static f max(f a, f b) { return _mm512_max_ps(a, b); }
  static f min(f a, f b) { return _mm512_min_ps(a, b); }

  static i and_(i a, i b) { return _mm512_and_si512(a, b); }
  static i or_(i a, i b) { return _mm512_or_si512(a, b); }
  static i xor_(i a, i b) { return _mm512_xor_si512(a, b); }
  static i without(i where, i a) { return _mm512_andnot_si512(where, a); }
  /// where ? a : b, bit by bit.
  static i merge(i where, i a, i b) { return _mm512_ternarylogic_epi32(where, a, b, 0xca); }
  static i iadd(i a, i b) { return _mm512_add_epi32(a, b); }
  static i isub(i a, i b) { return _mm512_sub_epi32(a, b); }
  static i imax(i a, i b) { return _mm512_max_epi32(a, b); }
  static i imin(i a, i b) { return _mm512_min_epi32(a, b); }
  static i umin(i a, i b) { return _mm512_min_epu32(a, b); }
  // Counts beyond the lane give zero.
  static i shl(i a, i n) { return _mm512_sllv_epi32(a, n); }
  static i shr(i a, i n) { return _mm512_srlv_epi32(a, n); }
  /// The leading bits, as many as the fraction has.
  static i leading(i a) { return _mm512_srli_epi32(a, 9); }
  static i spread_sign(i a) { return _mm512_srai_epi32(a, 31); }
  static f to_float(i a) { return _mm512_cvtepi32_ps(a); }
  static i to_int(f a) { return _mm512_cvttps_epi32(a); }

  static m gt(f a, f b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
  static m eq(f a, f b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
  static m ne(f a, f b) { return _mm512_cmp_ps_mask(a, b, _CMP_NEQ_UQ); }
  /// Not a <= b: greater, or NaN.
  static m nle(f a, f b) { return _mm512_cmp_ps_mask(a, b, _CMP_NLE_UQ); }
  static m eq_or_nan(f a, f b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_UQ); }
  static m nan(f a) { return _mm512_cmp_ps_mask(a, a, _CMP_UNORD_Q); }
  static m igt(i a, i b) { return _mm512_cmpgt_epi32_mask(a, b); }
  static m ugt(i a, i b) { return _mm512_cmpgt_epu32_mask(a, b); }
  static m ieq(i a, i b) { return _mm512_cmpeq_epi32_mask(a, b); }
  static m inot(m a) { return static_cast<m>(~a); }
  static bool any(m a) { return a != 0; }
  static i select(m k, i a, i b) { return _mm512_mask_blend_epi32(k, b, a); }
  /// a where s is negative, else b.
  static i select_negative(i s, i a, i b) { return select(_mm512_movepi32_mask(s), a, b); }
  /// a where the predicate holds, else zero bits.
  static i keep(m k, i a) { return _mm512_maskz_mov_epi32(k, a); }

  static i load_codes(const std::uint8_t* p) {
    return _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  }
  static i load_codes(const std::uint16_t* p) {
    return _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
  }
  static i load_codes(const std::uint32_t* p) { return _mm512_loadu_si512(p); }
  static void store_codes(std::uint8_t* p, i v) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm512_cvtepi32_epi8(v));
  }
  static void store_codes(std::uint16_t* p, i v) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtepi32_epi16(v));
  }
  static void store_codes(std::uint32_t* p, i v) { _mm512_storeu_si512(p, v); }

  using half_codes = __m256i;
  template <int Direction>
  static half_codes to_half(f v) { return _mm512_cvtps_ph(v, Direction | _MM_FROUND_NO_EXC); }
  static f from_half(half_codes v) { return _mm512_cvtph_ps(v); }
  static half_codes load_half(const std::uint16_t* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  static void store_half(std::uint16_t* p, half_codes v) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v);
  }

  static i words(std::uint32_t upper, std::uint32_t) { return all_bits(upper); }
  static i lane_numbers() { return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }
};

/// Eight binary64 lanes; floats go in and out by conversion.
struct lanes64 : words {
  using element = double;
  using word = std::uint64_t;
  using f = __m512d;
  using i = __m512i;
  using m = __mmask8;
  static constexpr std::size_t width = 8;
  static constexpr int fraction_bits = 52;
  static constexpr int exponent_bits = 11;
  static constexpr bool has_fma = true;
  static constexpr bool has_exponents = false;
  static constexpr bool has_half = false;
  static constexpr bool has_random = true;
  static constexpr bool stores_to_nearest = true;

  static f load(const double* p) { return _mm512_loadu_pd(p); }
  static f load(const float* p) { return _mm512_cvtps_pd(_mm256_loadu_ps(p)); }
  static void store(double* p, f v) { _mm512_storeu_pd(p, v); }
  static void store(float* p, f v) {
    _mm256_storeu_ps(p, _mm512_cvt_roundpd_ps(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
  }
  static f value(i v) { return _mm512_castsi512_pd(v); }
  static i bits(f v) { return _mm512_castpd_si512(v); }
  static f all(double v) { return _mm512_set1_pd(v); }
  static i all_bits(word v) { return _mm512_set1_epi64(static_cast<long long>(v)); }

  static f add(f a, f b) { return _mm512_add_pd(a, b); }
  static f sub(f a, f b) { return _mm512_sub_pd(a, b); }
  static f mul(f a, f b) { return _mm512_mul_pd(a, b); }
  static f fma(f a, f b, f c) { return _mm512_fmadd_pd(a, b, c); }
  static f fnma(f a, f b, f c) { return _mm512_fnmadd_pd(a, b, c); }
  static f fms(f a, f b, f c) { return _mm512_fmsub_pd(a, b, c); }
  static f max(f a, f b) { return _mm512_max_pd(a, b); }
  static f min(f a, f b) { return _mm512_min_pd(a, b); }
  static f as_single(f a) { return _mm512_cvtps_pd(_mm512_cvtpd_ps(a)); }

  static i and_(i a, i b) { return _mm512_and_si512(a, b); }
  static i or_(i a, i b) { return _mm512_or_si512(a, b); }
  static i xor_(i a, i b) { return _mm512_xor_si512(a, b); }
  static i without(i where, i a) { return _mm512_andnot_si512(where, a); }
  static i merge(i where, i a, i b) { return _mm512_ternarylogic_epi64(where, a, b, 0xca); }
  static i iadd(i a, i b) { return _mm512_add_epi64(a, b); }
  static i isub(i a, i b) { return _mm512_sub_epi64(a, b); }
  static i imax(i a, i b) { return _mm512_max_epi64(a, b); }
  static i imin(i a, i b) { return _mm512_min_epi64(a, b); }
  static i shl(i a, i n) { return _mm512_sllv_epi64(a, n); }
  static i shr(i a, i n) { return _mm512_srlv_epi64(a, n); }
  /// The leading bits, as many as the fraction has.
  static i leading(i a) { return _mm512_srli_epi64(a, 12); }
  static i spread_sign(i a) { return _mm512_srai_epi64(a, 63); }

  static m gt(f a, f b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
  static m eq(f a, f b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static m ne(f a, f b) { return _mm512_cmp_pd_mask(a, b, _CMP_NEQ_UQ); }
  static m nle(f a, f b) { return _mm512_cmp_pd_mask(a, b, _CMP_NLE_UQ); }
  static m nan(f a) { return _mm512_cmp_pd_mask(a, a, _CMP_UNORD_Q); }
  static m igt(i a, i b) { return _mm512_cmpgt_epi64_mask(a, b); }
  static m ugt(i a, i b) { return _mm512_cmpgt_epu64_mask(a, b); }
  static m ieq(i a, i b) { return _mm512_cmpeq_epi64_mask(a, b); }
  static m inot(m a) { return static_cast<m>(~a); }
  static bool any(m a) { return a != 0; }
  static i select(m k, i a, i b) { return _mm512_mask_blend_epi64(k, b, a); }
  /// a where s is negative, else b.
  static i select_negative(i s, i a, i b) { return select(_mm512_movepi64_mask(s), a, b); }
  static i keep(m k, i a) { return _mm512_maskz_mov_epi64(k, a); }

  static i load_codes(const std::uint8_t* p) {
    return _mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  }
  static i load_codes(const std::uint16_t* p) {
    return _mm512_cvtepu16_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  }
  static i load_codes(const std::uint32_t* p) {
    return _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
  }
  static i load_codes(const std::uint64_t* p) { return _mm512_loadu_si512(p); }
  static void store_codes(std::uint8_t* p, i v) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm512_cvtepi64_epi8(v));
  }
  static void store_codes(std::uint16_t* p, i v) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm512_cvtepi64_epi16(v));
  }
  static void store_codes(std::uint32_t* p, i v) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtepi64_epi32(v));
  }
  static void store_codes(std::uint64_t* p, i v) { _mm512_storeu_si512(p, v); }
  /// Integers below 2^52 in binary64.
  static f to_float(i a) { return _mm512_cvtepi64_pd(a); }

  static i words(std::uint32_t upper, std::uint32_t lower) { return all_bits(word{upper} << 32 | lower); }
  static i lane_numbers() { return _mm512_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7); }
};

}  // namespace bitshade::bulk_kernels::avx512
