// The texture reader on any bytes: a whole texture that prints back the same, or one sentence.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/error.hpp"
#include "io/texture_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bitshade;
  try {
    const auto textures = parse_textures({reinterpret_cast<const char*>(data), size}, "input");
    for (const named_texture& t : textures) {
      const std::string text =
          "texture,format,level,width,height,texels_hex_row_major\n" + print_texture(t);
      const auto again = parse_textures(text, "printed");
      if (again.size() != 1 || again[0].levels != t.levels || again[0].format != t.format)
        std::abort();
    }
  } catch (const failure& e) {
    if (std::string_view(e.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
