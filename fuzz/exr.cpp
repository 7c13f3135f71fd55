// Any bytes as a .exr depth map, and as a texture: an image or a sentence, never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/texture_exr.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto read = bitshade::decode_exr({data, size}, "input.exr", "");
    const auto& image = read.values;
    if (image.width < 1 || image.height < 1 ||
        image.texels.size() !=
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
      std::abort();  // an image that contradicts itself
    }
  } catch (const bitshade::failure&) {
  } catch (const bitshade::usage_error&) {
  }
  try {
    const auto read = bitshade::decode_exr_texture({data, size}, "input.exr");
    const auto& image = read.levels.at(0);
    if (image.width < 1 || image.height < 1 || image.channels != read.format.channels ||
        image.texels.size() != static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height) *
                                   static_cast<std::size_t>(image.channels)) {
      std::abort();
    }
  } catch (const bitshade::failure& e) {
    if (std::string_view(e.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
