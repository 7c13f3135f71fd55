// What sample, mipmap and convert share: presets, formats, textures from files.
#pragma once

#include <string>

#include "bitshade/texture/filter_model.hpp"
#include "io/texture_file.hpp"

namespace bitshade::command {

/// The preset of that name for textures of that format: llvmpipe filters 8-bit unorm in a way of
/// its own, so that llvmpipe means llvmpipe-r8 there.
/// Throws usage_error with the nearest known name.
filter_model choose_preset(const std::string& name, const texel_format& format);

/// The texture's values stored in another format, channel by channel, as the preset stores.
/// `name` is a format of 'bitshade formats' or a texture format such as RG16_UNORM.
/// Throws usage_error where there is none of that name or its channels are not the texture's.
named_texture in_format(const filter_model& model, const named_texture& texture,
                        const std::string& name);

/// Makes the chain of a texture that has but one level, as the preset makes it.
void complete_chain(const filter_model& model, named_texture& texture);

/// The texture in its text layout, or as a JSON array of its levels, to a file or, where that has no
/// name, to standard output.
void write_texture(const named_texture& texture, bool json, const std::string& file);

}  // namespace bitshade::command
