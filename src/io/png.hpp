// PNG through libpng: pictures out, 16-bit depth maps in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bitshade/texture/image.hpp"

namespace bitshade {

/// The bytes of a PNG file: grey, grey + alpha, RGB or RGBA by the image's 1 to 4 channels.
///
/// Failure  throws failure if the image is empty or has other channels.
std::vector<std::uint8_t> encode_png(const image<std::uint8_t>& picture);
std::vector<std::uint8_t> encode_png(const image<std::uint16_t>& picture);

/// encode_png, written whole or not at all (atomic_file.hpp).
void write_png(const std::filesystem::path& path, const image<std::uint8_t>& picture);
void write_png(const std::filesystem::path& path, const image<std::uint16_t>& picture);

/// What a PNG file holds, its stored codes unchanged (no gamma, no scaling).
struct png_contents {
  int bits = 0;  ///< per channel: 8 or 16 (1, 2 and 4 are widened to 8)
  image<std::uint16_t> codes;
};

/// Decodes a PNG from memory; `name` stands in the messages.
///
/// Failure  throws failure on anything that is not a whole, sane PNG.
png_contents decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace bitshade
