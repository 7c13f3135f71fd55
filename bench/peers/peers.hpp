// Other people's half: binary32 -> half -> binary32, and sums of arrays.
#pragma once

#include <cstddef>
#include <cstdint>

namespace peers {

using rounder = void (*)(const float* in, float* out, std::size_t n);

void float16_round(const float* in, float* out, std::size_t n);
void eigen_round(const float* in, float* out, std::size_t n);
void imath_round(const float* in, float* out, std::size_t n);
void boost_round(const float* in, float* out, std::size_t n);  ///< cpp_bin_float: no subnormals of half's
void by_mpfr_round(const float* in, float* out, std::size_t n);

void float16_add(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void float16_mul(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void float16_div(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void float16_sqrt(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);

}  // namespace peers
