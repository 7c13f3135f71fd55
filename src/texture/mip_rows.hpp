// Means of 2 x 2 texels, a row at a time.
#pragma once

#include "texture/jobs.hpp"
#include "texture/texels.hpp"

namespace bitshade::texture_kernels {

template <class V, class Texels, int Channels>
void mip_rows(const mip_job& job) {
  using code = typename Texels::code;
  using f = typename V::f;
  const Texels texels;
  const std::size_t in_row = static_cast<std::size_t>(job.width) * Channels, n = in_row / 2;
  const f quarter = V::all(0.25f);
  const auto means = [&](const code* upper, const code* lower, code* out)
                         __attribute__((always_inline)) {
    const auto pairs = [&](const code* p) __attribute__((always_inline)) {
      const f a = texels.load(p), b = texels.load(p + V::width);
      return V::add(V::template mixed_lefts<Channels>(a, b),
                    V::template mixed_rights<Channels>(a, b));
    };
    const f sum = V::template in_order<Channels>(V::add(pairs(upper), pairs(lower)));
    texels.store(out, V::mul(sum, quarter));
  };
  for (int y = job.first; y < job.last; ++y) {
    const code* upper = static_cast<const code*>(job.in) + 2 * static_cast<std::size_t>(y) * in_row;
    const code* lower = upper + in_row;
    code* out = static_cast<code*>(job.out) + static_cast<std::size_t>(y) * n;
    std::size_t i = 0;
    for (; i + V::width <= n; i += V::width) {
      __builtin_prefetch(upper + 2 * i + 4096 / sizeof(code));
      __builtin_prefetch(lower + 2 * i + 4096 / sizeof(code));
      if constexpr (sizeof(code) == sizeof(float) && V::width == 16) {
        __builtin_prefetch(upper + 2 * i + 16 + 4096 / sizeof(code));
        __builtin_prefetch(lower + 2 * i + 16 + 4096 / sizeof(code));
      }
      means(upper + 2 * i, lower + 2 * i, out + i);
    }
    if (i == n) continue;
    code last[3][2 * V::width] = {};
    for (std::size_t k = 0; k < 2 * (n - i); ++k) {
      last[0][k] = upper[2 * i + k];
      last[1][k] = lower[2 * i + k];
    }
    means(last[0], last[1], last[2]);
    for (std::size_t k = 0; i + k < n; ++k) out[i + k] = last[2][k];
  }
}

template <class V, class Texels>
bool mip_of(const mip_job& job) {
  switch (job.channels) {
    case 1:
      mip_rows<V, Texels, 1>(job);
      return true;
    case 2:
      mip_rows<V, Texels, 2>(job);
      return true;
    case 4:
      mip_rows<V, Texels, 4>(job);
      return true;
    default:
      return false;
  }
}

template <class V>
bool mip_in(const mip_job& job) {
  if (job.kind == texels::binary32) return mip_of<V, native_texels<V>>(job);
  if constexpr (V::has_fma) {
    if (job.kind == texels::half) return mip_of<V, half_texels<V>>(job);
    return mip_of<V, unorm16_texels<V, false>>(job);  // a mean of numbers in [0,1] is another
  }
  return false;
}

}  // namespace bitshade::texture_kernels
