// Texels in memory: 1 to 4 channels in any format, array layers, two layers in four channels.
#include "bitshade/texture/storage.hpp"

#include <cmath>
#include <random>

#include "bitshade/texture/texture_array.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"

using namespace bitshade;

namespace {

image<double> noise(int w, int h, int channels, unsigned seed) {
  std::mt19937 random(seed);
  image<double> out(w, h, channels);
  for (double& t : out.texels) t = static_cast<double>(random() >> 8) * 0x1p-24;
  return out;
}

}  // namespace

TEST_CASE("1 to 4 channels in every known format: a texel is each channel's own code") {
  const filter_model plain;
  for (const auto& known : known_encodings) {
    for (int channels = 1; channels <= 4; ++channels) {
      const texel_format format = uniform_format(known.value, channels);
      const image<double> in = noise(3, 2, channels, 5);
      const coded_image codes = store(plain, format, in);
      const image<double> back = load_image<double>(plain, format, codes);
      for (std::size_t i = 0; i < in.texels.size(); ++i) {
        CAPTURE(std::string(known.name), channels, i);
        REQUIRE(codes.texels[i] == encode(known.value, in.texels[i]));
        const double value = decode(known.value, codes.texels[i]);
        REQUIRE(((back.texels[i] == value) || (value != value)));
      }
    }
  }
}

TEST_CASE("channels of different formats keep their own: R11G11B10") {
  const texel_format format = r11g11b10_format();
  image<double> in(1, 1, 3);
  in.texels = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const auto back = load_image<double>(filter_model{}, format, store(filter_model{}, format, in));
  CHECK(back.at(0, 0, 0) == back.at(0, 0, 1));
  CHECK(std::fabs(back.at(0, 0, 0) - 1.0 / 3) <= 0x1p-9);  // 6 bits of fraction under 1/2
  CHECK(std::fabs(back.at(0, 0, 2) - 1.0 / 3) <= 0x1p-8);  // 5 bits
  CHECK(back.at(0, 0, 0) != back.at(0, 0, 2));
  CHECK_THROWS(store(filter_model{}, format, image<double>(1, 1, 2)));
}

TEST_CASE("stores have their own rounding and overflow") {
  filter_model m;
  const encoding half = binary16::value;
  m.store.direction = rounding::toward_zero;
  CHECK(decode(half, store_value(m, half, 1 + 0x1.8p-10)) == 1 + 0x1p-10);
  CHECK(decode(half, store_value(filter_model{}, half, 1 + 0x1.8p-10)) == 1 + 0x1p-9);
  m.store.overflow = overflow::saturate;
  CHECK(decode(half, store_value(m, half, 1e9)) == 65504);
  CHECK(std::isinf(decode(half, store_value(filter_model{}, half, 1e9))));
  m.store.subnormal = subnormals::flush_output;
  CHECK(decode(half, store_value(m, half, 0x1p-20)) == 0);
  CHECK(decode(half, store_value(filter_model{}, half, 0x1p-20)) == 0x1p-20);
}

TEST_CASE("array layers: to nearest, ties to even, limited; each is its own texture") {
  CHECK(array_layer(-3.0f, 4) == 0);
  CHECK(array_layer(0.5f, 4) == 0);
  CHECK(array_layer(1.5f, 4) == 2);
  CHECK(array_layer(2.5f, 4) == 2);
  CHECK(array_layer(2.51f, 4) == 3);
  CHECK(array_layer(99.0f, 4) == 3);
  CHECK(array_layer(std::nanf(""), 4) == 0);

  stored_texture texture{uniform_format(unorm_encoding(16), 2), {}};
  for (unsigned layer = 0; layer < 3; ++layer) {
    const auto base = store(filter_model{}, texture.format, noise(8, 8, 2, layer));
    texture.layers.push_back(device_mip_chain(*find_preset("d3d11"), texture.format, base));
  }
  sampler_state state;
  state.mips = mip_selection::linear;
  for (const char* name : {"d3d11", "vulkan-strict", "cuda", "llvmpipe", "swiftshader"}) {
    const filter_model m = *find_preset(name);
    const array_sampler all(m, texture, state);
    for (int layer = 0; layer < 3; ++layer) {
      const device_sampler one(m, texture.format, texture.layers[static_cast<std::size_t>(layer)],
                               state);
      const auto at = static_cast<float>(layer) + 0.25f;
      CHECK(all.lod(0.3f, 0.6f, at, 0.7f, 1) == one.lod(0.3f, 0.6f, 0.7f, 1));
      const gradients g{0.2, 0, 0, 0.3};
      CHECK(all.gradient(0.3f, 0.6f, at, g, 0) == one.gradient(0.3f, 0.6f, g, 0));
    }
  }
  CHECK_THROWS(array_sampler(*find_preset("d3d11"), {texture.format, {}}, state));
}

TEST_CASE("two layers of an LVSM in four channels: packed, stored, filtered and unpacked alike") {
  const image<double> first = noise(6, 5, 2, 1), second = noise(6, 5, 2, 2);
  const image<double> both = pack_layers(first, second);
  CHECK(unpack_layer(both, 0) == first);
  CHECK(unpack_layer(both, 1) == second);
  for (const auto name : test::hard_formats) {
    const encoding e = test::format_named(name);
    const auto two = uniform_format(e, 2), four = uniform_format(e, 4);
    const filter_model m = *find_preset("vulkan-strict");
    const device_sampler packed(m, four, {store(m, four, both)}, {}),
        near(m, two, {store(m, two, first)}, {}), far(m, two, {store(m, two, second)}, {});
    for (const float u : {0.0f, 0.3f, 0.77f})
      for (int c = 0; c < 2; ++c) {
        CAPTURE(std::string(name), u, c);
        CHECK(packed.lod(u, 0.4f, 0, c) == near.lod(u, 0.4f, 0, c));
        CHECK(packed.lod(u, 0.4f, 0, 2 + c) == far.lod(u, 0.4f, 0, c));
      }
  }
  CHECK_THROWS(pack_layers(first, image<double>(6, 4, 2)));
  CHECK_THROWS(unpack_layer(first, 0));
}
