// Mip levels' and summed-area tables' kernels give the templates' bits.
#include "support/catch.hpp"

#include "bitshade/arithmetic/workers.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/texture/bulk.hpp"
#include "bitshade/texture/sat.hpp"
#include "support/bulk_cases.hpp"
#include "support/images.hpp"

using namespace bitshade;
using test_images::difference;
using test_images::noise;

namespace {

struct size {
  int width, height;
};
const size sizes[] = {{1, 1}, {2, 2}, {1, 6}, {7, 3}, {16, 34}, {66, 20}, {130, 17}, {640, 50}};

image<std::uint16_t> codes_of(const bulk::texel_code& code, const image<float>& values) {
  image<std::uint16_t> codes(values.width, values.height, values.channels);
  bulk::encode(code.format, code.rule, values.texels, std::span(codes.texels));
  return codes;
}
image<float> values_of(const bulk::texel_code& code, const image<std::uint16_t>& codes) {
  image<float> values(codes.width, codes.height, codes.channels);
  bulk::decode(code.format, code.rule, codes.texels, std::span(values.texels));
  return values;
}
template <class T>
image<T> running(const image<T>& in) {
  return make_sat(in, sat_order::running, sat_offset::none, [](std::span<T>) {}).sums;
}

}  // namespace

TEST_CASE("bulk::downsample gives downsample_row's bits") {
  for (const auto [width, height] : sizes) {
    for (const int channels : {1, 2, 3, 4}) {
      for (const auto filter : {mip_filter::box, mip_filter::centre, mip_filter::area}) {
        const image<float> in = noise(width, height, channels, 5, channels == 2);
        image<float> expected(std::max(1, width / 2), std::max(1, height / 2), channels);
        for (int y = 0; y < expected.height; ++y)
          downsample_row<float>(in, filter, y, expected.row(y));
        for (const auto set : bulk_cases::sets()) {
          CAPTURE(width, height, channels, static_cast<int>(filter), bulk_cases::name_of(set));
          image<float> out(expected.width, expected.height, channels);
          bulk::downsample(in, filter, {0, out.height / 2}, out, set);
          bulk::downsample(in, filter, {out.height / 2, out.height}, out, set);
          CHECK(difference(out, expected) == "");
        }
      }
    }
  }
}

TEST_CASE("bulk::downsample decodes before and encodes after") {
  for (const char* name : {"binary16", "unorm16", "bfloat16"}) {
    const bulk::texel_code code{*parse_encoding(name), {}};
    for (const auto [width, height] : sizes) {
      for (const int channels : {1, 2}) {
        const auto in = codes_of(code, noise(width, height, channels, 3));
        const image<float> values = values_of(code, in);
        image<float> small(std::max(1, width / 2), std::max(1, height / 2), channels);
        for (int y = 0; y < small.height; ++y)
          downsample_row<float>(values, mip_filter::box, y, small.row(y));
        const auto expected = codes_of(code, small);
        for (const auto set : bulk_cases::sets()) {
          CAPTURE(name, width, height, channels, bulk_cases::name_of(set));
          image<std::uint16_t> out(small.width, small.height, channels);
          bulk::downsample(code, in, mip_filter::box, {0, out.height}, out, set);
          CHECK(difference(out, expected) == "");
        }
      }
    }
  }
}

TEST_CASE("bulk::fill_mips gives mip_chain's levels on any number of threads") {
  const std::pair<int, int> tall[] = {{1, 1}, {1, 8}, {6, 64}, {33, 320}, {130, 192}, {40, 129}};
  for (const auto& [width, height] : tall) {
    for (const auto filter : {mip_filter::box, mip_filter::centre, mip_filter::area}) {
      const image<float> base = noise(width, height, 2, 11);
      const auto expected = mip_chain<float>(base, filter, [](std::span<float>) {});
      bulk::workers crew(2);
      for (const unsigned threads : {0u, 1u, 2u, 7u}) {  // 0: those that wait
        auto levels = expected;
        for (std::size_t l = 1; l < levels.size(); ++l) std::ranges::fill(levels[l].texels, -1.0f);
        bulk::fill_mips(levels, filter,
                        {.threads = threads, .crew = threads == 0 ? &crew : nullptr});
        for (std::size_t l = 1; l < levels.size(); ++l) {
          CAPTURE(width, height, static_cast<int>(filter), threads, l);
          CHECK(difference(levels[l], expected[l]) == "");
        }
      }
    }
    const bulk::texel_code half{binary16::value, {}};
    std::vector<image<std::uint16_t>> codes{codes_of(half, noise(width, height, 1, 12))};
    const auto expected = mip_chain<float>(values_of(half, codes[0]), mip_filter::box,
        [&](std::span<float> row) { bulk::round(half.format, half.rule, row, row); });
    for (std::size_t l = 1; l < expected.size(); ++l)
      codes.emplace_back(expected[l].width, expected[l].height, 1);
    bulk::fill_mips(half, codes, mip_filter::box, {.threads = 3});
    for (std::size_t l = 1; l < codes.size(); ++l)
      CHECK(difference(codes[l], codes_of(half, expected[l])) == "");
  }
  std::vector<image<float>> wrong{image<float>(8, 8, 1), image<float>(4, 3, 1)};
  CHECK_THROWS_AS(bulk::fill_mips(wrong, mip_filter::box), std::invalid_argument);
}

TEST_CASE("bulk::sum_area gives the running table's bits on any number of threads") {
  bulk::workers crew(4);
  for (const auto [width, height] : sizes) {
    for (const int channels : {1, 2, 3, 4}) {
      image<float> in = noise(width, height, channels, 9, channels == 4);
      in.texels.front() = -0.0f;
      const image<float> expected = running(in);
      for (const auto set : bulk_cases::sets()) {
        for (const unsigned threads : {0u, 1u, 2u, 5u}) {  // 0: those that wait
          CAPTURE(width, height, channels, bulk_cases::name_of(set), threads);
          image<float> out(width, height, channels);
          bulk::sum_area(in, out,
                         {.threads = threads, .set = set, .crew = threads == 0 ? &crew : nullptr});
          CHECK(difference(out, expected) == "");
        }
      }
    }
  }
}

TEST_CASE("bulk::sum_area gathers rows that go past the caches, and rows of whole pages") {
  // Over 4 MiB, with rows of whole lines; and rows of 4 KiB.
  for (const auto& [row, height] : {std::pair(1040, 1030), std::pair(1024, 19)}) {
    for (const int channels : {1, 2, 4}) {
      const image<float> in = noise(row / channels, height, channels, 13);
      const image<float> expected = running(in);
      for (const auto set : bulk_cases::sets()) {
        for (const unsigned threads : {1u, 2u}) {
          CAPTURE(row, height, channels, bulk_cases::name_of(set), threads);
          image<float> out(in.width, in.height, channels);
          bulk::sum_area(in, out, {.threads = threads, .set = set});
          CHECK(difference(out, expected) == "");
        }
      }
    }
  }
}

TEST_CASE("bulk::sum_area sums 16-bit texels in binary32, or their codes in wrapping integers") {
  for (const char* name : {"binary16", "unorm16", "snorm16"}) {
    const bulk::texel_code code{*parse_encoding(name), {}};
    for (const auto [width, height] : sizes) {
      for (const int channels : {1, 2}) {
        const auto in = codes_of(code, noise(width, height, channels, 4));
        const image<float> expected = running(values_of(code, in));
        image<std::uint64_t> wide(width, height, channels);
        std::ranges::copy(in.texels, wide.texels.begin());
        const auto modular = make_modular_sat<std::uint32_t>(wide, 16).sums;
        for (const auto set : bulk_cases::sets()) {
          for (const unsigned threads : {1u, 3u}) {
            CAPTURE(name, width, height, channels, bulk_cases::name_of(set), threads);
            image<float> out(width, height, channels);
            bulk::sum_area(code, in, out, {.threads = threads, .set = set});
            CHECK(difference(out, expected) == "");
            image<std::uint32_t> sums(width, height, channels);
            bulk::sum_area(in, sums, {.threads = threads, .set = set});
            CHECK(difference(sums, modular) == "");
          }
        }
      }
    }
  }
}
