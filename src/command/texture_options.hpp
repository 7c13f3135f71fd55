// What sample, mipmap and convert share: presets, formats, textures from files.
#pragma once

#include <string>

#include "bitshade/texture/filter_model.hpp"
#include "io/error.hpp"
#include "io/texture_file.hpp"

namespace bitshade::command {

/// The preset of that name, whose loads and stores hold for any format.
/// Throws usage_error with the nearest known name.
filter_model choose_preset(const std::string& name);

/// The same for filtering textures of that format: llvmpipe filters 8-bit unorm in a way of its own,
/// so that llvmpipe means llvmpipe-r8 there, and llvmpipe-r8 is refused elsewhere.
filter_model choose_preset(const std::string& name, const texel_format& format);

/// The texture's values stored in another format, channel by channel, as the preset stores.
/// `name` is a format of 'bitshade formats' or a texture format such as RG16_UNORM.
/// Throws usage_error where there is none of that name or its channels are not the texture's.
named_texture in_format(const filter_model& model, const named_texture& texture,
                        const std::string& name);

/// Makes the chain of a texture that has but one level, as the preset makes it.
/// Throws failure where the preset takes no such format.
void complete_chain(const filter_model& model, named_texture& texture);

/// What to throw where a preset takes no such format, and why not.
failure refused_format(const named_texture& texture, const std::string& why);

/// The texture in its text layout, or as a JSON array of its levels, to a file or, where that has no
/// name, to standard output.
void write_texture(const named_texture& texture, bool json, const std::string& file);

}  // namespace bitshade::command
