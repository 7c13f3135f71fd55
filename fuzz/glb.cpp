// Any bytes as a .glb mesh: finite triangles or a sentence, never a crash.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/error.hpp"
#include "scene/mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto mesh = bitshade::decode_mesh({data, size}, "input.glb", "glb");
    if (mesh.triangles.empty()) std::abort();
    for (const auto& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        if (t[k] >= mesh.vertices.size() || !std::isfinite(mesh.vertices[t[k]].x)) std::abort();
      }
    }
  } catch (const bitshade::failure&) {
  }
  return 0;
}
