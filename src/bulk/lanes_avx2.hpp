// Lanes of AVX2 with FMA and F16C. Included by the AVX2 kernels alone.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace bitshade::bulk_kernels::avx2 {

/// 32-bit words of a register, whatever the lanes.
struct words {
  using i = __m256i;
  static i word_add(i a, i b) { return _mm256_add_epi32(a, b); }
  static i word_multiply(i a, i b) { return _mm256_mullo_epi32(a, b); }
  template <int N>
  static i word_shift(i a) { return _mm256_srli_epi32(a, N); }
  template <int N>
  static i word_shift_signed(i a) { return _mm256_srai_epi32(a, N); }
  static i word_reverse(i a) {
    return _mm256_shuffle_epi8(a, _mm256_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12, 3, 2, 1, 0, 7,
                                                   6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  }
};

/// Eight binary32 lanes; predicates are lanes of ones or zeros.
struct lanes32 : words {
  using element = float;
  using word = std::uint32_t;
  using f = __m256;
  using i = __m256i;
  using m = __m256i;
  static constexpr std::size_t width = 8;
  static constexpr int fraction_bits = 23;
  static constexpr int exponent_bits = 8;
  static constexpr bool has_fma = true;
  static constexpr bool has_exponents = false;  ///< takes numbers apart by instructions
  static constexpr bool has_half = true;
  static constexpr bool has_random = true;

  static f load(const float* p) { return _mm256_loadu_ps(p); }
  static void store(float* p, f v) { _mm256_storeu_ps(p, v); }
  static f value(i v) { return _mm256_castsi256_ps(v); }
  static i bits(f v) { return _mm256_castps_si256(v); }
  static f all(float v) { return _mm256_set1_ps(v); }
  static i all_bits(word v) { return _mm256_set1_epi32(static_cast<int>(v)); }

  static f add(f a, f b) { return _mm256_add_ps(a, b); }
  static f sub(f a, f b) { return _mm256_sub_ps(a, b); }
  static f mul(f a, f b) { return _mm256_mul_ps(a, b); }
  static f div(f a, f b) { return _mm256_div_ps(a, b); }
  static f sqrt(f a) { return _mm256_sqrt_ps(a); }
  static f fma(f a, f b, f c) { return _mm256_fmadd_ps(a, b, c); }
  static f fnma(f a, f b, f c) { return _mm256_fnmadd_ps(a, b, c); }
  static f fms(f a, f b, f c) { return _mm256_fmsub_ps(a, b, c); }
  /// a b + c to odd for an exact a b; the processor must round toward zero. The sum, cut, less a b is c again only where
  /// nothing was cut: without the larger of the two it leaves the other and the error exactly [Dekker71]; without a smaller
  /// a b, less than c in size.
  static f fma_to_odd(f a, f b, f c) {
    const f cut = fma(a, b, c);
    const i inexact = bits(_mm256_cmp_ps(fnma(a, b, cut), c, _CMP_NEQ_OQ));
    return value(or_(bits(cut), and_(inexact, all_bits(1))));
  }
  static f max(f a, f b) { return _mm256_max_ps(a, b); }
  static f min(f a, f b) { return _mm256_min_ps(a, b); }

  static i and_(i a, i b) { return _mm256_and_si256(a, b); }
  static i or_(i a, i b) { return _mm256_or_si256(a, b); }
  static i xor_(i a, i b) { return _mm256_xor_si256(a, b); }
  static i without(i where, i a) { return _mm256_andnot_si256(where, a); }
  static i merge(i where, i a, i b) { return or_(and_(where, a), _mm256_andnot_si256(where, b)); }
  static i iadd(i a, i b) { return _mm256_add_epi32(a, b); }
  static i isub(i a, i b) { return _mm256_sub_epi32(a, b); }
  static i imax(i a, i b) { return _mm256_max_epi32(a, b); }
  static i imin(i a, i b) { return _mm256_min_epi32(a, b); }
  static i umin(i a, i b) { return _mm256_min_epu32(a, b); }
  static i shl(i a, i n) { return _mm256_sllv_epi32(a, n); }
  static i shr(i a, i n) { return _mm256_srlv_epi32(a, n); }
  /// The leading bits, as many as the fraction has.
  static i leading(i a) { return _mm256_srli_epi32(a, 9); }
  static i spread_sign(i a) { return _mm256_srai_epi32(a, 31); }
  static f to_float(i a) { return _mm256_cvtepi32_ps(a); }
  static i to_int(f a) { return _mm256_cvttps_epi32(a); }

  static m gt(f a, f b) { return bits(_mm256_cmp_ps(a, b, _CMP_GT_OQ)); }
  static m eq(f a, f b) { return bits(_mm256_cmp_ps(a, b, _CMP_EQ_OQ)); }
  static m ne(f a, f b) { return bits(_mm256_cmp_ps(a, b, _CMP_NEQ_UQ)); }
  static m nle(f a, f b) { return bits(_mm256_cmp_ps(a, b, _CMP_NLE_UQ)); }
  static m eq_or_nan(f a, f b) { return bits(_mm256_cmp_ps(a, b, _CMP_EQ_UQ)); }
  static m nan(f a) { return bits(_mm256_cmp_ps(a, a, _CMP_UNORD_Q)); }
  static m igt(i a, i b) { return _mm256_cmpgt_epi32(a, b); }
  static m ugt(i a, i b) {
    const i top = all_bits(0x80000000u);
    return igt(xor_(a, top), xor_(b, top));
  }
  static m ieq(i a, i b) { return _mm256_cmpeq_epi32(a, b); }
  static m inot(m a) { return xor_(a, all_bits(~word{0})); }
  static bool any(m a) { return _mm256_movemask_epi8(a) != 0; }
  static i select(m k, i a, i b) { return _mm256_blendv_epi8(b, a, k); }
  /// a where s is negative, else b.
  static i select_negative(i s, i a, i b) { return bits(_mm256_blendv_ps(value(b), value(a), value(s))); }
  static i keep(m k, i a) { return and_(k, a); }

  static i load_codes(const std::uint8_t* p) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  }
  static i load_codes(const std::uint16_t* p) {
    return _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  }
  static i load_codes(const std::uint32_t* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  static __m128i narrow(i v) {
    return _mm_packus_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  }
  static void store_codes(std::uint8_t* p, i v) {
    const __m128i words = narrow(v);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packus_epi16(words, words));
  }
  static void store_codes(std::uint16_t* p, i v) { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), narrow(v)); }
  static void store_codes(std::uint32_t* p, i v) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }

  using half_codes = __m128i;
  template <int Direction>
  static half_codes to_half(f v) { return _mm256_cvtps_ph(v, Direction | _MM_FROUND_NO_EXC); }
  static f from_half(half_codes v) { return _mm256_cvtph_ps(v); }
  static half_codes load_half(const std::uint16_t* p) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  }
  static void store_half(std::uint16_t* p, half_codes v) { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), v); }

  static i words(std::uint32_t upper, std::uint32_t) { return all_bits(upper); }
  static i lane_numbers() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
};

/// Four binary64 lanes; floats go in and out by conversion.
struct lanes64 : words {
  using element = double;
  using word = std::uint64_t;
  using f = __m256d;
  using i = __m256i;
  using m = __m256i;
  static constexpr std::size_t width = 4;
  static constexpr int fraction_bits = 52;
  static constexpr int exponent_bits = 11;
  static constexpr bool has_fma = true;
  static constexpr bool has_exponents = false;
  static constexpr bool has_half = false;
  static constexpr bool has_random = true;
  static constexpr bool stores_to_nearest = false;

  static f load(const double* p) { return _mm256_loadu_pd(p); }
  static f load(const float* p) { return _mm256_cvtps_pd(_mm_loadu_ps(p)); }
  static void store(double* p, f v) { _mm256_storeu_pd(p, v); }
  static void store(float* p, f v) { _mm_storeu_ps(p, _mm256_cvtpd_ps(v)); }
  static f value(i v) { return _mm256_castsi256_pd(v); }
  static i bits(f v) { return _mm256_castpd_si256(v); }
  static f all(double v) { return _mm256_set1_pd(v); }
  static i all_bits(word v) { return _mm256_set1_epi64x(static_cast<long long>(v)); }

  static f add(f a, f b) { return _mm256_add_pd(a, b); }
  static f sub(f a, f b) { return _mm256_sub_pd(a, b); }
  static f mul(f a, f b) { return _mm256_mul_pd(a, b); }
  static f fma(f a, f b, f c) { return _mm256_fmadd_pd(a, b, c); }
  static f fnma(f a, f b, f c) { return _mm256_fnmadd_pd(a, b, c); }
  static f fms(f a, f b, f c) { return _mm256_fmsub_pd(a, b, c); }
  static f max(f a, f b) { return _mm256_max_pd(a, b); }
  static f min(f a, f b) { return _mm256_min_pd(a, b); }
  static f as_single(f a) { return _mm256_cvtps_pd(_mm256_cvtpd_ps(a)); }

  static i and_(i a, i b) { return _mm256_and_si256(a, b); }
  static i or_(i a, i b) { return _mm256_or_si256(a, b); }
  static i xor_(i a, i b) { return _mm256_xor_si256(a, b); }
  static i without(i where, i a) { return _mm256_andnot_si256(where, a); }
  static i merge(i where, i a, i b) { return or_(and_(where, a), _mm256_andnot_si256(where, b)); }
  static i iadd(i a, i b) { return _mm256_add_epi64(a, b); }
  static i isub(i a, i b) { return _mm256_sub_epi64(a, b); }
  static i imax(i a, i b) { return select(igt(a, b), a, b); }
  static i imin(i a, i b) { return select(igt(a, b), b, a); }
  static i shl(i a, i n) { return _mm256_sllv_epi64(a, n); }
  static i shr(i a, i n) { return _mm256_srlv_epi64(a, n); }
  /// The leading bits, as many as the fraction has.
  static i leading(i a) { return _mm256_srli_epi64(a, 12); }
  static i spread_sign(i a) { return igt(_mm256_setzero_si256(), a); }

  static m gt(f a, f b) { return bits(_mm256_cmp_pd(a, b, _CMP_GT_OQ)); }
  static m eq(f a, f b) { return bits(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)); }
  static m ne(f a, f b) { return bits(_mm256_cmp_pd(a, b, _CMP_NEQ_UQ)); }
  static m nle(f a, f b) { return bits(_mm256_cmp_pd(a, b, _CMP_NLE_UQ)); }
  static m nan(f a) { return bits(_mm256_cmp_pd(a, a, _CMP_UNORD_Q)); }
  static m igt(i a, i b) { return _mm256_cmpgt_epi64(a, b); }
  static m ugt(i a, i b) {
    const i top = all_bits(word{1} << 63);
    return igt(xor_(a, top), xor_(b, top));
  }
  static m ieq(i a, i b) { return _mm256_cmpeq_epi64(a, b); }
  static m inot(m a) { return xor_(a, all_bits(~word{0})); }
  static bool any(m a) { return _mm256_movemask_epi8(a) != 0; }
  static i select(m k, i a, i b) { return _mm256_blendv_epi8(b, a, k); }
  /// a where s is negative, else b.
  static i select_negative(i s, i a, i b) { return bits(_mm256_blendv_pd(value(b), value(a), value(s))); }
  static i keep(m k, i a) { return and_(k, a); }

  template <class Code>
  static i load_codes(const Code* p) {
    return _mm256_set_epi64x(static_cast<long long>(p[3]), static_cast<long long>(p[2]),
                             static_cast<long long>(p[1]), static_cast<long long>(p[0]));
  }
  static void store_codes(std::uint64_t* p, i v) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }
  template <class Code>
  static void store_codes(Code* p, i v) {
    std::uint64_t words[width];
    store_codes(words, v);
    for (std::size_t k = 0; k < width; ++k) p[k] = static_cast<Code>(words[k]);
  }
  /// Integers of magnitude below 2^51 in binary64, by the binade whose unit is 1.
  static f to_float(i a) {
    const f unit = all(6755399441055744.0);  // 1.5 * 2^52
    return sub(value(iadd(a, bits(unit))), unit);
  }

  static i words(std::uint32_t upper, std::uint32_t lower) { return all_bits(word{upper} << 32 | lower); }
  static i lane_numbers() { return _mm256_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3); }
};

}  // namespace bitshade::bulk_kernels::avx2
