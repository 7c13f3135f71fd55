#include "bulk/lanes_avx2.hpp"
#include "texture/blur_tiles.hpp"

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
};

}  // namespace

const kernels all{blur_in<lanes>};

}  // namespace bitshade::texture_kernels::avx2
