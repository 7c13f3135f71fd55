// The compiler's _Float16 (clang before 17 calls the storage type __fp16 without AVX-512 FP16), compiled with F16C.
#include <bit>
#include <cmath>

#include "peers/peers.hpp"

namespace peers {
namespace {

using half = _Float16;

half load(std::uint16_t bits) { return std::bit_cast<half>(bits); }
std::uint16_t store(half x) { return std::bit_cast<std::uint16_t>(x); }

}  // namespace

void float16_round(const float* in, float* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = static_cast<float>(static_cast<half>(in[j]));
}
void float16_add(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = store(load(a[j]) + load(b[j]));
}
void float16_mul(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = store(load(a[j]) * load(b[j]));
}
void float16_div(const std::uint16_t* a, const std::uint16_t* b, std::uint16_t* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = store(load(a[j]) / load(b[j]));
}
void float16_sqrt(const std::uint16_t* a, const std::uint16_t*, std::uint16_t* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    out[j] = store(static_cast<half>(std::sqrt(static_cast<float>(load(a[j])))));
  }
}

}  // namespace peers
