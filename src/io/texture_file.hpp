// Textures from files: text, PNG and OpenEXR, by the name's ending.
#pragma once

#include <filesystem>
#include <string>

#include "io/texture_text.hpp"

namespace bitshade {

/// Reads one texture of a file.
///
///   .csv  the layout of texture_text.hpp; `name` picks a texture where there are several
///   .png  8- or 16-bit unorm codes, one to four channels, one level
///   .exr  half or float, channels R G B A (or Y, or Z, or the file's own in their order), one
///   level
///
/// Failure  throws failure with the file, the place and the cure; usage_error for a name that the
///          file does not have, with the nearest one.
named_texture read_texture(const std::filesystem::path& path, const std::string& name = "");

}  // namespace bitshade
