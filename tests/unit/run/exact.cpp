// The integer engines return what rationals return, bit for bit.
#include <algorithm>
#include <cstring>

#include "bitshade/shadow/moment_map.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/lookup.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/exactly.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;
using test::nearest_double;

namespace {

using q = exact_rational;

configuration exact_lvsm(int layers) {
  configuration how;
  how.method = technique::lvsm;
  how.format = "exact";
  how.layers = layers;
  how.blur_taps = 5;
  how.overlap = 0.0625;
  return how;
}

/// The definition in rationals: every lookup from scratch, the layer's division included.
q light_in_layer(const moment_map<policy<q>>& map, const frame& scene, const receiver& r,
                 const configuration& how, const interval& layer) {
  if (how.filter != texel_filter::trilinear && how.max_anisotropy == 1) {
    return map.visibility(r.u, r.v, r.t, how.min_variance);
  }
  const auto chain = mip_chain(map.texels(), map_mips, [](std::span<q>) {});
  const std::size_t levels = how.filter == texel_filter::trilinear ? chain.size() : 1;
  const std::span<const image<q>> used(chain.data(), levels);
  const auto probes = probes_of(r, scene.depth.width, scene.depth.height, how.max_anisotropy);
  const q m1 = anisotropic<q>(used, q(r.u), q(r.v), probes, map_address, 0, map_mip_bits);
  const q m2 = anisotropic<q>(used, q(r.u), q(r.v), probes, map_address, 1, map_mip_bits);
  return chebyshev(mean_and_variance(m1, m2), warp(clamp_depth(q(r.t)), layer),
                   layer_floor<q>(how.min_variance, layer));
}

void check_against_rationals(const frame& scene, const configuration& how) {
  const auto p = make_plan(scene, how);
  const auto got = run_pipeline(scene, how, p);
  const auto intervals = layer_intervals(got.splits, how.overlap);
  std::vector<moment_map<policy<q>>> maps;
  for (const auto& layer : intervals) {
    maps.emplace_back(scene.depth, layer,
                      gaussian_kernel(std::max(1, how.blur_taps), how.blur_sigma), map_address,
                      how.slope_term);
  }
  const auto in_layer = [&](const receiver& r, int i) {
    const auto k = static_cast<std::size_t>(i);
    return light_in_layer(maps[k], scene, r, how, intervals[k]);
  };
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const receiver& r = scene.receivers[i];
    if (r.surface == 0) {
      REQUIRE(got.visibility[i] != got.visibility[i]);
      continue;
    }
    q expected;
    if (how.lookup == layer_lookup::every) {
      expected = in_layer(r, 0);
      for (int k = 1; k < static_cast<int>(maps.size()); ++k) {
        const q other = in_layer(r, k);
        if (other < expected) expected = other;
      }
    } else if (how.transition) {
      const auto pair = blended_layers(q(r.t), got.splits, how.overlap);
      expected = in_layer(r, pair.near);
      if (pair.near != pair.far) {
        const q share =
            transition_share(q(r.t), got.splits[static_cast<std::size_t>(pair.far)], how.overlap);
        expected = lerp(expected, in_layer(r, pair.far), share);
      }
    } else {
      expected = in_layer(r, layer_of(q(r.t), got.splits));
    }
    if (how.bleeding_reduction > 0) {
      expected = reduce_bleeding(expected, q(on_split_grid(how.bleeding_reduction)));
    }
    CAPTURE(how.key(), i, r.u, r.v, r.t, got.visibility[i], nearest_double(expected));
    REQUIRE(got.visibility[i] == nearest_double(expected));
  }
}

}  // namespace

TEST_CASE("exact layers in integers equal rationals: splits, ties, overlaps") {
  const auto scene = test::small_frame(19, 16, 60, 1);
  for (const int layers : {1, 2, 4}) check_against_rationals(scene, exact_lvsm(layers));
  auto manual = exact_lvsm(3);
  manual.splits = split_rule::manual;
  manual.manual_splits = {0.25, 0.75};
  manual.overlap = 0;
  manual.min_variance = 1e-7;
  check_against_rationals(scene, manual);
}

TEST_CASE("exact layers in integers equal rationals: transition, every layer, less bleeding") {
  const auto scene = test::small_frame(16, 16, 60, 2);
  auto how = exact_lvsm(3);
  how.transition = true;
  check_against_rationals(scene, how);
  how.bleeding_reduction = 0.3;
  check_against_rationals(scene, how);
  how.transition = false;
  how.lookup = layer_lookup::every;
  check_against_rationals(scene, how);
}

TEST_CASE("exact layers in integers equal rationals: depths of any binary32, no floor") {
  const auto scene = test::small_frame(9, 12, 40, 3, true);
  auto how = exact_lvsm(2);
  check_against_rationals(scene, how);
  how.min_variance = 0;
  how.blur_taps = 0;
  check_against_rationals(scene, how);
}

TEST_CASE("exact layers in integers equal rationals: mips and anisotropy") {
  auto scene = test::small_frame(16, 8, 24, 4);
  auto how = exact_lvsm(2);
  how.blur_taps = 3;
  how.filter = texel_filter::trilinear;
  check_against_rationals(scene, how);
  how.max_anisotropy = 5;
  check_against_rationals(scene, how);
  how.filter = texel_filter::bilinear;
  check_against_rationals(scene, how);
  check_against_rationals(test::small_frame(7, 11, 12, 5, true), how);
}

TEST_CASE("exact layers in integers equal rationals: the slope term") {
  auto how = exact_lvsm(2);
  how.slope_term = true;
  check_against_rationals(test::small_frame(12, 14, 40, 14), how);
  check_against_rationals(test::small_frame(9, 12, 30, 15, true), how);
}

TEST_CASE("percentage-closer filtering equals its sum in rationals") {
  const auto scene = test::small_frame(13, 8, 40, 6);
  configuration how;
  how.blur_taps = 5;
  for (const auto filter :
       {texel_filter::nearest, texel_filter::bilinear, texel_filter::trilinear}) {
    how.filter = filter;
    how.max_anisotropy = filter == texel_filter::trilinear ? 3 : 1;
    const auto got = truth_pcf(scene, how);
    const auto weights = gaussian_kernel(how.blur_taps, how.blur_sigma);
    for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
      const receiver& r = scene.receivers[i];
      if (r.surface == 0) continue;
      // The blurred, filtered image of "x >= t", made by the definition's own stages.
      image<q> lit(scene.depth.width, scene.depth.height);
      for (std::size_t k = 0; k < lit.texels.size(); ++k) {
        lit.texels[k] = q(scene.depth.texels[k] >= r.t ? 1 : 0);
      }
      image<q> across = lit, both = lit;
      for (int y = 0; y < lit.height; ++y)
        blur_row_x<q>(lit, weights, map_address, y, across.row(y));
      for (int y = 0; y < lit.height; ++y)
        blur_row_y<q>(across, weights, map_address, y, both.row(y));
      q expected;
      if (filter == texel_filter::trilinear) {
        const auto chain = mip_chain(both, map_mips, [](std::span<q>) {});
        const auto probes = probes_of(r, lit.width, lit.height, how.max_anisotropy);
        expected = anisotropic<q>(std::span<const image<q>>(chain), q(r.u), q(r.v), probes,
                                  map_address, 0, map_mip_bits);
      } else {
        const lookup look{filter, false, 1};
        expected = bilinear(both, plain_taps<q>(look, q(r.u), q(r.v), lit.width, lit.height), 0);
      }
      CAPTURE(i, r.u, r.v, r.t, got[i], nearest_double(expected));
      REQUIRE(got[i] == nearest_double(expected));
    }
  }
}
