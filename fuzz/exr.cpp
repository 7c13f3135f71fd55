// Any bytes as a .exr depth map: an image or a sentence, never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/depth_file.hpp"
#include "io/error.hpp"

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
  return 0;
}
