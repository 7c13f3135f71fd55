// Bilinear sampling as one would write it by hand for one format: two channels, binary32, clamped.
#pragma once

#include <cstddef>

namespace raw_avx2 {
/// n a multiple of 8; the texture at least 2 x 2. Edges by a limited index and weight.
void bilinear_rg(const float* texels, int width, int height, const float* u, const float* v,
                 float* out, std::size_t n);
/// The same, each texel gathered by itself.
void bilinear_rg_gathers(const float* texels, int width, int height, const float* u,
                         const float* v, float* out, std::size_t n);
}  // namespace raw_avx2

namespace raw_avx512 {
/// n a multiple of 16; the texture at least 2 x 2. Edges by a limited index and weight.
void bilinear_rg(const float* texels, int width, int height, const float* u, const float* v,
                 float* out, std::size_t n);
/// The same, each texel gathered by itself.
void bilinear_rg_gathers(const float* texels, int width, int height, const float* u,
                         const float* v, float* out, std::size_t n);
}  // namespace raw_avx512
