// Which blur's loop a job gets, for one instruction set.
#pragma once

#include "texture/blur_tiles.hpp"

namespace bitshade::texture_kernels {

/// unorm16, without limits where sums cannot pass 65535.5 / 65535 > 1 + 2^-17.
///
/// No weight below 0, their sum (as binary32 adds it) at most 1 + 2^-19, values in [0,1]: of 32
/// taps the products and both sums round by less than 66 * 2^-24, which leaves a sum below
/// (1 + 2^-19) (1 + 2^-17.95) < 1 + 2^-17.
template <class V>
bool unorm16_blur_in(const blur_job& job) {
  float sum = 0;
  bool within = job.border >= 0 && job.border <= 1 && job.taps <= 32;
  for (int k = 0; k < job.taps; ++k) {
    within = within && job.weights[k] >= 0;
    sum += job.weights[k];
  }
  if (within && sum <= 1 + 0x1p-19f)
    blur_tiles<V, unorm16_texels<V, false>>(job).run();
  else
    blur_tiles<V, unorm16_texels<V>>(job).run();
  return true;
}

/// The texels that a set of lanes can load and store.
template <class V>
bool blur_in(const blur_job& job) {
  if (job.kind == texels::binary32) {
    blur_tiles<V, native_texels<V>>(job).run();
    return true;
  }
  if constexpr (V::has_fma) {
    if (job.kind == texels::half)
      blur_tiles<V, half_texels<V>>(job).run();
    else
      return unorm16_blur_in<V>(job);
    return true;
  }
  return false;
}

}  // namespace bitshade::texture_kernels
