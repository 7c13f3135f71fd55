// The samplers' kernels give the templates' bits: presets, storages, edges, and exact values.
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bitshade/formats/name.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/bulk_sampling.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/presets.hpp"
#include "support/bulk_cases.hpp"
#include "support/images.hpp"

using namespace bitshade;
using test_images::noise;

namespace {

struct coordinates {
  std::vector<float> u, v;
};

/// Inside, at the edges, on texels' centres and borders, far outside, and no numbers.
coordinates places(int width, int height) {
  coordinates at;
  std::uint32_t seed = 3;
  const auto next = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<float>(seed >> 8) * 0x1p-24f;
  };
  // Vectors of samples inside the image, and such with a single sample just beyond the first or the
  // last texel's centre.
  const auto inside = [&](int size) {
    return (0.5f + next() * static_cast<float>(size - 1)) / static_cast<float>(size);
  };
  for (int i = 0; i < 512; ++i) {
    at.u.push_back(inside(width));
    at.v.push_back(inside(height));
    const bool lone = i % 16 == i / 16 % 16;
    if (lone && i / 16 % 4 == 1) at.u.back() = 0.25f / static_cast<float>(width);
    if (lone && i / 16 % 4 == 2) at.v.back() = 0.25f / static_cast<float>(height);
    if (lone && i / 16 % 4 == 3) at.u.back() = 1 - 0.25f / static_cast<float>(width);
  }
  for (int i = 0; i < 600; ++i) {
    at.u.push_back(i % 3 == 0 ? 3 * next() - 1 : next());
    at.v.push_back(i % 5 == 0 ? 3 * next() - 1 : next());
  }
  for (int i = 0; i <= 4 * width && i < 300; ++i) {
    at.u.push_back(static_cast<float>(i) / static_cast<float>(4 * width));
    at.v.push_back(static_cast<float>(i % (2 * height)) / static_cast<float>(2 * height));
  }
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 1e30f,
                          -1e30f, 1e-40f, -0.0f, 1.0f}) {
    at.u.push_back(odd);
    at.v.push_back(0.5f);
  }
  return at;
}

template <class T>
float defined(const filter_model& model, const image<T>& level, const sampler_state& state, float u,
              float v, int channel) {
  return static_cast<float>(sample_level<T>(model, level, static_cast<T>(u), static_cast<T>(v),
                                            state, channel));
}

template <class T>
void check(const filter_model& model, const image<T>& level, const sampler_state& state,
           const coordinates& at, const std::vector<float>& got) {
  for (std::size_t i = 0; i < got.size(); ++i) {
    const auto sample = i / static_cast<std::size_t>(level.channels);
    const float expected =
        defined(model, level, state, at.u[sample], at.v[sample],
                static_cast<int>(i % static_cast<std::size_t>(level.channels)));
    const bool both_nan = expected != expected && got[i] != got[i];
    if (both_nan || bulk_cases::bits_of(got[i]) == bulk_cases::bits_of(expected)) continue;
    INFO(model.name << " u=" << std::hexfloat << at.u[sample] << " v=" << at.v[sample]
                    << " expected=" << expected << " got=" << got[i]);
    FAIL();
  }
}

const address modes[] = {address::clamp, address::repeat, address::mirror, address::border};

}  // namespace

TEST_CASE("bulk::sample gives sample_level's bits in every preset and storage") {
  int round = 0;
  for (const filter_model& model : presets) {
    if (model.order == accumulation::lerp_codes) continue;
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {64, 64}, {37, 19}}) {
      for (const int channels : {1, 2, 3}) {
        sampler_state state;
        state.u = modes[++round % 4];
        state.v = modes[round / 4 % 4];
        state.border = {0.25, 0.75, 0.5, 1};
        const auto at = places(width, height);
        const auto n = at.u.size() * static_cast<std::size_t>(channels);
        const image<float> level = noise(width, height, channels, 3, round % 2 == 0);
        for (const auto set : bulk_cases::sets()) {
          CAPTURE(model.name, width, height, channels, bulk_cases::name_of(set));
          std::vector<float> got(n);
          bulk::sample(model, level, state, at.u, at.v, got, set);
          if (model.rounding == intermediate::result) {
            image<double> wide(width, height, channels);
            wide.texels.assign(level.texels.begin(), level.texels.end());
            check(model, wide, state, at, got);
          } else {
            check(model, level, state, at, got);
          }
          for (const char* name : {"unorm16", "binary16", "bfloat16"}) {
            const bulk::texel_code code{*parse_encoding(name), {}};
            image<std::uint16_t> codes(width, height, channels);
            const image<float> values = noise(width, height, channels, 9);
            bulk::encode(code.format, code.rule, values.texels, std::span(codes.texels));
            bulk::sample(model, code, codes, state, at.u, at.v, got, set);
            const auto decoded = [&]<class T>(image<T> loaded) {
              bulk::decode(code.format, code.rule, codes.texels, std::span(loaded.texels));
              check(model, loaded, state, at, got);
            };
            if (model.rounding == intermediate::result)
              decoded(image<double>(width, height, channels));
            else
              decoded(image<float>(width, height, channels));
          }
        }
      }
    }
  }
}

TEST_CASE("bulk::sample rounds between as a bound sampler does") {
  const auto at = places(13, 9);
  image<float> level = noise(13, 9, 2, 5);
  image<std::uint16_t> codes(13, 9, 2);
  bulk::encode(binary16::value, {}, level.texels, std::span(codes.texels));
  bulk::decode(binary16::value, {}, codes.texels, std::span(level.texels));
  coded_image stored(13, 9, 2);
  std::ranges::copy(codes.texels, stored.texels.begin());
  for (const char* name : {"vulkan-strict", "cuda"}) {
    for (const auto how : {intermediate::per_lerp, intermediate::per_product, intermediate::result}) {
      for (const encoding& to : {binary16::value, bfloat16::value, unorm_encoding(12)}) {
        filter_model model = *find_preset(name);
        model.rounding = how;
        model.rounded_to = to;
        const device_sampler bound(model, uniform_format(binary16::value, 2), {stored}, {});
        std::vector<float> values(2 * at.u.size()), of_codes(values.size());
        bulk::sample(model, level, {}, at.u, at.v, values);
        bulk::sample(model, {binary16::value, {}}, codes, {}, at.u, at.v, of_codes);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const float u = at.u[i / 2], v = at.v[i / 2];
          if (!std::isfinite(u) || !std::isfinite(v)) continue;
          const float expected = bound.lod(u, v, 0, static_cast<int>(i % 2));
          CAPTURE(name, static_cast<int>(how), name_of(to), u, v);
          REQUIRE(bulk_cases::bits_of(values[i]) == bulk_cases::bits_of(expected));
          REQUIRE(bulk_cases::bits_of(of_codes[i]) == bulk_cases::bits_of(expected));
        }
      }
    }
  }
}

TEST_CASE("bulk::sample loads every unorm16 code as its nearest number") {
  const int channels = GENERATE(1, 2);  // the second counts down
  image<std::uint16_t> codes(256, 256, channels);
  std::vector<float> u, v;
  for (int i = 0; i < 65536; ++i) {
    const auto at = static_cast<std::size_t>(i * channels);
    codes.texels[at] = static_cast<std::uint16_t>(i);
    if (channels == 2) codes.texels[at + 1] = static_cast<std::uint16_t>(65535 - i);
    u.push_back((static_cast<float>(i % 256) + 0.5f) / 256);
    v.push_back((static_cast<float>(i / 256) + 0.5f) / 256);
  }
  for (const auto& model : {*find_preset("exact"), *find_preset("cuda")}) {
    for (const auto set : bulk_cases::sets()) {
      std::vector<float> got(codes.texels.size());
      bulk::sample(model, {unorm16::value, {}}, codes, {}, u, v, got, set);
      int wrong = 0;
      for (std::size_t i = 0; i < got.size(); ++i) {
        wrong += got[i] != static_cast<float>(decode(unorm16::value, codes.texels[i])) ? 1 : 0;
      }
      CAPTURE(model.name, channels, bulk_cases::name_of(set));
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("bulk::sample_certified gives bilinear_certified's bits") {
  using exact_number = exact_rational;
  int round = 0;
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 64}, {37, 19}}) {
    for (const int channels : {1, 2, 3}) {
      for (const double divisor : {1.0, 65535.0}) {
        const address mode = modes[++round % 4];
        image<float> level = noise(width, height, channels, 5, divisor == 1 && round % 2 == 0);
        if (divisor != 1) {
          for (float& t : level.texels) t = static_cast<float>(static_cast<int>(t * 65535));
        }
        auto at = places(width, height);
        at.u.resize(at.u.size() - 8);  // finite ones
        at.v.resize(at.u.size());
        const exact_source source{&level, divisor};
        for (const auto set : bulk_cases::sets()) {
          CAPTURE(width, height, channels, divisor, bulk_cases::name_of(set));
          std::vector<float> got(at.u.size() * static_cast<std::size_t>(channels));
          bulk::sample_certified<exact_number>(source, mode, at.u, at.v, got, set);
          std::size_t wrong = 0;
          for (std::size_t i = 0; i < got.size(); ++i) {
            const auto sample = i / static_cast<std::size_t>(channels);
            const float expected = bilinear_certified<float, exact_number>(
                source, at.u[sample], at.v[sample], mode,
                static_cast<int>(i % static_cast<std::size_t>(channels)));
            wrong += bulk_cases::bits_of(expected) == bulk_cases::bits_of(got[i]) ? 0 : 1;
          }
          CHECK(wrong == 0);
        }
      }
    }
  }
}

TEST_CASE("bulk::sample_decided leaves little to the slow ways") {
  const image<float> level = noise(64, 64, 2, 5);
  auto at = places(64, 64);
  at.u.resize(600);
  at.v.resize(600);
  std::vector<float> got(1200);
  const exact_source source{&level, 1};
  if (bulk::has(bulk::instruction_set::avx2))
    CHECK(bulk::sample_decided(source, address::clamp, at.u, at.v, got).size() < 12);
}

TEST_CASE("bulk::sample refuses spans that do not fit") {
  const image<float> level(2, 2, 2);
  std::vector<float> u(4), v(4), out(4);
  CHECK_THROWS_AS(bulk::sample(presets[0], level, {}, u, v, out), std::invalid_argument);
}
