#include "bulk/lanes_sse2.hpp"
#include "texture/blur_tiles.hpp"

namespace bitshade::texture_kernels::sse2 {
namespace {

struct lanes : bulk_kernels::sse2::lanes32 {
  static constexpr bool slides = false;
  static void stream(float* p, f x) { _mm_stream_ps(p, x); }
  static void fence() { _mm_sfence(); }
};

}  // namespace

const kernels all{blur_in<lanes>};

}  // namespace bitshade::texture_kernels::sse2
