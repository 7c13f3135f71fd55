// The blurs' kernels give the templates' bits: every set, size, edge, tap count and storage.
#include "support/catch.hpp"

#include "bitshade/formats/name.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/bulk.hpp"
#include "support/bulk_cases.hpp"
#include "support/images.hpp"

using namespace bitshade;
using test_images::difference;
using test_images::noise;

namespace {

struct size {
  int width, height;
};
const size sizes[] = {{1, 1}, {3, 2}, {16, 5}, {33, 40}, {131, 70}, {600, 3}, {1037, 66}};
const address modes[] = {address::clamp, address::repeat, address::mirror, address::border};

kernel weights_of(int taps, bool symmetric) {
  kernel result = gaussian_kernel(taps, 0.3 * taps);
  if (!symmetric) result.weights.front() *= 0.5;
  return result;
}

image<float> along_x(const image<float>& in, const kernel& w, address mode, float border) {
  image<float> out(in.width, in.height, in.channels);
  for (int y = 0; y < in.height; ++y) blur_row_x<float>(in, w, mode, y, out.row(y), border);
  return out;
}
image<float> along_y(const image<float>& in, const kernel& w, address mode, float border) {
  image<float> out(in.width, in.height, in.channels);
  for (int y = 0; y < in.height; ++y) blur_row_y<float>(in, w, mode, y, out.row(y), border);
  return out;
}

}  // namespace

TEST_CASE("bulk::blur gives the templates' bits in binary32") {
  int round = 0;
  for (const auto [width, height] : sizes) {
    for (const int taps : {1, 3, 5, 7, 9, 13, 25}) {
      const int channels = 1 + round % 4;
      const address mode = modes[++round % 4];
      const image<float> in = noise(width, height, channels, 7, round % 3 == 0);
      const kernel w = weights_of(taps, round % 5 != 0);
      const image<float> x = along_x(in, w, mode, 0.75f), y = along_y(in, w, mode, 0.75f);
      const image<float> both = along_y(x, w, mode, 0.75f);
      for (const auto set : bulk_cases::sets()) {
        CAPTURE(width, height, channels, taps, static_cast<int>(mode), bulk_cases::name_of(set));
        image<float> out(width, height, channels);
        bulk::blur_x(in, w, mode, {0, height}, out, set, 0.75f);
        CHECK(difference(out, x) == "");
        bulk::blur_y(in, w, mode, {0, height}, out, set, 0.75f);
        CHECK(difference(out, y) == "");
        bulk::blur(in, w, mode, {0, height / 3}, out, set, 0.75f);
        bulk::blur(in, w, mode, {height / 3, height}, out, set, 0.75f);
        CHECK(difference(out, both) == "");
      }
    }
  }
}

TEST_CASE("bulk::blur rounds 16-bit texels as stores between the templates do") {
  int round = 0;
  for (const char* name : {"binary16", "unorm16", "bfloat16", "snorm16"}) {
    const bulk::texel_code code{*parse_encoding(name), {}};
    for (const auto [width, height] : sizes) {
      for (const int taps : {3, 9, 13}) {
        const int channels = 1 + round % 2;
        const address mode = modes[++round % 4];
        const image<float> values = noise(width, height, channels, 11);
        image<std::uint16_t> in(width, height, channels), expected = in;
        image<float> stored = values;
        bulk::encode(code.format, code.rule, values.texels, std::span(in.texels));
        bulk::decode(code.format, code.rule, in.texels, std::span(stored.texels));
        const kernel w = weights_of(taps, round % 5 != 0);
        image<float> x = along_x(stored, w, mode, 0.25f);
        bulk::round(code.format, code.rule, x.texels, x.texels);
        const image<float> both = along_y(x, w, mode, 0.25f);
        bulk::encode(code.format, code.rule, both.texels, std::span(expected.texels));
        for (const auto set : bulk_cases::sets()) {
          CAPTURE(name, width, height, channels, taps, bulk_cases::name_of(set));
          image<std::uint16_t> out(width, height, channels);
          bulk::blur(code, in, w, mode, {0, height / 2}, out, set, 0.25f);
          bulk::blur(code, in, w, mode, {height / 2, height}, out, set, 0.25f);
          CHECK(difference(out, expected) == "");
        }
      }
    }
  }
}

TEST_CASE("bulk::blur keeps its bits where results pass the caches by") {
  const bulk::texel_code half{binary16::value, {}};
  const image<float> values = noise(2048, 1030, 1, 2);  // over 4 MiB, in either storage
  image<std::uint16_t> in(2048, 1030), expected = in;
  bulk::encode(half.format, half.rule, values.texels, std::span(in.texels));
  const kernel w = gaussian_kernel(9, 2);
  const image<float> both = along_y(along_x(values, w, address::clamp, 0), w, address::clamp, 0);
  bulk::blur(half, in, w, address::clamp, {0, 1030}, expected, bulk::instruction_set::scalar);
  for (const auto set : bulk_cases::sets()) {
    CAPTURE(bulk_cases::name_of(set));
    image<float> out(2048, 1030);
    bulk::blur(values, w, address::clamp, {0, 1030}, out, set);
    CHECK(difference(out, both) == "");
    image<std::uint16_t> codes(2048, 1030);
    bulk::blur(half, in, w, address::clamp, {0, 1030}, codes, set);
    CHECK(difference(codes, expected) == "");
  }
}

TEST_CASE("bulk::blur limits unorm16 sums wherever weights or the border can leave [0,1]") {
  const bulk::texel_code code{unorm16::value, {}};
  image<std::uint16_t> in(70, 20);
  for (std::size_t i = 0; i < in.texels.size(); ++i)
    in.texels[i] = i % 3 == 0 ? 0 : static_cast<std::uint16_t>(65535 - i % 2);
  const kernel sharp{{-0.5, 2, -0.5}}, heavy{{0.25, 0.5, 0.26}}, barely{{0.25, 0.5, 0.25 + 0x1p-16}},
      plain{{0.25, 0.5, 0.25}}, tight{{0.25, 0.5 + 0x1p-20, 0.25}};
  const kernel many{std::vector<double>(41, 1.0 / 41)};
  for (const kernel* w : {&sharp, &heavy, &barely, &plain, &tight, &many}) {
    for (const float border : {0.0f, 1.0f, 1.5f, -3.0f}) {
      image<std::uint16_t> expected(70, 20);
      bulk::blur(code, in, *w, address::border, {0, 20}, expected, bulk::instruction_set::scalar,
                 border);
      for (const auto set : bulk_cases::sets()) {
        CAPTURE(w->weights.size(), w->weights[0], border, bulk_cases::name_of(set));
        image<std::uint16_t> out(70, 20);
        bulk::blur(code, in, *w, address::border, {0, 20}, out, set, border);
        CHECK(difference(out, expected) == "");
      }
    }
  }
}

TEST_CASE("bulk::blur refuses what is no blur") {
  const image<float> in(4, 4);
  image<float> out(4, 4), other(4, 5);
  const kernel w = gaussian_kernel(3, 1);
  CHECK_THROWS_AS(bulk::blur(in, w, address::clamp, {0, 4}, other), std::invalid_argument);
  CHECK_THROWS_AS(bulk::blur(in, w, address::clamp, {0, 5}, out), std::invalid_argument);
  CHECK_THROWS_AS(bulk::blur_x(in, w, address::clamp, {3, 2}, out), std::invalid_argument);
  CHECK_THROWS_AS(bulk::blur_y(in, kernel{{0.5, 0.5}}, address::clamp, {0, 4}, out),
                  std::invalid_argument);
}
