// The lanes of AVX2 with the shuffles that images need. Included by their AVX2 kernels alone.
#pragma once

#include "bulk/lanes_avx2.hpp"

namespace bitshade::texture_kernels::avx2 {

struct lanes : bulk_kernels::avx2::lanes32 {
  static constexpr bool slides = false;  // what a slide costs here, a second read does as well
  static constexpr int blur_rows = 8;  ///< made at once
  static void stream(float* p, f x) { _mm256_stream_ps(p, x); }
  static void stream_words(std::uint16_t* p, __m128i x) {
    _mm_stream_si128(reinterpret_cast<__m128i*>(p), x);
  }
  static __m128i words(i x) { return narrow(x); }
  static void fence() { _mm_sfence(); }
  /// x is known here and not later: the compiler keeps to the order of the steps that lead to it.
  static void keep_here(f& x) { asm("" : "+x"(x)); }

  template <int Channels>
  static f lefts(f a, f b) { return in_order<Channels>(mixed_lefts<Channels>(a, b)); }
  template <int Channels>
  static f rights(f a, f b) { return in_order<Channels>(mixed_rights<Channels>(a, b)); }
  /// The same in an order of their own, which sums of them keep; and the sums' way back.
  template <int Channels>
  static f mixed_lefts(f a, f b) {
    if constexpr (Channels == 4) return _mm256_permute2f128_ps(a, b, 0x20);
    return Channels == 1 ? _mm256_shuffle_ps(a, b, 0x88) : pairs<0>(a, b);
  }
  template <int Channels>
  static f mixed_rights(f a, f b) {
    if constexpr (Channels == 4) return _mm256_permute2f128_ps(a, b, 0x31);
    return Channels == 1 ? _mm256_shuffle_ps(a, b, 0xdd) : pairs<15>(a, b);
  }
  template <int Channels>
  static f in_order(f mixed) {
    if constexpr (Channels == 4) return mixed;
    return value(_mm256_permute4x64_epi64(bits(mixed), 0xd8));
  }
  /// Halves of 128 bits: the first (0) or second (15) of each pair, a's and b's in turn.
  template <int Which>
  static f pairs(f a, f b) {
    return _mm256_castpd_ps(_mm256_shuffle_pd(_mm256_castps_pd(a), _mm256_castps_pd(b), Which));
  }

  static void transpose(f (&x)[8]) {
    f t[8];
    for (int k = 0; k < 8; k += 2) {
      t[k] = _mm256_unpacklo_ps(x[k], x[k + 1]);
      t[k + 1] = _mm256_unpackhi_ps(x[k], x[k + 1]);
    }
    for (int k = 0; k < 8; k += 4) {
      for (int j = 0; j < 2; ++j) {
        x[k + 2 * j] = pairs<0>(t[k + j], t[k + j + 2]);
        x[k + 2 * j + 1] = pairs<15>(t[k + j], t[k + j + 2]);
      }
    }
    for (int k = 0; k < 4; ++k) {
      t[k] = _mm256_permute2f128_ps(x[k], x[k + 4], 0x20);
      t[k + 4] = _mm256_permute2f128_ps(x[k], x[k + 4], 0x31);
    }
    for (int k = 0; k < 8; ++k) x[k] = t[k];
  }

  static constexpr bool samples = true;
  /// Vectors of samples located before the first is fetched. What a lookup's results wait for, from
  /// its coordinates on, is longer than the processor looks ahead.
  static constexpr std::size_t located_ahead = 32;
  using wide = bulk_kernels::avx2::lanes64;
  static f floor(f x) { return _mm256_floor_ps(x); }
  static i floor_to_int(f x) { return to_int(floor(x)); }
  static f nearest(f x) { return _mm256_round_ps(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
  static __m256d floor(__m256d x) { return _mm256_floor_pd(x); }
  static __m256d nearest(__m256d x) {
    return _mm256_round_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  }
  static bool all(m a) { return _mm256_movemask_ps(value(a)) == 0xff; }
  static f all(float x) { return lanes32::all(x); }
  static i imul(i a, i b) { return _mm256_mullo_epi32(a, b); }
  static void store_ints(int* p, i x) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x); }
  static i load_ints(const int* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }

  /// Lanes 0 0 1 1 .. of the lower (0) or upper (1) half.
  template <int Half>
  static f twice(f x) {
    const f half = _mm256_permute2f128_ps(x, x, Half == 0 ? 0x00 : 0x11);
    return _mm256_permutevar_ps(half, _mm256_set_epi32(3, 3, 2, 2, 1, 1, 0, 0));
  }
  /// Whole numbers of two vectors as integers; what is none, or too large, is negative.
  static i whole(__m256d low, __m256d high) {
    return _mm256_set_m128i(_mm256_cvttpd_epi32(high), _mm256_cvttpd_epi32(low));
  }
  template <int Half>
  static __m256d twice(__m256d x) {
    return _mm256_permute4x64_pd(x, Half == 0 ? 0x50 : 0xfa);
  }
  /// The same of four numbers in memory, which broadcasts them without a shuffle.
  template <int Half>
  static __m256d twice_at(const double* p) {
    const auto* half = reinterpret_cast<const __m128d*>(p + 2 * Half);
    return _mm256_permute_pd(_mm256_broadcast_pd(half), 0xc);
  }
  /// Of each 128 bits the first or second 64, a's then b's.
  static f low_pairs(f a, f b) { return pairs<0>(a, b); }
  static f high_pairs(f a, f b) { return pairs<15>(a, b); }

  /// Four values from each of the places at[0], at[2], ..
  static f quads(const float* p, const int* at) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p + at[0])),
                                _mm_loadu_ps(p + at[2]), 1);
  }
  static __m128i two_quads(const std::uint16_t* a, const std::uint16_t* b) {
    const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(a));
    const auto* second = reinterpret_cast<const double*>(b);
    return _mm_castpd_si128(_mm_loadh_pd(_mm_castsi128_pd(first), second));
  }
  static __m128i quads(const std::uint16_t* p, const int* at) {
    return two_quads(p + at[0], p + at[2]);
  }
  /// Four codes from each of the places at[0] .. at[3]: a sample's two texels side by side.
  static i couples_of_two(const std::uint16_t* p, const int* at) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(two_quads(p + at[0], p + at[1])),
                                   two_quads(p + at[2], p + at[3]), 1);
  }
  /// Of each four codes the first (0) or last (1) two, as integers of 32 bits.
  template <int Which>
  static i half_of_each(i codes) {
    constexpr char z = -128;  // makes a zero
    constexpr char k = Which == 0 ? 0 : 4;
    const i places = _mm256_setr_epi8(
        k, k + 1, z, z, k + 2, k + 3, z, z, k + 8, k + 9, z, z, k + 10, k + 11, z, z,  //
        k, k + 1, z, z, k + 2, k + 3, z, z, k + 8, k + 9, z, z, k + 10, k + 11, z, z);
    return _mm256_shuffle_epi8(codes, places);
  }
  static i widen(__m128i words) { return _mm256_cvtepu16_epi32(words); }
  /// Two values from each place: the lower (0) or upper (1) half of the places.
  template <int Half>
  static f couples(const float* p, i at) {
    const __m128i places = _mm256_extracti128_si256(at, Half);
    return value(_mm256_i32gather_epi64(reinterpret_cast<const long long*>(p), places, 4));
  }
  static i couples(const std::uint16_t* p, i at) {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(p), at, 2);
  }
};

}  // namespace bitshade::texture_kernels::avx2
