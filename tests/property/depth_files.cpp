// Every file format gives back what it was given, and every part of a file that is not all of it is
// refused in words.
#include <rapidcheck.h>

#include <bit>
#include <cmath>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/png.hpp"
#include "scene/mesh.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

struct format {
  const char* name;
  stored_depths (*decode)(std::span<const std::uint8_t>, const std::string&, const std::string&);
  std::vector<std::uint8_t> (*encode)(const image<float>&);
};

constexpr format formats[] = {{"exr", decode_exr, encode_exr},
                              {"png", decode_depth_png, encode_depth_png},
                              {"pfm", decode_pfm, encode_pfm},
                              {"npy", decode_npy, encode_npy}};

/// Depths of every magnitude, subnormals included: bit patterns up to 1's.
rc::Gen<image<float>> depth_maps() {
  return rc::gen::exec([] {
    image<float> out(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 20));
    for (float& d : out.texels) d = std::bit_cast<float>(*rc::gen::inRange(0u, 0x3F800001u));
    return out;
  });
}

bool refused(const format& f, std::span<const std::uint8_t> bytes) {
  try {
    f.decode(bytes, "part", "");
    return false;
  } catch (const failure&) {
    return true;
  }
}

}  // namespace

TEST_CASE("a depth map written and read is the same map") {
  for (const format& f : formats) {
    if (f.name == std::string("png")) continue;
    CHECK(rc::check(std::string(f.name) + ": the same bits", [&] {
      const image<float> depths = *depth_maps();
      const stored_depths back = f.decode(f.encode(depths), "map", "");
      RC_ASSERT(back.values.width == depths.width);
      RC_ASSERT(back.values.height == depths.height);
      for (std::size_t i = 0; i < depths.texels.size(); ++i) {
        RC_ASSERT(back.values.texels[i] == static_cast<double>(depths.texels[i]));
      }
    }));
  }
  CHECK(rc::check("png: within half a code, and codes come back as themselves", [] {
    const image<float> depths = *depth_maps();
    const stored_depths back = decode_depth_png(encode_depth_png(depths), "map", "");
    image<float> again(depths.width, depths.height);
    for (std::size_t i = 0; i < depths.texels.size(); ++i) {
      const double code = back.values.texels[i];
      RC_ASSERT(std::abs(code - 65535.0 * static_cast<double>(depths.texels[i])) <= 0.5);
      again.texels[i] = static_cast<float>(code / 65535);
    }
    RC_ASSERT(decode_depth_png(encode_depth_png(again), "map", "").values == back.values);
  }));
}

TEST_CASE("every truncation of a depth map is refused") {
  image<float> depths(9, 5);
  for (std::size_t i = 0; i < depths.texels.size(); ++i) {
    depths.texels[i] = 1 / static_cast<float>(i + 1);
  }
  for (const format& f : formats) {
    const auto whole = f.encode(depths);
    std::size_t accepted = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      accepted += !refused(f, std::span(whole).first(size));
    }
    INFO(f.name << " of " << whole.size() << " bytes");
    CHECK(accepted == 0);
  }
}

TEST_CASE("damaged files give a map or a sentence") {
  for (const format& f : formats) {
    CHECK(rc::check(std::string(f.name) + ": some bytes changed", [&] {
      auto bytes = f.encode(*depth_maps());
      for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
        bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] =
            *rc::gen::arbitrary<std::uint8_t>();
      }
      try {
        f.decode(bytes, "damaged", "");
      } catch (const failure& e) {
        RC_ASSERT(std::string(e.what()).starts_with("cannot read damaged: "));
      } catch (const usage_error&) {  // another channel's name
      }
    }));
  }
}

TEST_CASE("any text as an .obj gives triangles or a sentence") {
  CHECK(rc::check("lines of mesh words", [] {
    std::string text;
    for (int i = *rc::gen::inRange(0, 30); i > 0; --i) {
      text += *rc::gen::element<std::string>(
          "v 0 0 0\n", "v 1 0 0\n", "v 0 1 0\n", "v 1e30 nan 2\n", "f 1 2 3\n", "f 1 2\n",
          "f -1 -2 -3\n", "f 1/1/1 2 3\n", "f 9 9 9\n", "vn 0 0 1\n", "vt 0 0\n", "o a\n", "f\n",
          "g\n", "v\n", "l 1 2\n", "p 1\n", "\\\n", "usemtl x\n");
    }
    try {
      const scene mesh =
          decode_mesh(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                      "text", "obj");
      RC_ASSERT(!mesh.triangles.empty());
      for (const auto& v : mesh.vertices) RC_ASSERT(std::isfinite(v.x + v.y + v.z));
    } catch (const failure&) {
    }
  }));
}
