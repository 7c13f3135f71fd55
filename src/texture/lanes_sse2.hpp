// The lanes of SSE2 with the shuffles that images need. Included by their SSE2 kernels alone.
#pragma once

#include "bulk/lanes_sse2.hpp"

namespace bitshade::texture_kernels::sse2 {

struct lanes : bulk_kernels::sse2::lanes32 {
  static constexpr bool slides = false;
  static constexpr int blur_rows = 4;  ///< made at once
  static void stream(float* p, f x) { _mm_stream_ps(p, x); }
  static void fence() { _mm_sfence(); }
  static void keep_here(f&) {}

  template <int Channels>
  static f lefts(f a, f b) {
    if constexpr (Channels == 1) return _mm_shuffle_ps(a, b, 0x88);
    if constexpr (Channels == 2) return _mm_movelh_ps(a, b);
    return a;
  }
  template <int Channels>
  static f rights(f a, f b) {
    if constexpr (Channels == 1) return _mm_shuffle_ps(a, b, 0xdd);
    if constexpr (Channels == 2) return _mm_movehl_ps(b, a);
    return b;
  }

  template <int Channels>
  static f mixed_lefts(f a, f b) { return lefts<Channels>(a, b); }
  template <int Channels>
  static f mixed_rights(f a, f b) { return rights<Channels>(a, b); }
  template <int Channels>
  static f in_order(f x) { return x; }

  static void transpose(f (&x)[4]) { _MM_TRANSPOSE4_PS(x[0], x[1], x[2], x[3]); }

  static constexpr bool samples = false;
};

}  // namespace bitshade::texture_kernels::sse2
