// A rectangle of texels: row-major, channels interleaved.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bitshade {

/// A width x height image of `channels` values a texel.
///
/// Shapes   texels.size() == width * height * channels; row-major, channels interleaved.
/// Units    T's; a texel's centre lies at (x + 1/2, y + 1/2) in texel space.
/// Failure  none; x and y are the caller's promise (address modes live in address.hpp).
template <class T>
struct image {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<T> texels;

  image() = default;
  image(int w, int h, int c = 1, T fill = T{})
      : width(w),
        height(h),
        channels(c),
        texels(
            static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c),
            fill) {}

  std::size_t offset(int x, int y, int c = 0) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels) +
           static_cast<std::size_t>(c);
  }
  T& at(int x, int y, int c = 0) { return texels[offset(x, y, c)]; }
  const T& at(int x, int y, int c = 0) const { return texels[offset(x, y, c)]; }
  std::span<T> row(int y) { return {texels.data() + offset(0, y), row_size()}; }
  std::span<const T> row(int y) const { return {texels.data() + offset(0, y), row_size()}; }
  std::size_t row_size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }

  friend bool operator==(const image&, const image&) = default;
};

}  // namespace bitshade
