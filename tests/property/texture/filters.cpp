// What every model keeps: constants, ranges, sums of weights, symmetries, exactness.
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "bitshade/texture/sat.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

const filter_model& any_model() {
  return presets[static_cast<std::size_t>(*rc::gen::inRange(0, 8))];
}
address any_address() { return static_cast<address>(*rc::gen::inRange(0, 3)); }
int any_size() { return *rc::gen::inRange(1, 20); }
float any_coordinate() {
  return static_cast<float>(*rc::gen::inRange(-(1 << 24), 1 << 25)) * 0x1p-24f;
}

texel_format format_for(const filter_model& m) {
  const bool bytes = m.order == accumulation::lerp_codes;
  return uniform_format(unorm_encoding(bytes ? 8 : 16), 1);
}

coded_image any_codes(int w, int h, int bits) {
  coded_image out(w, h, 1);
  for (auto& t : out.texels) t = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << bits));
  return out;
}

coded_image mirrored(const coded_image& in) {
  coded_image out = in;
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) out.at(x, y) = in.at(in.width - 1 - x, y);
  return out;
}

// A lerp's last rounding may leave the range of its ends by half an ulp when a full-precision
// weight is next to 1; two directions and the scaling: two ulp of 1.
constexpr double range_slack = 0x1p-22;

}  // namespace

TEST_CASE("constants stay constant in every preset, for every lookup") {
  CHECK(rc::check([] {
    const filter_model& m = any_model();
    const texel_format format = format_for(m);
    const int w = any_size(), h = any_size();
    const auto code = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << format.of[0].width));
    std::vector<coded_image> chain;
    for (int l = 0; l < mip_levels(w, h); ++l)
      chain.emplace_back(mip_size(w, l), mip_size(h, l), 1, code);
    sampler_state state;
    state.u = state.v = any_address();
    state.mips = mip_selection::linear;
    const device_sampler sampler(m, format, chain, state);
    const float expected =
        static_cast<float>(load(m, format.of[0], code)) * texel_scale(m, format.of[0]);
    const auto lambda = static_cast<float>(*rc::gen::inRange(-64, 400)) / 64;
    RC_ASSERT(sampler.lod(any_coordinate(), any_coordinate(), lambda, 0) == expected);
  }));
}

TEST_CASE("anisotropic constants deviate by the weights' sum alone, a few ulp") {
  CHECK(rc::check([] {
    const filter_model& m = any_model();
    const texel_format format = format_for(m);
    const auto code = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << format.of[0].width));
    std::vector<coded_image> chain;
    for (int l = 0; l < 5; ++l) chain.emplace_back(16 >> l, 16 >> l, 1, code);
    sampler_state state;
    state.u = state.v = any_address();
    state.mips = mip_selection::linear;
    state.max_anisotropy = *rc::gen::inRange(1, 17);
    const device_sampler sampler(m, format, chain, state);
    const double expected = decode(format.of[0], code);
    const auto d = [] { return *rc::gen::inRange(-4096, 4096) * 0x1p-16; };
    const float got = sampler.gradient(any_coordinate(), any_coordinate(), {d(), d(), d(), d()}, 0);
    // Up to 16 weights fl(1/n), 16 products and 16 sums: 48 half ulps of at most 1; an ellipse of
    // EWA adds up hundreds of texels, sums and products of one sign: 2^-16.
    RC_ASSERT(std::fabs(static_cast<double>(got) - expected) <=
              (m.name == "llvmpipe" || m.name == "llvmpipe-r8" || m.name == "softpipe"
                   ? 0x1p-16
                   : 48 * 0x1p-24));
  }));
}

TEST_CASE("results lie within the texels' range") {
  CHECK(rc::check([] {
    const filter_model& m = any_model();
    const texel_format format = format_for(m);
    const int w = any_size(), h = any_size();
    std::vector<coded_image> chain;
    std::vector<std::uint64_t> all;
    for (int l = 0; l < mip_levels(w, h); ++l) {
      chain.push_back(any_codes(mip_size(w, l), mip_size(h, l), format.of[0].width));
      all.insert(all.end(), chain.back().texels.begin(), chain.back().texels.end());
    }
    sampler_state state;
    state.u = state.v = any_address();
    state.mips = static_cast<mip_selection>(*rc::gen::inRange(0, 3));
    const device_sampler sampler(m, format, chain, state);
    const auto [low, high] = std::minmax_element(all.begin(), all.end());
    const auto lambda = static_cast<float>(*rc::gen::inRange(-64, 400)) / 64;
    const double got = sampler.lod(any_coordinate(), any_coordinate(), lambda, 0);
    // Weights of 8 bits cannot reach 1, so that the specification's own presets never leave it.
    const double slack = m.grid_bits > 0 && m.order == accumulation::lerp_mul_add ? 0 : range_slack;
    const auto value = [&](std::uint64_t c) {
      const auto texel = static_cast<float>(load(m, format.of[0], c));
      return static_cast<double>(texel * texel_scale(m, format.of[0]));
    };
    RC_ASSERT(got >= value(*low) - slack);
    RC_ASSERT(got <= value(*high) + slack);
  }));
}

TEST_CASE("mirroring the image and the coordinate changes nothing in exact arithmetic") {
  CHECK(rc::check([] {
    const coded_image codes = any_codes(any_size(), any_size(), 16);
    const texel_format format = uniform_format(unorm_encoding(16), 1);
    sampler_state state;
    state.u = state.v = any_address();
    const exact_sampler<exact_rational> here(format, {codes}, state),
        there(format, {mirrored(codes)}, state);
    const float u = any_coordinate(), v = any_coordinate();
    const float mirror = 1 - u;
    RC_PRE(1 - mirror == u);  // the reflection itself must not round
    RC_ASSERT(here.lod(u, v, 0, 0) == there.lod(mirror, v, 0, 0));
  }));
}

TEST_CASE("exact equals the closed form of bilinear filtering, and its own rationals") {
  CHECK(rc::check([] {
    const coded_image codes = any_codes(2, 2, 16);
    const texel_format format = uniform_format(unorm_encoding(16), 1);
    const exact_sampler<exact_rational> sampler(format, {codes}, {});
    // Between the four centres: u = 1/4 + i/512 puts the weight at i/256.
    const int i = *rc::gen::inRange(0, 257), j = *rc::gen::inRange(0, 257);
    const float u = 0.25f + static_cast<float>(i) / 512, v = 0.25f + static_cast<float>(j) / 512;
    const auto t = [&](int x, int y) { return static_cast<std::int64_t>(codes.at(x, y)); };
    const std::int64_t sum = (256 - i) * (256 - j) * t(0, 0) + i * (256 - j) * t(1, 0) +
                             (256 - i) * j * t(0, 1) + i * j * t(1, 1);
    const exact_rational closed = exact_rational(sum) / exact_rational(std::int64_t{65536} * 65535);
    RC_ASSERT(sampler.lod<float>(u, v, 0, 0) ==
              (certified_detail::nearest_of<float, exact_rational>(closed)));
    RC_ASSERT(sampler.lod<double>(u, v, 0, 0) ==
              (certified_detail::nearest_of<double, exact_rational>(closed)));
  }));
}

TEST_CASE("exact trilinear and anisotropic lookups equal rationals bit for bit") {
  CHECK(rc::check([] {
    const texel_format format = uniform_format(unorm_encoding(16), 1);
    std::vector<coded_image> chain;
    for (int l = 0; l < 4; ++l) chain.push_back(any_codes(8 >> l, 8 >> l, 16));
    sampler_state state;
    state.u = state.v = any_address();
    state.mips = mip_selection::linear;
    state.max_anisotropy = *rc::gen::inRange(1, 9);
    const exact_sampler<exact_rational> sampler(format, chain, state);
    const float u = any_coordinate(), v = any_coordinate();
    const auto d = [] { return *rc::gen::inRange(-4096, 4096) * 0x1p-14; };
    const gradients g{d(), d(), d(), d()};
    const probe_set probes = vulkan_probes(g, 8, 8, state.max_anisotropy);
    RC_ASSERT(sampler.gradient(u, v, g, 0) ==
              sampler.rational<float>(probes, u, v, probes.lambda, 0));
    const float lambda = static_cast<float>(*rc::gen::inRange(-100, 500)) / 100;
    RC_ASSERT(sampler.lod(u, v, lambda, 0) ==
              (sampler.rational<float>({0, {{0, 0}}}, u, v, lambda, 0)));
  }));
}

TEST_CASE("one sampler, other numbers: exact filtering with a device's weights") {
  CHECK(rc::check([] {
    // 8-bit weights and 16-bit codes: binary64 loses nothing, so that both carriers agree.
    filter_model m = *find_preset("vulkan-strict");
    image<double> wide(5, 4, 1);
    image<exact_rational> exact(5, 4, 1);
    for (std::size_t i = 0; i < 20; ++i) {
      const int code = *rc::gen::inRange(0, 65536);
      wide.texels[i] = code;
      exact.texels[i] = exact_rational(code);
    }
    const float u = any_coordinate(), v = any_coordinate();
    sampler_state state;
    state.u = state.v = any_address();
    const double a = sample_level<double>(m, wide, u, v, state, 0);
    const exact_rational b =
        sample_level<exact_rational>(m, exact, exact_rational(u), exact_rational(v), state, 0);
    RC_ASSERT(exact_rational(a) == b);
  }));
}

TEST_CASE("tables equal direct sums modulo their range, whatever the order") {
  CHECK(rc::check([] {
    const int w = any_size(), h = any_size();
    image<std::uint32_t> in(w, h, 1);
    for (auto& t : in.texels) t = *rc::gen::arbitrary<std::uint32_t>();
    const auto order = static_cast<sat_order>(*rc::gen::inRange(0, 4));
    const auto sat = make_sat(in, order, sat_offset::none, [](auto) {});
    const int x0 = *rc::gen::inRange(0, w), y0 = *rc::gen::inRange(0, h);
    const int x1 = *rc::gen::inRange(x0, w), y1 = *rc::gen::inRange(y0, h);
    std::uint32_t direct = 0;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) direct += in.at(x, y);
    RC_ASSERT(box_sum(sat, x0, y0, x1, y1, 0) == direct);
  }));
}

TEST_CASE("blurs are linear and keep constants, on every edge") {
  CHECK(rc::check([] {
    const int w = any_size(), taps = 2 * *rc::gen::inRange(0, 13) + 1;
    const kernel k = gaussian_kernel(taps, *rc::gen::inRange(1, 40) / 8.0);
    const image<double> flat(w, 1, 1, *rc::gen::inRange(0, 1 << 20) * 0x1p-20);
    std::vector<double> out(static_cast<std::size_t>(w));
    const auto mode = static_cast<address>(*rc::gen::inRange(0, 4));
    blur_row_x<double>(flat, k, mode, 0, out, flat.at(0, 0));
    // 24-bit weights times 20-bit depths: binary64 adds them without loss.
    for (const double x : out) RC_ASSERT(x == flat.at(0, 0));
  }));
}
