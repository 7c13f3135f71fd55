// The lanes of AVX-512 with the shuffles that images need. Included by their AVX-512 kernels alone.
#pragma once

#include "bulk/lanes_avx512.hpp"

namespace bitshade::texture_kernels::avx512 {

struct lanes : bulk_kernels::avx512::lanes32 {
  static constexpr bool slides = true;
  static constexpr int blur_rows = 4;  ///< made at once

  /// Lanes Count, Count + 1 .. of `low` followed by `high`.
  template <int Count>
  static f slide(f low, f high) {
    if constexpr (Count == 16) {
      return high;
    } else {
      return value(_mm512_alignr_epi32(bits(high), bits(low), Count));
    }
  }

  static void stream(float* p, f x) { _mm512_stream_ps(p, x); }
  static void stream_words(std::uint16_t* p, __m256i x) {
    _mm256_stream_si256(reinterpret_cast<__m256i*>(p), x);
  }
  static __m256i words(i x) { return _mm512_cvtepi32_epi16(x); }
  static void fence() { _mm_sfence(); }
  static void keep_here(f&) {}  // 32 registers: it may choose

  template <int Channels>
  static f lefts(f a, f b) {
    if constexpr (Channels == 4) return _mm512_shuffle_f32x4(a, b, 0x88);
    if constexpr (Channels == 2) {
      const i places = _mm512_set_epi64(14, 12, 10, 8, 6, 4, 2, 0);
      return value(_mm512_permutex2var_epi64(bits(a), places, bits(b)));
    }
    const i places =
        _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
    return _mm512_permutex2var_ps(a, places, b);
  }
  template <int Channels>
  static f rights(f a, f b) {
    if constexpr (Channels == 4) return _mm512_shuffle_f32x4(a, b, 0xdd);
    if constexpr (Channels == 2) {
      const i places = _mm512_set_epi64(15, 13, 11, 9, 7, 5, 3, 1);
      return value(_mm512_permutex2var_epi64(bits(a), places, bits(b)));
    }
    const i places =
        _mm512_set_epi32(31, 29, 27, 25, 23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1);
    return _mm512_permutex2var_ps(a, places, b);
  }

  template <int Channels>
  static f mixed_lefts(f a, f b) { return lefts<Channels>(a, b); }
  template <int Channels>
  static f mixed_rights(f a, f b) { return rights<Channels>(a, b); }
  template <int Channels>
  static f in_order(f x) { return x; }

  static void transpose(f (&x)[16]) {
    f t[16];
    for (int k = 0; k < 16; k += 2) {
      t[k] = _mm512_unpacklo_ps(x[k], x[k + 1]);
      t[k + 1] = _mm512_unpackhi_ps(x[k], x[k + 1]);
    }
    for (int k = 0; k < 16; k += 4) {
      for (int j = 0; j < 2; ++j) {
        x[k + 2 * j] = value(_mm512_unpacklo_epi64(bits(t[k + j]), bits(t[k + j + 2])));
        x[k + 2 * j + 1] = value(_mm512_unpackhi_epi64(bits(t[k + j]), bits(t[k + j + 2])));
      }
    }
    // x[4q + j]: rows 4q .. 4q + 3 at columns j, j + 4, j + 8, j + 12.
    for (int j = 0; j < 4; ++j) {
      t[j] = _mm512_shuffle_f32x4(x[j], x[4 + j], 0x88);
      t[4 + j] = _mm512_shuffle_f32x4(x[j], x[4 + j], 0xdd);
      t[8 + j] = _mm512_shuffle_f32x4(x[8 + j], x[12 + j], 0x88);
      t[12 + j] = _mm512_shuffle_f32x4(x[8 + j], x[12 + j], 0xdd);
    }
    for (int j = 0; j < 4; ++j) {
      x[j] = _mm512_shuffle_f32x4(t[j], t[8 + j], 0x88);
      x[8 + j] = _mm512_shuffle_f32x4(t[j], t[8 + j], 0xdd);
      x[4 + j] = _mm512_shuffle_f32x4(t[4 + j], t[12 + j], 0x88);
      x[12 + j] = _mm512_shuffle_f32x4(t[4 + j], t[12 + j], 0xdd);
    }
  }

  static constexpr bool samples = true;
  static constexpr std::size_t located_ahead = 1;
  using wide = bulk_kernels::avx512::lanes64;
  static f floor(f x) { return _mm512_floor_ps(x); }
  static i floor_to_int(f x) {
    return _mm512_cvt_roundps_epi32(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  }
  static m or_(m a, m b) { return _kor_mask16(a, b); }
  static i or_(i a, i b) { return lanes32::or_(a, b); }
  static f nearest(f x) {
    return _mm512_roundscale_ps(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  }
  static __m512d floor(__m512d x) { return _mm512_floor_pd(x); }
  static __m512d nearest(__m512d x) {
    return _mm512_roundscale_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  }
  static bool all(m a) { return a == 0xffff; }
  static f all(float x) { return lanes32::all(x); }
  static i imul(i a, i b) { return _mm512_mullo_epi32(a, b); }
  static void store_ints(int* p, i x) { _mm512_storeu_si512(p, x); }
  static i load_ints(const int* p) { return _mm512_loadu_si512(p); }

  /// Lanes 0 0 1 1 .. of the lower (0) or upper (1) half.
  template <int Half>
  static f twice(f x) {
    const i places = Half == 0 ? _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0)
                               : _mm512_set_epi32(15, 15, 14, 14, 13, 13, 12, 12, 11, 11, 10, 10,
                                                  9, 9, 8, 8);
    return _mm512_permutexvar_ps(places, x);
  }
  /// Whole numbers of two vectors as integers; what is none, or too large, is negative.
  static i whole(__m512d low, __m512d high) {
    return _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvttpd_epi32(low)),
                              _mm512_cvttpd_epi32(high), 1);
  }
  template <int Half>
  static __m512d twice(__m512d x) {
    const i places = Half == 0 ? _mm512_set_epi64(3, 3, 2, 2, 1, 1, 0, 0)
                               : _mm512_set_epi64(7, 7, 6, 6, 5, 5, 4, 4);
    return _mm512_permutexvar_pd(places, x);
  }
  /// Of each 128 bits the first or second 64, a's then b's.
  static f low_pairs(f a, f b) { return _mm512_shuffle_ps(a, b, 0x44); }
  static f high_pairs(f a, f b) { return _mm512_shuffle_ps(a, b, 0xee); }

  /// Four values from each of the places at[0], at[2], ..
  static f quads(const float* p, const int* at) {
    f x = _mm512_castps128_ps512(_mm_loadu_ps(p + at[0]));
    x = _mm512_insertf32x4(x, _mm_loadu_ps(p + at[2]), 1);
    x = _mm512_insertf32x4(x, _mm_loadu_ps(p + at[4]), 2);
    return _mm512_insertf32x4(x, _mm_loadu_ps(p + at[6]), 3);
  }
  static __m256i quads(const std::uint16_t* p, const int* at) {
    const auto two = [&](int k) {
      const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p + at[k]));
      const auto* second = reinterpret_cast<const double*>(p + at[k + 2]);
      return _mm_loadh_pd(_mm_castsi128_pd(first), second);
    };
    const __m128d low = two(0), high = two(4);
    return _mm256_castpd_si256(_mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1));
  }
  static i widen(__m256i words) { return _mm512_cvtepu16_epi32(words); }
  /// Two values from each place: the lower (0) or upper (1) half of the places.
  template <int Half>
  static f couples(const float* p, i at) {
    return value(_mm512_i32gather_epi64(_mm512_extracti64x4_epi64(at, Half), p, 4));
  }
  static i couples(const std::uint16_t* p, i at) { return _mm512_i32gather_epi32(at, p, 2); }
};

}  // namespace bitshade::texture_kernels::avx512
