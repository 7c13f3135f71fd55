#include "raw/sampling.hpp"

#include <immintrin.h>

namespace raw_avx512 {
namespace {

struct taps {
  __m512 weight;
  __m512i index;
};

taps along(const float* p, int size) {
  const __m512 length = _mm512_set1_ps(static_cast<float>(size));
  const __m512 x = _mm512_sub_ps(_mm512_mul_ps(_mm512_loadu_ps(p), length), _mm512_set1_ps(0.5f));
  const __m512i last = _mm512_set1_epi32(size - 2);
  __m512i i = _mm512_cvt_roundps_epi32(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  i = _mm512_min_epi32(_mm512_max_epi32(i, _mm512_setzero_si512()), last);
  const __m512 w = _mm512_sub_ps(x, _mm512_cvtepi32_ps(i));
  return {_mm512_min_ps(_mm512_max_ps(w, _mm512_setzero_ps()), _mm512_set1_ps(1)), i};
}

__m512 lerp(__m512 a, __m512 b, __m512 f) {
  return _mm512_add_ps(a, _mm512_mul_ps(f, _mm512_sub_ps(b, a)));
}

__m512 four(const float* p, const int* at) {
  __m512 x = _mm512_castps128_ps512(_mm_loadu_ps(p + at[0]));
  x = _mm512_insertf32x4(x, _mm_loadu_ps(p + at[2]), 1);
  x = _mm512_insertf32x4(x, _mm_loadu_ps(p + at[4]), 2);
  return _mm512_insertf32x4(x, _mm_loadu_ps(p + at[6]), 3);
}

}  // namespace

void bilinear_rg(const float* texels, int width, int height, const float* u, const float* v,
                 float* out, std::size_t n) {
  const float* below = texels + 2 * static_cast<std::size_t>(width);
  const __m512i stride = _mm512_set1_epi32(width);
  const __m512i twice[2] = {
      _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0),
      _mm512_set_epi32(15, 15, 14, 14, 13, 13, 12, 12, 11, 11, 10, 10, 9, 9, 8, 8)};
  for (std::size_t i = 0; i < n; i += 16) {
    const taps x = along(u + i, width), y = along(v + i, height);
    const __m512i texel = _mm512_add_epi32(_mm512_mullo_epi32(y.index, stride), x.index);
    alignas(64) int at[16];
    _mm512_store_si512(at, _mm512_slli_epi32(texel, 1));
    for (int h = 0; h < 2; ++h) {
      const __m512 u0 = four(texels, at + 8 * h), u1 = four(texels, at + 8 * h + 1);
      const __m512 l0 = four(below, at + 8 * h), l1 = four(below, at + 8 * h + 1);
      const __m512 fx = _mm512_permutexvar_ps(twice[h], x.weight);
      const __m512 fy = _mm512_permutexvar_ps(twice[h], y.weight);
      const __m512 upper = lerp(_mm512_shuffle_ps(u0, u1, 0x44), _mm512_shuffle_ps(u0, u1, 0xee), fx);
      const __m512 lower = lerp(_mm512_shuffle_ps(l0, l1, 0x44), _mm512_shuffle_ps(l0, l1, 0xee), fx);
      _mm512_storeu_ps(out + 2 * i + 16 * static_cast<std::size_t>(h), lerp(upper, lower, fy));
    }
  }
}

void bilinear_rg_gathers(const float* texels, int width, int height, const float* u,
                         const float* v, float* out, std::size_t n) {
  const __m512i stride = _mm512_set1_epi32(width);
  const __m512i first = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
  const __m512i second =
      _mm512_set_epi32(31, 15, 30, 14, 29, 13, 28, 12, 27, 11, 26, 10, 25, 9, 24, 8);
  for (std::size_t i = 0; i < n; i += 16) {
    const taps x = along(u + i, width), y = along(v + i, height);
    const __m512i at = _mm512_slli_epi32(
        _mm512_add_epi32(_mm512_mullo_epi32(y.index, stride), x.index), 1);
    const auto channel = [&](int c) {
      const auto tap = [&](int dx, int dy) {
        return _mm512_i32gather_ps(at, texels + 2 * (dx + dy * width) + c, 4);
      };
      return lerp(lerp(tap(0, 0), tap(1, 0), x.weight), lerp(tap(0, 1), tap(1, 1), x.weight),
                  y.weight);
    };
    const __m512 r = channel(0), g = channel(1);
    _mm512_storeu_ps(out + 2 * i, _mm512_permutex2var_ps(r, first, g));
    _mm512_storeu_ps(out + 2 * i + 16, _mm512_permutex2var_ps(r, second, g));
  }
}

}  // namespace raw_avx512
