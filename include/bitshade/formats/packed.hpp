// Three unsigned floats in 32 bits: the render target B10G11R11_UFLOAT, R11G11B10_FLOAT.
#pragma once

#include <array>

#include "bitshade/formats/decode.hpp"

namespace bitshade {

/// What stands in a packed word, lowest bits first. Source [Vulkan] "unsigned 11-bit floating-point numbers".
struct r11g11b10 {
  static constexpr std::array<encoding, 3> components{unsigned_binary_encoding(5, 6), unsigned_binary_encoding(5, 6),
                                                      unsigned_binary_encoding(5, 5)};
  static constexpr std::array<int, 3> position{0, 11, 22};
};

/// Red, green and blue, each rounded once; negative numbers become 0, as the specifications say.
constexpr std::uint32_t encode_r11g11b10(const std::array<double, 3>& rgb, const rules& r = {},
                                         const std::array<std::uint64_t, 3>& random = {}) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 3; ++i)
    word |= static_cast<std::uint32_t>(encode(r11g11b10::components[i], rgb[i], r, random[i]))
            << r11g11b10::position[i];
  return word;
}

constexpr std::array<double, 3> decode_r11g11b10(std::uint32_t word, const rules& r = {}) {
  std::array<double, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = decode(r11g11b10::components[i], word >> r11g11b10::position[i], r);
  return rgb;
}

}  // namespace bitshade
