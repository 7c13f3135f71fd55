// The reader of coordinates on any bytes: finite lookups, or one sentence.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/error.hpp"
#include "io/texture_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bitshade;
  try {
    const coordinates read =
        parse_coordinates({reinterpret_cast<const char*>(data), size}, "input");
    if (read.lookups.empty()) std::abort();
    for (const auto& at : read.lookups)
      if (!std::isfinite(at.u) || !std::isfinite(at.v) || !std::isfinite(at.lod)) std::abort();
  } catch (const failure& e) {
    if (std::string_view(e.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
