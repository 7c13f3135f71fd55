// Texel formats as OpenGL names and packs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "support/gl_functions.hpp"
#include "support/gl_renderer.hpp"

namespace bitshade::test {

using bytes = std::vector<unsigned char>;

struct gl_format {
  GLint internal;
  GLenum layout, type;
  std::size_t word;  ///< bytes of a word; 0 for packed texels
};

inline gl_format describe(const texel_format& format) {
  static constexpr GLenum layouts[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  const encoding& e = format.of[0];
  const auto c = static_cast<std::size_t>(format.channels - 1);
  if (format == r11g11b10_format())
    return {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 0};
  const auto pick = [&](GLint a, GLint b, GLint d, GLint f) {
    const GLint all[] = {a, b, d, f};
    return all[c];
  };
  if (e == unorm_encoding(8))
    return {pick(GL_R8, GL_RG8, GL_RGB8, GL_RGBA8), layouts[c], GL_UNSIGNED_BYTE, 1};
  if (e == unorm_encoding(16))
    return {pick(GL_R16, GL_RG16, GL_RGB16, GL_RGBA16), layouts[c], GL_UNSIGNED_SHORT, 2};
  if (e == snorm_encoding(16))
    return {pick(GL_R16_SNORM, GL_RG16_SNORM, GL_RGB16_SNORM, GL_RGBA16_SNORM), layouts[c],
            GL_SHORT, 2};
  if (e == binary16::value)
    return {pick(GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F), layouts[c], GL_HALF_FLOAT, 2};
  if (e == binary32::value)
    return {pick(GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F), layouts[c], GL_FLOAT, 4};
  throw std::runtime_error("the test renderer does not know this format");
}

inline bytes to_bytes(const texel_format& format, const coded_image& in) {
  const gl_format gl = describe(format);
  bytes out;
  for (std::size_t i = 0; i < in.texels.size();) {
    std::uint64_t word = in.texels[i];
    std::size_t size = gl.word;
    if (gl.word == 0) {
      word = in.texels[i] | in.texels[i + 1] << 11 | in.texels[i + 2] << 22;
      size = 4;
      i += 3;
    } else {
      ++i;
    }
    for (std::size_t b = 0; b < size; ++b)
      out.push_back(static_cast<unsigned char>(word >> (8 * b)));
  }
  return out;
}

inline coded_image from_bytes(const texel_format& format, int width, int height, const bytes& in) {
  const gl_format gl = describe(format);
  coded_image out(width, height, format.channels);
  const std::size_t size = gl.word == 0 ? 4 : gl.word;
  for (std::size_t i = 0, at = 0; i < out.texels.size(); at += size) {
    std::uint64_t word = 0;
    for (std::size_t b = 0; b < size; ++b) word |= std::uint64_t{in[at + b]} << (8 * b);
    if (gl.word == 0) {
      out.texels[i] = word & 2047;
      out.texels[i + 1] = word >> 11 & 2047;
      out.texels[i + 2] = word >> 22;
      i += 3;
    } else {
      out.texels[i++] = word;
    }
  }
  return out;
}

inline std::size_t texel_bytes(const texel_format& format) {
  const std::size_t word = describe(format).word;
  return word == 0 ? 4 : word * static_cast<std::size_t>(format.channels);
}

}  // namespace bitshade::test
