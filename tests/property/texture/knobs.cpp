// Every axis of a filter model at random, not only the presets' bundles: what filtering keeps in
// each, in exact arithmetic and in binary64.
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "bitshade/texture/sampler.hpp"
#include "support/any_filter.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"
#include "support/roundings.hpp"

using namespace bitshade;
using namespace bitshade::test;
using q = exact_rational;

namespace {

float any_coordinate() {
  return static_cast<float>(*rc::gen::inRange(-(1 << 12), 1 << 13)) * 0x1p-12f;
}

/// The product of a lerp may be negative, which unorm cannot hold.
bool loses_negative_products(const filter_model& m) {
  return m.rounding == intermediate::per_product && m.order != accumulation::four_products &&
         m.rounded_to.kind == family::unorm;
}

/// Sizes that are powers of two keep coordinates exact in binary64 under every rule.
image<double> any_texels() {
  image<double> out(1 << *rc::gen::inRange(0, 4), 1 << *rc::gen::inRange(0, 4));
  for (double& t : out.texels) t = *rc::gen::inRange(0, 65536) * 0x1p-16;
  return out;
}

}  // namespace

TEST_CASE("any knobs: exact results stay within the texels' range, constants stay constant") {
  CHECK(rc::check([] {
    const filter_model m = any_knobs();
    const sampler_state state = any_state();
    const image<q> in = exactly(any_texels());
    const q u(any_coordinate()), v(any_coordinate());
    const q got = sample_level<q>(m, in, u, v, state, 0);
    q low = in.texels[0], high = low;
    for (const q& t : in.texels) low = t < low ? t : low, high = high < t ? t : high;
    if (state.u == address::border || state.v == address::border) {
      low = q(0.25) < low ? q(0.25) : low;
      high = high < q(0.25) ? q(0.25) : high;
    }
    RC_ASSERT(!(got < low));
    RC_ASSERT(!(high < got));
    const image<q> flat(in.width, in.height, 1, q(0.25));
    RC_ASSERT(sample_level<q>(m, flat, u, v, state, 0) == q(0.25));
  }));
}

TEST_CASE("any knobs: binary64 loses nothing of 16-bit texels and 12-bit coordinates") {
  CHECK(rc::check([] {
    const filter_model m = any_knobs();
    const sampler_state state = any_state();
    const image<double> in = any_texels();
    const float u = any_coordinate(), v = any_coordinate();
    const double wide = sample_level<double>(m, in, u, v, state, 0);
    // The one rule with a constant of binary32, 1 - 2^-24, would need more bits than there are.
    RC_PRE(m.clamp != clamp_rule::unit || m.grid_bits > 0 || m.weight_bits > 0);
    RC_ASSERT(sample_level<q>(m, exactly(in), q(u), q(v), state, 0) == q(wide));
  }));
}

TEST_CASE("any knobs: weights lie on their grid, in [0,1], and indices in the image") {
  CHECK(rc::check([] {
    const filter_model m = any_knobs();
    const int size = *rc::gen::inRange(1, 40);
    const auto mode = any_of<address>(4);
    const double u = static_cast<double>(*rc::gen::inRange(-(1 << 24), 1 << 25)) * 0x1p-24;
    const axis_taps<double> at = locate_axis<double>(m, u, size, mode);
    RC_ASSERT(at.weight >= 0);
    RC_ASSERT(at.weight <= 1);
    for (const int i : {at.i0, at.i1}) {
      RC_ASSERT(i >= (mode == address::border ? -1 : 0));
      RC_ASSERT(i < size);
    }
    if (m.weight_bits > 0 && m.weight_snap != snap::none) {
      const double scaled = std::ldexp(at.weight, m.weight_bits);
      RC_ASSERT(scaled == std::floor(scaled));
    }
    // Snapped below, a weight never reaches 1; only to nearest may.
    if (m.weight_snap == snap::floor) RC_ASSERT(at.weight < 1);
  }));
}

TEST_CASE("any knobs: coordinates beyond every index stay within the texels' range") {
  CHECK(rc::check([] {
    const filter_model m = any_knobs();
    const sampler_state state = any_state();
    const image<double> wide = any_texels();
    image<float> in(wide.width, wide.height);
    for (std::size_t i = 0; i < in.texels.size(); ++i)
      in.texels[i] = static_cast<float>(wide.texels[i]);
    const auto far = [] {
      return std::ldexp(static_cast<float>(*rc::gen::inRange(-1024, 1024)),
                        *rc::gen::inRange(0, 117));
    };
    const float u = far(), v = far();
    const auto [low, high] = std::minmax_element(in.texels.begin(), in.texels.end());
    const float got = sample_level<float>(m, in, u, v, state, 0);
    // Four products and three sums of binary32, where weights are full.
    RC_ASSERT(got >= std::min(*low, 0.25f) - 0x1p-21f);
    RC_ASSERT(got <= std::max(*high, 0.25f) + 0x1p-21f);
  }));
}

TEST_CASE("any rounding between, to any format: within as many half steps as there are roundings") {
  CHECK(rc::check([] {
    filter_model m = any_knobs();
    m.rounding = any_of<intermediate>(3);  // none, per product, per lerp
    const auto name = test::hard_formats[static_cast<std::size_t>(
        *rc::gen::inRange(0, static_cast<int>(test::hard_formats.size())))];
    m.rounded_to = test::format_named(name);
    filter_model none = m;
    none.rounding = intermediate::none;
    const image<double> in = any_texels();
    const sampler_state state = any_state();
    const float u = any_coordinate(), v = any_coordinate();
    const double got = sample_level<double>(m, in, u, v, state, 0);
    const double truth = sample_level<double>(none, in, u, v, state, 0);
    // Four products: 4 of them and 3 sums. Lerps: product and sum along x, which y's weights
    // average, then along y, whose difference may double what x left: 2 + 2 * 2 + 2.
    const int roundings = m.rounding == intermediate::none          ? 0
                          : m.order == accumulation::four_products  ? 7
                          : m.rounding == intermediate::per_product ? 8
                                                                    : 2;
    // Differences of snorm and binary products are as large as 1, their half steps no larger. What
    // a rounding leaves may need all 53 bits: it, its product and its sum are rounded once more.
    const double bound =
        roundings * test::half_step(m.rounded_to) + test::roundings(3 * roundings);
    RC_ASSERT(got >= truth - bound);
    if (loses_negative_products(m)) {
      // The product of a lerp downwards is 0 in unorm, which leaves the result too high: at its
      // first texel, up to what the other roundings do.
      const double most = std::max(0.25, *std::max_element(in.texels.begin(), in.texels.end()));
      RC_ASSERT(got <= most + bound);
    } else {
      RC_ASSERT(got <= truth + bound);
    }
  }));
}

TEST_CASE("a lerp with products in unorm stands still where it should fall") {
  filter_model m;
  m.order = accumulation::lerp_mul_add;
  m.rounding = intermediate::per_product;
  m.rounded_to = test::format_named("unorm16");
  REQUIRE(loses_negative_products(m));
  CHECK(interpolate(m, 1.0, 0.0, 0.5) == 1.0);  // 1/2 away from the value: no bound in steps holds
  CHECK(std::fabs(interpolate(m, 0.0, 1.0, 0.5) - 0.5) <= test::half_step(m.rounded_to));
  m.rounded_to = test::format_named("snorm16");
  CHECK(std::fabs(interpolate(m, 1.0, 0.0, 0.5) - 0.5) <= 2 * test::half_step(m.rounded_to));
}

TEST_CASE("certified lookups equal rationals in every format, wrap and border, in both results") {
  CHECK(rc::check([] {
    const auto name = test::hard_formats[static_cast<std::size_t>(
        *rc::gen::inRange(0, static_cast<int>(test::hard_formats.size())))];
    const encoding e = test::format_named(name);
    const texel_format format = uniform_format(e, 1);
    std::vector<coded_image> chain;
    const int w = *rc::gen::inRange(1, 14), h = *rc::gen::inRange(1, 14);
    for (int l = 0; l < mip_levels(w, h); ++l) {
      coded_image level(mip_size(w, l), mip_size(h, l), 1);
      for (auto& t : level.texels) t = encode(e, *rc::gen::inRange(0, 1 << 16) * 0x1p-16);
      chain.push_back(std::move(level));
    }
    sampler_state state;
    state.u = any_of<address>(4);
    state.v = any_of<address>(4);
    state.linear = *rc::gen::inRange(0, 4) != 0;
    state.mips = any_of<mip_selection>(3);
    state.max_anisotropy = *rc::gen::inRange(1, 17);
    state.border = {*rc::gen::inRange(-64, 64) * 0x1p-5, 0, 0, 0};
    const exact_sampler<q> sampler(format, chain, state);
    const auto coordinate = [] {
      return static_cast<float>(*rc::gen::inRange(-(1 << 24), 1 << 25)) * 0x1p-24f;
    };
    const float u = coordinate(), v = coordinate();
    const float lambda = static_cast<float>(*rc::gen::inRange(-100, 500)) / 100;
    const probe_set one{0, {{0, 0}}};
    RC_ASSERT((sampler.lod<float>(u, v, lambda, 0)) ==
              (sampler.rational<float>(one, u, v, lambda, 0)));
    RC_ASSERT((sampler.lod<double>(u, v, lambda, 0)) ==
              (sampler.rational<double>(one, u, v, lambda, 0)));
    const auto d = [] { return *rc::gen::inRange(-4096, 4096) * 0x1p-14; };
    const gradients g{d(), d(), d(), d()};
    const probe_set probes = vulkan_probes(g, w, h, state.max_anisotropy);
    RC_ASSERT((sampler.gradient<float>(u, v, g, 0)) ==
              (sampler.rational<float>(probes, u, v, probes.lambda, 0)));
  }));
}
