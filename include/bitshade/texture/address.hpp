// What lies beyond an image's edge.
#pragma once

#include <cmath>

namespace bitshade {

enum class address { clamp, repeat, mirror, border };

/// The texel that an index outside the image means.
///
///   clamp: the nearest edge; repeat: i mod size; mirror: 0 1 .. n-1 n-1 .. 1 0 0 1 ..
///   border: -1 for every index outside, to be read as the border's value
///
/// Shapes   any int in, [0, size) or -1 out; size >= 1.
/// Failure  none.
/// Source   [Vulkan] "Wrapping Operation".
constexpr int wrap(int i, int size, address mode) {
  if (i >= 0 && i < size) return i;
  switch (mode) {
    case address::clamp:
      return i < 0 ? 0 : size - 1;
    case address::repeat: {
      const int rest = i % size;
      return rest < 0 ? rest + size : rest;
    }
    case address::mirror: {
      // Reflecting -1 - i = ~i needs no wider integer, and i mod 2n = (i mod n) + n * (i / n odd).
      const int j = i < 0 ? ~i : i;
      const int rest = j % size;
      return (j / size) % 2 == 0 ? rest : size - 1 - rest;
    }
    case address::border:
      return -1;
  }
  return -1;
}

/// The same place in a period around 0, so that its index fits an int however far out u lies.
///
///   repeat: u - floor u from 1 on; mirror: u - 2 floor(u/2) from 2 on; else u itself
///
/// Shapes   F: a floating type; u and its place are in units of the image.
/// Error    none: from 1 on, u's own grid is coarse enough for the difference.
/// Failure  none: what is not finite comes back as NaN or as it is.
template <class F>
F within_period(F u, address mode) {
  const F period = mode == address::repeat ? F(1) : F(2);
  if ((mode != address::repeat && mode != address::mirror) || std::fabs(u) < period) return u;
  return u - period * std::floor(u / period);
}

}  // namespace bitshade
