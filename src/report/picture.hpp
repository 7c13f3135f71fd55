// Eight-bit pictures and their PNG bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bitshade {

using rgb = std::array<std::uint8_t, 3>;

/// Shapes   bytes.size() == width * height * channels, row-major. channels is 1 or 3; with one
///          channel the bytes are grey, or indices into the palette where there is one.
struct picture {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> bytes;
  std::vector<rgb> palette;

  picture() = default;
  picture(int w, int h, int c, std::uint8_t fill = 0)
      : width(w),
        height(h),
        channels(c),
        bytes(
            static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c),
            fill) {}
  std::uint8_t* at(int x, int y) {
    return bytes.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(channels);
  }
};

/// The bytes of a PNG file. The same picture gives the same bytes (with the same libpng and zlib).
/// Failure  throws `failure` where libpng refuses.
std::string encode_png(const picture& p);

/// Writes `text` (a–z, 0–9 and " .,-+=<>/%()") in letters of 5 x 7 pixels from (x, y), in channel
/// value or palette index `ink`; what falls outside is cut off.
void draw_text(picture& p, int x, int y, std::string_view text, std::uint8_t ink);

/// Width in pixels of what draw_text writes: six a letter.
int text_width(std::string_view text);

}  // namespace bitshade
