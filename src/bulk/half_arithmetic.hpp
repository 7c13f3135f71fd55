// Loops over binary16 codes for one instruction set; the processor must keep subnormals and round to nearest, for fma
// toward zero.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bitshade::bulk_kernels {

enum class half_operation : std::uint8_t { add, subtract, multiply, divide, sqrt, fma };

/// Operands that an operation does not have are null.
struct half_operands {
  const std::uint16_t* a;
  const std::uint16_t* b;
  const std::uint16_t* c;
  std::uint16_t* out;
};

template <class V, half_operation Operation>
[[gnu::always_inline]] inline typename V::f half_result(typename V::f a, typename V::f b, typename V::f c) {
  if constexpr (Operation == half_operation::add) return V::add(a, b);
  if constexpr (Operation == half_operation::subtract) return V::sub(a, b);
  if constexpr (Operation == half_operation::multiply) return V::mul(a, b);
  if constexpr (Operation == half_operation::divide) return V::div(a, b);
  if constexpr (Operation == half_operation::sqrt) return V::sqrt(a);
  // The product of two halves is exact in binary32.
  if constexpr (Operation == half_operation::fma) return V::fma_to_odd(a, b, c);
}

template <class V, half_operation Operation>
void half_loop(const half_operands& o, std::size_t n) {
  constexpr std::size_t width = V::width;
  constexpr bool two = Operation != half_operation::sqrt, three = Operation == half_operation::fma;
  const auto step = [](const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, std::uint16_t* out) {
    const auto x = V::from_half(V::load_half(a));
    const auto y = two ? V::from_half(V::load_half(b)) : x;
    const auto z = three ? V::from_half(V::load_half(c)) : x;
    const auto r = half_result<V, Operation>(x, y, z);
    const auto one_nan = V::select(V::nan(r), V::all_bits(0x7fc00000u), V::bits(r));
    V::store_half(out, V::template to_half<0>(V::value(one_nan)));
  };
  std::size_t j = 0;
  for (; j + width <= n; j += width) step(o.a + j, two ? o.b + j : nullptr, three ? o.c + j : nullptr, o.out + j);
  if (j == n) return;
  std::uint16_t a[width] = {}, b[width] = {}, c[width] = {}, out[width];
  for (std::size_t k = 0; j + k < n; ++k) {
    a[k] = o.a[j + k];
    if (two) b[k] = o.b[j + k];
    if (three) c[k] = o.c[j + k];
  }
  step(a, b, c, out);
  for (std::size_t k = 0; j + k < n; ++k) o.out[j + k] = out[k];
}

template <class V>
void half_loops(half_operation what, const half_operands& o, std::size_t n) {
  switch (what) {
    case half_operation::add: return half_loop<V, half_operation::add>(o, n);
    case half_operation::subtract: return half_loop<V, half_operation::subtract>(o, n);
    case half_operation::multiply: return half_loop<V, half_operation::multiply>(o, n);
    case half_operation::divide: return half_loop<V, half_operation::divide>(o, n);
    case half_operation::sqrt: return half_loop<V, half_operation::sqrt>(o, n);
    case half_operation::fma: return half_loop<V, half_operation::fma>(o, n);
  }
}

namespace avx2 {
void half_arithmetic(half_operation what, const half_operands& o, std::size_t n);
}
namespace avx512 {
void half_arithmetic(half_operation what, const half_operands& o, std::size_t n);
}

}  // namespace bitshade::bulk_kernels
