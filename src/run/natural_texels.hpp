// A map whose texels really lie in memory as their format's bits: encoded when stored, decoded when
// loaded, as a device does it. For times; the bits are those of values rounded in place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/image.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// Binary32 where the storage has no code; else codes of 8, 16 or 32 bits.
class natural_texels {
 public:
  /// Whether texels of a format have a natural width in memory: 8, 16 or 32 bits, no rounding of
  /// binary64 arithmetic.
  static bool can_hold(const storage_format& storage);

  natural_texels(const storage_format& storage, int width, int height, int channels);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }

  /// Stores a row of width x channels values.
  void store(int y, std::span<const float> row);
  /// Both directions of a separable blur, stored between them.
  void blur(const kernel& weights, int threads);
  /// Loads whole texels: all channels of each, one after the other; a texel is y * width + x.
  void load(std::span<const std::uint32_t> texels, std::span<float> values) const;

 private:
  template <class Code>
  void store_in(image<Code>& to, int y, std::span<const float> row) const;
  template <class Code>
  void load_row(const image<Code>& from, int y, std::span<float> row) const;

  const storage_format& storage_;
  int width_, height_, channels_;
  std::variant<image<float>, image<std::uint8_t>, image<std::uint16_t>, image<std::uint32_t>> map_;
};

}  // namespace bitshade
