// What permutes or mirrors an image permutes or mirrors its lookups: in every preset where each
// channel is filtered by itself, in exact arithmetic under every knob.
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "bitshade/texture/texture_array.hpp"
#include "support/any_filter.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::test;
using q = exact_rational;

namespace {

float any_coordinate() {
  return static_cast<float>(*rc::gen::inRange(-(1 << 24), 1 << 25)) * 0x1p-24f;
}

/// 4 channels in another order.
std::array<int, 4> any_order() {
  std::array<int, 4> order{0, 1, 2, 3};
  for (int left = 4; left > 1; --left)
    std::swap(order[static_cast<std::size_t>(left - 1)],
              order[static_cast<std::size_t>(*rc::gen::inRange(0, left))]);
  return order;
}

image<q> any_image(int w, int h) {
  image<double> out(w, h);
  for (double& t : out.texels) t = *rc::gen::inRange(0, 65536) * 0x1p-16;
  return exactly(out);
}

sampler_state every_state() {
  sampler_state state = any_state();
  state.mips = any_of<mip_selection>(3);
  state.max_anisotropy = *rc::gen::inRange(1, 17);
  for (double& b : state.border) b = *rc::gen::inRange(0, 9) / 8.0;
  return state;
}

}  // namespace

TEST_CASE("channels permute with their results in every preset, bit for bit") {
  CHECK(rc::check([] {
    const filter_model& m = presets[static_cast<std::size_t>(*rc::gen::inRange(0, 8))];
    const int bits = m.order == accumulation::lerp_codes ? 8 : 16;
    const texel_format format = uniform_format(unorm_encoding(bits), 4);
    const auto order = any_order();
    const int w = *rc::gen::inRange(1, 12), h = *rc::gen::inRange(1, 12);
    std::vector<coded_image> chain, permuted;
    for (int l = 0; l < mip_levels(w, h); ++l) {
      coded_image level(mip_size(w, l), mip_size(h, l), 4), other = level;
      for (std::size_t i = 0; i < level.texels.size(); ++i) {
        level.texels[i] = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << bits));
        other.texels[i / 4 * 4 + static_cast<std::size_t>(order[i % 4])] = level.texels[i];
      }
      chain.push_back(std::move(level));
      permuted.push_back(std::move(other));
    }
    const sampler_state state = every_state();
    sampler_state there = state;
    for (std::size_t c = 0; c < 4; ++c)
      there.border[static_cast<std::size_t>(order[c])] = state.border[c];
    const float u = any_coordinate(), v = any_coordinate();
    const float lambda = static_cast<float>(*rc::gen::inRange(-64, 400)) / 64;
    const auto d = [] { return *rc::gen::inRange(-4096, 4096) * 0x1p-14; };
    const gradients g{d(), d(), d(), d()};
    const auto check = [&](const auto& a, const auto& b) {
      for (int c = 0; c < 4; ++c) {
        const int to = order[static_cast<std::size_t>(c)];
        RC_ASSERT(a.lod(u, v, lambda, c) == b.lod(u, v, lambda, to));
        RC_ASSERT(a.gradient(u, v, g, c) == b.gradient(u, v, g, to));
      }
    };
    check(device_sampler(m, format, chain, state), device_sampler(m, format, permuted, there));
    if (m.name == "exact")
      check(exact_sampler<q>(format, chain, state), exact_sampler<q>(format, permuted, there));
  }));
}

TEST_CASE("any knobs: transposing image and coordinates changes nothing in exact arithmetic") {
  CHECK(rc::check([] {
    const filter_model m = any_knobs();
    const sampler_state state = any_state();
    sampler_state turned = state;
    std::swap(turned.u, turned.v);
    const image<q> in = any_image(*rc::gen::inRange(1, 10), *rc::gen::inRange(1, 10));
    image<q> transposed(in.height, in.width);
    for (int y = 0; y < in.height; ++y)
      for (int x = 0; x < in.width; ++x) transposed.at(y, x) = in.at(x, y);
    const q u(any_coordinate()), v(any_coordinate());
    RC_ASSERT(sample_level<q>(m, in, u, v, state, 0) ==
              sample_level<q>(m, transposed, v, u, turned, 0));
  }));
}

TEST_CASE("any knobs that do not snap: mirroring changes nothing in exact arithmetic") {
  CHECK(rc::check([] {
    filter_model m = any_knobs();
    m.grid_snap = m.weight_snap = snap::none;
    // The last binary32 number under 1 has no counterpart at 0.
    if (m.clamp == clamp_rule::unit) m.clamp = clamp_rule::indices;
    sampler_state state = any_state();
    state.linear = true;  // a nearest texel's own edge belongs to one side
    const image<q> in = any_image(*rc::gen::inRange(1, 10), *rc::gen::inRange(1, 10));
    image<q> across = in, down = in;
    for (int y = 0; y < in.height; ++y)
      for (int x = 0; x < in.width; ++x) {
        across.at(x, y) = in.at(in.width - 1 - x, y);
        down.at(x, y) = in.at(x, in.height - 1 - y);
      }
    const q u(any_coordinate()), v(any_coordinate()), one(1);
    const q here = sample_level<q>(m, in, u, v, state, 0);
    RC_ASSERT(sample_level<q>(m, across, one - u, v, state, 0) == here);
    RC_ASSERT(sample_level<q>(m, down, u, one - v, state, 0) == here);
  }));
}

TEST_CASE("array layers permute with their results in every preset") {
  CHECK(rc::check([] {
    const filter_model& m = presets[static_cast<std::size_t>(*rc::gen::inRange(0, 8))];
    const int bits = m.order == accumulation::lerp_codes ? 8 : 16;
    stored_texture texture{uniform_format(unorm_encoding(bits), 1), {}};
    for (int layer = 0; layer < 3; ++layer) {
      coded_image base(4, 4, 1);
      for (auto& t : base.texels) t = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << bits));
      texture.layers.push_back({std::move(base)});
    }
    stored_texture turned{texture.format, texture.layers};
    std::rotate(turned.layers.begin(), turned.layers.begin() + 1, turned.layers.end());
    const array_sampler here(m, texture, {}), there(m, turned, {});
    const float u = any_coordinate(), v = any_coordinate();
    for (int layer = 0; layer < 3; ++layer)
      RC_ASSERT(here.lod(u, v, static_cast<float>(layer), 0, 0) ==
                there.lod(u, v, static_cast<float>((layer + 2) % 3), 0, 0));
  }));
}
