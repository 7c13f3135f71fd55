// Branches as values: what a SIMD pack can do too.
#pragma once

namespace bitshade {

/// mask ? a : b, with both sides evaluated. Packs overload it for their own masks (pack.hpp).
template <class T>
constexpr T select(bool mask, const T& a, const T& b) {
  return mask ? a : b;
}

}  // namespace bitshade
