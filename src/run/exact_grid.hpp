// The grids that exact kernels count on, read from the data.
#pragma once

#include <bit>
#include <cstdint>

#include "bitshade/study/frame.hpp"

namespace bitshade {

/// The widest depth that binary32 can hold: every finite one is a multiple of 2^-149.
inline constexpr int any_depth_bits = 149;
/// Depths of 2^-8 and more are multiples of 2^-32: nearly every map.
inline constexpr int common_depth_bits = 32;

/// The smallest s with x a multiple of 2^-s; x in [0, 1].
inline int fraction_bits_of(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t fraction = bits & 0x7fffff;
  const int field = static_cast<int>(bits >> 23 & 0xff);
  const std::uint32_t significand = field == 0 ? fraction : fraction | 0x800000;
  if (significand == 0) return 0;
  const int lowest = (field == 0 ? 1 : field) - 150 + std::countr_zero(significand);
  return lowest < 0 ? -lowest : 0;
}

/// The depth bits that a frame's map and receivers need: common_depth_bits or any_depth_bits.
inline int depth_bits_of(const frame& scene) {
  const auto beyond = [](float x) { return fraction_bits_of(x) > common_depth_bits; };
  for (const float x : scene.depth.texels) {
    if (beyond(x)) return any_depth_bits;
  }
  for (const auto& [count, samples] : scene.samples) {
    for (const map_sample& s : samples) {
      for (const float x : s.depth.texels) {
        if (beyond(x)) return any_depth_bits;
      }
    }
  }
  for (const receiver& r : scene.receivers) {
    if (r.surface != 0 && beyond(r.t)) return any_depth_bits;
  }
  return common_depth_bits;
}

/// x * 2^bits as an integer; x is in [0, 2) and a multiple of 2^-bits, bits <= 62.
inline std::uint64_t on_grid(double x, int bits) {
  return static_cast<std::uint64_t>(x * static_cast<double>(std::uint64_t{1} << bits));
}

}  // namespace bitshade
