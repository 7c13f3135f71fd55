#include "bulk/lanes_avx512.hpp"
#include "texture/blur_tiles.hpp"

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
};

}  // namespace

const kernels all{blur_in<lanes>};

}  // namespace bitshade::texture_kernels::avx512
