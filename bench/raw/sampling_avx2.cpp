#include <immintrin.h>

#include "raw/sampling.hpp"

namespace raw_avx2 {
namespace {

struct taps {
  __m256 weight;
  __m256i index;
};

taps along(const float* p, int size) {
  const __m256 length = _mm256_set1_ps(static_cast<float>(size));
  const __m256 x = _mm256_sub_ps(_mm256_mul_ps(_mm256_loadu_ps(p), length), _mm256_set1_ps(0.5f));
  const __m256i last = _mm256_set1_epi32(size - 2);
  __m256i i = _mm256_cvtps_epi32(_mm256_floor_ps(x));
  i = _mm256_min_epi32(_mm256_max_epi32(i, _mm256_setzero_si256()), last);
  const __m256 w = _mm256_sub_ps(x, _mm256_cvtepi32_ps(i));
  return {_mm256_min_ps(_mm256_max_ps(w, _mm256_setzero_ps()), _mm256_set1_ps(1)), i};
}

__m256 lerp(__m256 a, __m256 b, __m256 f) {
  return _mm256_add_ps(a, _mm256_mul_ps(f, _mm256_sub_ps(b, a)));
}

__m256 four(const float* p, const int* at) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p + at[0])),
                              _mm_loadu_ps(p + at[2]), 1);
}

}  // namespace

void bilinear_rg(const float* texels, int width, int height, const float* u, const float* v,
                 float* out, std::size_t n) {
  const float* below = texels + 2 * static_cast<std::size_t>(width);
  const __m256i stride = _mm256_set1_epi32(width);
  const __m256i twice[2] = {_mm256_set_epi32(3, 3, 2, 2, 1, 1, 0, 0),
                            _mm256_set_epi32(7, 7, 6, 6, 5, 5, 4, 4)};
  for (std::size_t i = 0; i < n; i += 8) {
    const taps x = along(u + i, width), y = along(v + i, height);
    const __m256i texel = _mm256_add_epi32(_mm256_mullo_epi32(y.index, stride), x.index);
    alignas(32) int at[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), _mm256_slli_epi32(texel, 1));
    for (int h = 0; h < 2; ++h) {
      const __m256 u0 = four(texels, at + 4 * h), u1 = four(texels, at + 4 * h + 1);
      const __m256 l0 = four(below, at + 4 * h), l1 = four(below, at + 4 * h + 1);
      const __m256 fx = _mm256_permutevar8x32_ps(x.weight, twice[h]);
      const __m256 fy = _mm256_permutevar8x32_ps(y.weight, twice[h]);
      const __m256 upper = lerp(_mm256_shuffle_ps(u0, u1, 0x44), _mm256_shuffle_ps(u0, u1, 0xee), fx);
      const __m256 lower = lerp(_mm256_shuffle_ps(l0, l1, 0x44), _mm256_shuffle_ps(l0, l1, 0xee), fx);
      _mm256_storeu_ps(out + 2 * i + 8 * static_cast<std::size_t>(h), lerp(upper, lower, fy));
    }
  }
}

void bilinear_rg_gathers(const float* texels, int width, int height, const float* u,
                         const float* v, float* out, std::size_t n) {
  const __m256i stride = _mm256_set1_epi32(width);
  for (std::size_t i = 0; i < n; i += 8) {
    const taps x = along(u + i, width), y = along(v + i, height);
    const __m256i at =
        _mm256_slli_epi32(_mm256_add_epi32(_mm256_mullo_epi32(y.index, stride), x.index), 1);
    const auto channel = [&](int c) {
      const auto tap = [&](int dx, int dy) {
        return _mm256_i32gather_ps(texels + 2 * (dx + dy * width) + c, at, 4);
      };
      return lerp(lerp(tap(0, 0), tap(1, 0), x.weight), lerp(tap(0, 1), tap(1, 1), x.weight),
                  y.weight);
    };
    const __m256 r = channel(0), g = channel(1);
    const __m256 low = _mm256_unpacklo_ps(r, g), high = _mm256_unpackhi_ps(r, g);
    _mm256_storeu_ps(out + 2 * i, _mm256_permute2f128_ps(low, high, 0x20));
    _mm256_storeu_ps(out + 2 * i + 8, _mm256_permute2f128_ps(low, high, 0x31));
  }
}

}  // namespace raw_avx2
