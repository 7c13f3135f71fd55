// F16C loops as one would write them by hand; n is a multiple of the vector's width.
#include "raw/loops.hpp"

#include <immintrin.h>

namespace raw_avx2 {
namespace {

constexpr std::size_t width = 8;
using vector = __m256;
using codes = __m128i;

vector load(const float* p) { return _mm256_loadu_ps(p); }
void store(float* p, vector v) { _mm256_storeu_ps(p, v); }
vector load(const std::uint16_t* p) { return _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const codes*>(p))); }
void store(std::uint16_t* p, vector v) {
  _mm_storeu_si128(reinterpret_cast<codes*>(p), _mm256_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
}

template <class F>
void pairs(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n, F f) {
  for (std::size_t j = 0; j < n; j += width) store(out + j, f(load(a + j), load(b + j)));
}

}  // namespace

void half_round(const float* in, float* out, std::size_t n) {
  for (std::size_t j = 0; j < n; j += width) {
    store(out + j, _mm256_cvtph_ps(_mm256_cvtps_ph(load(in + j), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)));
  }
}

void unorm16_twice(const float* in, float* out, std::size_t n) {
  const vector zero = _mm256_setzero_ps(), one = _mm256_set1_ps(1), scale = _mm256_set1_ps(65535);
  for (std::size_t j = 0; j < n; j += width) {
    const vector x = _mm256_min_ps(_mm256_max_ps(load(in + j), zero), one);
    const vector code = _mm256_round_ps(_mm256_mul_ps(x, scale), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    store(out + j, _mm256_div_ps(code, scale));
  }
}

void half_add(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs(a, b, out, n, [](vector x, vector y) { return _mm256_add_ps(x, y); });
}
void half_mul(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs(a, b, out, n, [](vector x, vector y) { return _mm256_mul_ps(x, y); });
}
void half_div(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs(a, b, out, n, [](vector x, vector y) { return _mm256_div_ps(x, y); });
}
void half_sqrt(const std::uint16_t* a, const std::uint16_t*, std::uint16_t* out, std::size_t n) {
  for (std::size_t j = 0; j < n; j += width) store(out + j, _mm256_sqrt_ps(load(a + j)));
}

void half_fma_twice(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, std::uint16_t* out,
                    std::size_t n) {
  for (std::size_t j = 0; j < n; j += width) {
    store(out + j, _mm256_fmadd_ps(load(a + j), load(b + j), load(c + j)));
  }
}

}  // namespace raw_avx2
