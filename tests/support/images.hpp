// Images to filter, and the first place where two differ.
#pragma once

#include <bit>
#include <cstdint>
#include <sstream>
#include <string>

#include "bitshade/texture/image.hpp"

namespace test_images {

using bitshade::image;

/// Values in [0,1) with runs of equal ones, and signed ones of any size where `wild`.
inline image<float> noise(int w, int h, int channels, std::uint32_t seed = 1, bool wild = false) {
  image<float> result(w, h, channels);
  for (float& t : result.texels) {
    seed = seed * 1664525u + 1013904223u;
    t = static_cast<float>(seed >> 8) * 0x1p-24f;
    if (!wild) continue;
    seed = seed * 1664525u + 1013904223u;
    const int exponent = static_cast<int>(seed >> 16) % 60 - 30;
    const float power = std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
    t = (seed & 1u) != 0 ? -t * power : t * power;
  }
  return result;
}

/// Where `got` differs from `expected`, bit by bit; empty where it does not.
template <class T>
std::string difference(const image<T>& got, const image<T>& expected) {
  const auto bits = [](T x) {
    if constexpr (sizeof(T) == 4)
      return std::bit_cast<std::uint32_t>(x);
    else
      return x;
  };
  std::ostringstream text;
  if (got.texels.size() != expected.texels.size()) return "the sizes differ";
  for (std::size_t i = 0; i < got.texels.size(); ++i) {
    if (bits(got.texels[i]) == bits(expected.texels[i])) continue;
    text << "value " << i << " of " << got.width << "x" << got.height << "x" << got.channels
         << ": 0x" << std::hex << bits(got.texels[i]) << " instead of 0x"
         << bits(expected.texels[i]);
    return text.str();
  }
  return {};
}

}  // namespace test_images
