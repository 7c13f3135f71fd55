#include "command/texture_options.hpp"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_mips.hpp"
#include "bitshade/texture/presets.hpp"
#include "command/format_options.hpp"
#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {

filter_model choose_preset(const std::string& name) {
  if (const auto found = find_preset(name)) return *found;
  std::vector<std::string_view> known;
  for (const filter_model& m : presets) known.push_back(m.name);
  throw usage_error("--preset: no preset '" + name + "'; " + suggest(name, known));
}

filter_model choose_preset(const std::string& name, const texel_format& format) {
  bool bytes = true;
  for (int c = 0; c < format.channels; ++c)
    bytes = bytes && format.of[static_cast<std::size_t>(c)] == unorm_encoding(8);
  if (name == "llvmpipe" && bytes) return *find_preset("llvmpipe-r8");
  const filter_model found = choose_preset(name);
  if (found.order == accumulation::lerp_codes && !bytes)
    throw usage_error("--preset " + name + " filters 8-bit unorm alone; use llvmpipe");
  return found;
}

named_texture in_format(const filter_model& model, const named_texture& texture,
                        const std::string& name) {
  named_texture result{texture.name, {}, {}};
  const bool texel = name.starts_with('R');
  if (texel) {
    try {
      result.format = parse_texel_format(name, "--format: ");
    } catch (const failure& e) {
      throw usage_error(e.what());
    }
  } else {
    const format_choice chosen = choose_format(name);
    if (chosen.components.size() == 1)
      result.format = uniform_format(chosen.components[0], texture.format.channels);
    else
      result.format = r11g11b10_format();
  }
  if (result.format.channels != texture.format.channels)
    throw usage_error("--format " + name + " has " + std::to_string(result.format.channels) +
                      " channels, but '" + texture.name + "' has " +
                      std::to_string(texture.format.channels) + "; name a format of as many");
  filter_model plain = model;
  if (plain.texel == texel_rule::integers) plain.texel = texel_rule::reciprocal;
  for (const coded_image& level : texture.levels)
    result.levels.push_back(
        store(model, result.format, load_image<double>(plain, texture.format, level)));
  return result;
}

void complete_chain(const filter_model& model, named_texture& texture) {
  if (texture.levels.size() > 1) return;
  coded_image base = std::move(texture.levels.front());
  try {
    texture.levels =
        model.name == "exact"
            ? exact_mip_chain<exact_rational>(texture.format, std::move(base), model.mips)
            : device_mip_chain(model, texture.format, std::move(base));
  } catch (const std::invalid_argument& e) {
    throw refused_format(texture, e.what());
  }
}

failure refused_format(const named_texture& texture, const std::string& why) {
  return failure("texture '" + texture.name + "' is " + name_of(texture.format) + ", but " + why +
                 "; store it in a narrower one with --format");
}

namespace {

std::string levels_in_json(const named_texture& texture) {
  std::string out = "[";
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    const coded_image& in = texture.levels[level];
    const auto channels = static_cast<std::size_t>(in.channels);
    auto texels = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < in.texels.size(); ++i) {
      if (i % channels == 0) texels.push_back(nlohmann::ordered_json::array());
      texels.back().push_back("0x" + raw_word(texture.format, i % channels, in.texels[i]));
    }
    const nlohmann::ordered_json line{
        {"texture", texture.name}, {"format", name_of(texture.format)},
        {"level", level},          {"width", in.width},
        {"height", in.height},     {"texels", std::move(texels)}};
    out += (level == 0 ? "\n " : ",\n ") + line.dump();
  }
  return out + "\n]\n";
}

}  // namespace

void write_texture(const named_texture& texture, bool json, const std::string& file) {
  const std::string text =
      json ? levels_in_json(texture)
           : "texture,format,level,width,height,texels_hex_row_major\n" + print_texture(texture);
  if (file.empty())
    std::cout << text;
  else
    write_file(file, text);
}

}  // namespace bitshade::command
