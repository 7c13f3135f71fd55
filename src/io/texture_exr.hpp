// An OpenEXR file as a texture of half or float codes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/texture_text.hpp"

namespace bitshade {

/// Decodes the first one to four channels: R G B A, else Y, else Z, else the file's own in their
/// order; all half or all float.
///
/// Failure  throws failure on anything that is not a whole, sane file of at most 65,536 a side.
named_texture decode_exr_texture(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace bitshade
