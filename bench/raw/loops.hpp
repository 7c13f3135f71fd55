// The loops to be measured against, by hand, one file an instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raw_avx2 {
void half_round(const float* in, float* out, std::size_t n);
void unorm16_twice(const float* in, float* out, std::size_t n);
void half_add(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_mul(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_div(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_sqrt(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
/// Rounds twice: in binary32, then to half.
void half_fma_twice(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, std::uint16_t* out,
                    std::size_t n);
}  // namespace raw_avx2

namespace raw_avx512 {
void half_round(const float* in, float* out, std::size_t n);
void unorm16_twice(const float* in, float* out, std::size_t n);
void half_add(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_mul(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_div(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_sqrt(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void half_fma_twice(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, std::uint16_t* out,
                    std::size_t n);
}  // namespace raw_avx512
