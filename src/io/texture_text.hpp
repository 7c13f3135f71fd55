// Textures and coordinates as text: what an engineer's own device can be made to print.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bitshade/texture/lod.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade {

/// One texture of a file.
struct named_texture {
  std::string name;
  texel_format format;
  std::vector<coded_image> levels;
};

/// "RG16_UNORM", "R8_SNORM", "RGBA16_FLOAT", "R11G11B10_FLOAT" in any case, or "RG:e5m7": the
/// format. Throws failure, starting with `place`, for anything else.
texel_format parse_texel_format(std::string_view name, const std::string& place);
std::string name_of(const texel_format& format);

/// A channel's raw word in hexadecimal, as many digits as its bits need.
std::string raw_word(const texel_format& format, std::size_t channel, std::uint64_t word);

/// Textures in the layout
///
///   texture,format,level,width,height,texels_hex_row_major
///
/// one line a level, texels separated by blanks, channels by '/', raw storage words in
/// hexadecimal; levels of a texture in order from 0, their sizes halving.
///
/// Failure  throws failure with the file's name, the line and the cure.
std::vector<named_texture> parse_textures(std::string_view text, const std::string& file);

/// The same layout, one line a level.
std::string print_texture(const named_texture& texture);

/// A list of lookups, all of one kind.
struct coordinates {
  bool gradient = false;  ///< u,v,dudx,dvdx,dudy,dvdy instead of u,v,lod
  bool named = false;     ///< the first line named the columns
  struct lookup {
    float u = 0, v = 0, lod = 0;
    gradients g;
  };
  std::vector<lookup> lookups;
};

/// Lines "u,v,lod" or "u,v,dudx,dvdx,dudy,dvdy"; the first line may name the columns, and columns
/// behind them are results, which are left alone. Numbers are decimal or C99 hexadecimal.
///
/// Failure  throws failure with the file's name, the line and the cure.
coordinates parse_coordinates(std::string_view text, const std::string& file);

}  // namespace bitshade
