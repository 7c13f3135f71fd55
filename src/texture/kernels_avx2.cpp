#include "bulk/lanes_avx2.hpp"
#include "texture/blur_tiles.hpp"
#include "texture/mip_rows.hpp"
#include "texture/sat_bands.hpp"

namespace bitshade::texture_kernels::avx2 {
namespace {

struct lanes : bulk_kernels::avx2::lanes32 {
  static constexpr bool slides = false;  // what a slide costs here, a second read does as well
  static void stream(float* p, f x) { _mm256_stream_ps(p, x); }
  static void stream_words(std::uint16_t* p, __m128i x) {
    _mm_stream_si128(reinterpret_cast<__m128i*>(p), x);
  }
  static __m128i words(i x) { return narrow(x); }
  static void fence() { _mm_sfence(); }

  template <int Channels>
  static f lefts(f a, f b) {
    if constexpr (Channels == 4) return _mm256_permute2f128_ps(a, b, 0x20);
    const f mixed = Channels == 1 ? _mm256_shuffle_ps(a, b, 0x88) : pairs<0>(a, b);
    return value(_mm256_permute4x64_epi64(bits(mixed), 0xd8));
  }
  template <int Channels>
  static f rights(f a, f b) {
    if constexpr (Channels == 4) return _mm256_permute2f128_ps(a, b, 0x31);
    const f mixed = Channels == 1 ? _mm256_shuffle_ps(a, b, 0xdd) : pairs<15>(a, b);
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
};

}  // namespace

const kernels all{blur_in<lanes>, mip_in<lanes>, sat_in<lanes>};

}  // namespace bitshade::texture_kernels::avx2
