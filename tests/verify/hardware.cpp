// Compiled with -mf16c: it includes nothing that other sources instantiate as well.
#include "hardware.hpp"

#include <cpuid.h>
#include <immintrin.h>

namespace hardware {
namespace {

enum class op { add, subtract, multiply, divide };

template <op Operation>
void pairs(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  const __m128 x = _mm_cvtph_ps(_mm_set1_epi16(static_cast<short>(a)));
  for (std::size_t i = 0; i < n; i += 4) {
    const __m128 y = _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(b + i)));
    __m128 z{};
    switch (Operation) {
      case op::add: z = _mm_add_ps(x, y); break;
      case op::subtract: z = _mm_sub_ps(x, y); break;
      case op::multiply: z = _mm_mul_ps(x, y); break;
      case op::divide: z = _mm_div_ps(x, y); break;
    }
    const __m128 nan = _mm_cmpunord_ps(z, z);
    z = _mm_or_ps(_mm_andnot_ps(nan, z), _mm_and_ps(nan, _mm_castsi128_ps(_mm_set1_epi32(0x7fc00000))));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(out + i), _mm_cvtps_ph(z, _MM_FROUND_TO_NEAREST_INT));
  }
}

template <int Direction>
void convert(const float* in, std::uint16_t* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 4)
    _mm_storel_epi64(reinterpret_cast<__m128i*>(out + i), _mm_cvtps_ph(_mm_loadu_ps(in + i), Direction));
}

}  // namespace

bool has_f16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}

void add(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) { pairs<op::add>(a, b, out, n); }
void subtract(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs<op::subtract>(a, b, out, n);
}
void multiply(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs<op::multiply>(a, b, out, n);
}
void divide(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  pairs<op::divide>(a, b, out, n);
}

void to_nearest_even(const float* in, std::uint16_t* out, std::size_t n) { convert<_MM_FROUND_TO_NEAREST_INT>(in, out, n); }
void toward_zero(const float* in, std::uint16_t* out, std::size_t n) { convert<_MM_FROUND_TO_ZERO>(in, out, n); }
void up(const float* in, std::uint16_t* out, std::size_t n) { convert<_MM_FROUND_TO_POS_INF>(in, out, n); }
void down(const float* in, std::uint16_t* out, std::size_t n) { convert<_MM_FROUND_TO_NEG_INF>(in, out, n); }

}  // namespace hardware
