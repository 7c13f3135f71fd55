#include "bulk/lanes_avx512.hpp"
#include "texture/blur_tiles.hpp"
#include "texture/mip_rows.hpp"
#include "texture/sat_bands.hpp"

namespace bitshade::texture_kernels::avx512 {
namespace {

struct lanes : bulk_kernels::avx512::lanes32 {
  static constexpr bool slides = true;

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
};

}  // namespace

const kernels all{blur_in<lanes>, mip_in<lanes>, sat_in<lanes>};

}  // namespace bitshade::texture_kernels::avx512
