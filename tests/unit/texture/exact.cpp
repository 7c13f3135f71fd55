// The exact sampler and exact chains where numbers end: far places, texels that are no numbers,
// codes too wide.
#include <cmath>
#include <limits>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/exact_mips.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using sampler = exact_sampler<exact_rational>;

namespace {

constexpr address modes[] = {address::clamp, address::repeat, address::mirror, address::border};

std::vector<coded_image> noise(const texel_format& format, int size) {
  std::mt19937 random(3);
  std::vector<coded_image> chain;
  for (; size > 0; size /= 2) {
    coded_image level(size, size, format.channels);
    for (auto& t : level.texels)
      t = encode(format.of[0], static_cast<double>(random() >> 8) * 0x1p-24);
    chain.push_back(std::move(level));
  }
  return chain;
}

}  // namespace

TEST_CASE("exact lookups many periods away: levels, probes, nearest texels") {
  const texel_format format = uniform_format(unorm_encoding(16), 1);
  const auto chain = noise(format, 8);
  for (const bool linear : {false, true})
    for (const address mode : {address::repeat, address::mirror}) {
      sampler_state state;
      state.u = state.v = mode;
      state.linear = linear;
      state.mips = mip_selection::linear;
      state.max_anisotropy = 4;
      const sampler exact(format, chain, state);
      // Derivatives' probes move by up to an eighth, once by many whole periods: 2/5 of 40 and 80.
      const gradients near{0.25, 0, 0, 0.125};
      for (const float far : {0x1p40f, -0x1p80f, 0x1.5p31f}) {
        CAPTURE(linear, static_cast<int>(mode), far);
        CHECK(exact.lod(far, 0.3f, 0.7, 0) == exact.lod(0, 0.3f, 0.7, 0));
        CHECK(exact.gradient(far, 0.3f, near, 0) == exact.gradient(0, 0.3f, near, 0));
      }
      const probe_set two{0.5, {{-0x1p70, 0x1p60}, {0x1p50, 4}}}, none{0.5, {{0, 0}, {0, 0}}};
      CHECK(exact.rational<double>(two, 0.2f, 0.4f, 0.5, 0) ==
            exact.rational<double>(none, 0.2f, 0.4f, 0.5, 0));
    }
}

TEST_CASE("exact lookups of infinite and NaN texels: what binary64 gives, exact beside them") {
  const float infinity = std::numeric_limits<float>::infinity();
  const texel_format format = uniform_format(binary16::value, 1);
  auto chain = noise(format, 8);
  chain[0].at(0, 0) = encode(binary16::value, infinity);
  chain[0].at(2, 2) = encode(binary16::value, infinity);
  chain[0].at(7, 7) = encode(binary16::value, std::nan(""));
  chain[1].at(0, 0) = encode(binary16::value, -infinity);
  for (const address mode : modes) {
    sampler_state state;
    state.u = state.v = mode;
    state.mips = mip_selection::linear;
    state.max_anisotropy = 8;
    const sampler linear(format, chain, state);
    state.linear = false;
    const sampler nearest(format, chain, state);
    CAPTURE(static_cast<int>(mode));
    CHECK(nearest.lod(0.01f, 0.01f, 0, 0) == infinity);
    CHECK(nearest.lod(0.01f, 0.01f, 1, 0) == -infinity);
    CHECK(std::isnan(nearest.lod(0.99f, 0.99f, 0, 0)));
    CHECK(std::isnan(nearest.lod(0.01f, 0.01f, 0.5, 0)));  // between two infinities
    CHECK(linear.lod(0.25f, 0.25f, 0, 0) == infinity);
    CHECK(std::isnan(linear.lod(0.125f, 0.125f, 0, 0)));  // from an infinity: inf - inf
    CHECK(std::isnan(linear.lod(0.9f, 0.9f, 0.25, 0)));
    CHECK(std::isnan(linear.gradient(0.9f, 0.9f, {0.25, 0, 0, 0.125}, 0)));
    // Elsewhere the same texture without them.
    auto plain = noise(format, 8);
    state.linear = true;
    const sampler untouched(format, plain, state);
    CHECK(linear.lod(0.5f, 0.6f, 0.25, 0) == untouched.lod(0.5f, 0.6f, 0.25, 0));
    CHECK(linear.lod<double>(0.5f, 0.6f, 0.25, 0) == untouched.lod<double>(0.5f, 0.6f, 0.25, 0));
  }
}

TEST_CASE("exact lookups refuse codes that the fast ways do not hold") {
  for (const encoding& e :
       {unorm_encoding(25), snorm_encoding(32), fixed_encoding(8, 56), binary64::value})
    CHECK_THROWS_AS(sampler(uniform_format(e, 1), {coded_image(1, 1, 1)}, {}),
                    std::invalid_argument);
  CHECK_NOTHROW(sampler(uniform_format(unorm_encoding(24), 1), {coded_image(1, 1, 1)}, {}));
  CHECK_THROWS_AS(sampler(uniform_format(unorm_encoding(8), 1), {}, {}), std::invalid_argument);
}

TEST_CASE("exact chains: infinite and NaN texels spread as in binary64, wide codes are refused") {
  const texel_format format = uniform_format(binary16::value, 1);
  auto base = noise(format, 4)[0];
  base.at(1, 1) = encode(binary16::value, -std::numeric_limits<double>::infinity());
  base.at(2, 3) = encode(binary16::value, std::nan(""));
  for (const mip_filter filter : {mip_filter::box, mip_filter::centre, mip_filter::area}) {
    const auto levels =
        load_chain<double>({}, format, exact_mip_chain<exact_rational>(format, base, filter));
    CHECK(levels[1].at(0, 0) == -std::numeric_limits<double>::infinity());
    CHECK(std::isnan(levels[1].at(1, 1)));
    CHECK(std::isfinite(levels[1].at(1, 0)));
    CHECK(std::isnan(levels[2].at(0, 0)));
  }
  // A mean halfway between two numbers of 53 bits: rounding it to odd first would give the odd one.
  CHECK_THROWS_AS(exact_mip_chain<exact_rational>(uniform_format(binary64::value, 1),
                                                  coded_image(2, 1, 1), mip_filter::area),
                  std::invalid_argument);
  CHECK_THROWS_AS(exact_mip_chain<exact_rational>(uniform_format(fixed_encoding(1, 51), 1),
                                                  coded_image(2, 1, 1), mip_filter::area),
                  std::invalid_argument);
}

TEST_CASE("exact chains round once in the widest codes that they take") {
  for (const encoding& e :
       {binary_encoding(11, 50), fixed_encoding(1, 50), fixed_encoding(25, 26)}) {
    const texel_format format = uniform_format(e, 1);
    std::mt19937_64 random(17);
    for (int i = 0; i < 500; ++i) {
      coded_image base(3, 1, 1);
      const auto near = random() >> 15;  // 49 bits, and neighbours: means are near ties
      for (auto& t : base.texels)
        t = (e.kind == family::binary ? 0x3ffull << 50 : 0) + near + random() % 5;
      const auto code = exact_mip_chain<exact_rational>(format, base, mip_filter::area)[1].at(0, 0);
      // Codes of neighbours are evenly spaced: the mean of the codes, to nearest; thirds have no
      // ties.
      const auto sum = base.at(0, 0) + base.at(1, 0) + base.at(2, 0);
      REQUIRE(code == (sum + 1) / 3);
    }
  }
}

TEST_CASE("exact chains of floats: the fast way and rationals agree, whatever the codes") {
  std::mt19937_64 random(19);
  for (const encoding& e :
       {binary16::value, bfloat16::value, binary32::value, binary_encoding(11, 50),
        unsigned_binary_encoding(5, 6), fixed_encoding(2, 30)})
    for (const mip_filter filter : {mip_filter::box, mip_filter::centre, mip_filter::area})
      for (int i = 0; i < 60; ++i) {
        const texel_format format = uniform_format(e, 1);
        coded_image base(1 + static_cast<int>(random() % 9), 1 + static_cast<int>(random() % 9), 1);
        for (auto& t : base.texels) {
          // Depths, or any finite code: exponents far apart leave binary64.
          do
            t = i % 2 == 0 ? encode(e, static_cast<double>(random() >> 11) * 0x1p-53)
                           : random() & low_bits(e.width);
          while (!std::isfinite(decode(e, t)));
        }
        const auto chain = exact_mip_chain<exact_rational>(format, base, filter);
        for (std::size_t l = 1; l < chain.size(); ++l)
          for (int y = 0; y < chain[l].height; ++y)
            for (int x = 0; x < chain[l].width; ++x) {
              const mip_taps across = mip_axis(filter, chain[l - 1].width, x),
                             down = mip_axis(filter, chain[l - 1].height, y);
              exact_rational sum(0);
              for (int k = 0; k < down.count; ++k)
                for (int j = 0; j < across.count; ++j)
                  sum +=
                      exact_rational(down.weight[static_cast<std::size_t>(k)] *
                                     across.weight[static_cast<std::size_t>(j)]) *
                      exact_rational(decode(e, chain[l - 1].at(across.first + j, down.first + k)));
              CAPTURE(i, l, x, y, static_cast<int>(filter));
              REQUIRE(chain[l].at(x, y) ==
                      encode_exact(e, sum / exact_rational(down.denominator * across.denominator)));
            }
      }
}

TEST_CASE("exact nearest lookups of one texel need no rationals and give their bits") {
  std::mt19937 random(23);
  certified_counts counts;
  for (const encoding& e : {unorm_encoding(8), unorm_encoding(24), snorm_encoding(16),
                            binary16::value, binary32::value}) {
    const texel_format format = uniform_format(e, 1);
    std::vector<coded_image> chain;
    for (int size = 7; size > 0; size /= 2) {
      coded_image level(size, size, 1);
      for (auto& t : level.texels)
        t = random() % 8 == 0 ? 0x8000u >> (16 - std::min(16, e.width))
                              : random() & low_bits(e.width);
      chain.push_back(std::move(level));
    }
    for (const address mode : modes) {
      sampler_state state;
      state.u = state.v = mode;
      state.linear = false;
      state.mips = mip_selection::nearest;
      state.border = {-0.0, 0, 0, 0};
      const sampler exact(format, chain, state);
      for (int i = 0; i < 200; ++i) {
        const auto draw = [&] { return static_cast<float>(random() % 64) / 28 - 0.5f; };
        const float u = draw(), v = draw();
        const double lambda = static_cast<double>(random() % 5) / 2;
        const probe_set one{0, {{0, 0}}};
        const auto same = [](auto a, auto b) {
          return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
        };
        CAPTURE(i, static_cast<int>(mode), u, v, lambda);
        REQUIRE(same(exact.lod<float>(u, v, lambda, 0, &counts),
                     exact.rational<float>(one, u, v, lambda, 0)));
        REQUIRE(same(exact.lod<double>(u, v, lambda, 0, &counts),
                     exact.rational<double>(one, u, v, lambda, 0)));
      }
    }
  }
  CHECK(counts.rational == 0);
}
