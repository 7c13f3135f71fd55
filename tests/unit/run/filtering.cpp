// Samples, ways to blur, kernels and several lookups: against their definitions in every format,
// and against rationals and closed forms in exact arithmetic.
#include <bit>
#include <cmath>

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/bilinear.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/resolve.hpp"
#include "run/lookup.hpp"
#include "run/pipeline.hpp"
#include "run/storage.hpp"
#include "support/catch.hpp"
#include "support/exactly.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;
using test::nearest_double;

namespace {

using q = exact_rational;

cell run(const frame& scene, const configuration& how, int threads = 2) {
  return run_pipeline(scene, how, make_plan(scene, how), threads);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// A VSM's texels by definition: moments of every sample, stored; resolved and stored; blurred the
/// way that is asked for, and stored.
template <class T, class Store>
image<T> texels_of(const frame& scene, const configuration& how, Store store) {
  std::vector<image<T>> samples;
  for (const image<float>* map : depth_maps(scene, how.filtered.msaa)) {
    image<T>& out = samples.emplace_back(map->width, map->height, 2);
    for (int y = 0; y < map->height; ++y) {
      warp_row<T>(map->row(y), interval{0, 1}, out.row(y), 2);
      square_row<T>(out.row(y), 2);
    }
    store(out);
  }
  image<T> texels = samples.front();
  if (samples.size() > 1) {
    for (int y = 0; y < texels.height; ++y) resolve_row<T>(samples, y, texels.row(y));
    store(texels);
  }
  const kernel blur = blur_of(how);
  const auto taps = linear_taps(blur, how.filtered.fraction_bits);
  image<T> across = texels;
  for (int y = 0; y < texels.height; ++y) {
    if (how.filtered.way == blur_way::one_pass)
      blur_row_square<T>(texels, blur, map_address, y, across.row(y));
    else if (how.filtered.way == blur_way::linear)
      blur_row_linear<T>(texels, taps, map_address, y, across.row(y));
    else
      blur_row_x<T>(texels, blur, map_address, y, across.row(y));
  }
  store(across);
  if (how.filtered.way == blur_way::one_pass) return across;
  for (int y = 0; y < texels.height; ++y) {
    if (how.filtered.way == blur_way::linear)
      blur_column_linear<T>(across, taps, map_address, y, texels.row(y));
    else
      blur_row_y<T>(across, blur, map_address, y, texels.row(y));
  }
  store(texels);
  return texels;
}

/// The light of a lookup, and the mean of several.
template <class T>
T light_of(const image<T>& texels, const configuration& how, const receiver& r) {
  T sum(0);
  int count = 0;
  each_lookup(r, how.filtered.lookups, texels.width, texels.height, [&](const receiver& at) {
    const auto taps = locate<T>(T(at.u), T(at.v), texels.width, texels.height, map_address);
    const T p = chebyshev(mean_and_variance(bilinear(texels, taps, 0), bilinear(texels, taps, 1)),
                          clamp_depth(T(r.t)), layer_floor<T>(how.min_variance, {0, 1}));
    const T lit = how.bleeding_reduction == 0
                      ? p
                      : reduce_bleeding(p, static_cast<T>(on_split_grid(how.bleeding_reduction)));
    sum = count++ == 0 ? lit : sum + lit;
  });
  return sum / T(count);
}

std::vector<configuration> variants() {
  std::vector<configuration> all;
  const auto add = [&](auto change) {
    configuration how;
    how.blur_taps = 5;
    change(how);
    all.push_back(how);
  };
  add([](configuration& c) { c.filtered.msaa = 2; });
  add([](configuration& c) { c.filtered.msaa = 4; });
  add([](configuration& c) { c.filtered.msaa = 8, c.blur_taps = 0; });
  add([](configuration& c) { c.filtered.way = blur_way::one_pass; });
  add([](configuration& c) { c.filtered.way = blur_way::one_pass, c.blur_taps = 3; });
  add([](configuration& c) { c.filtered.way = blur_way::linear, c.blur_taps = 9; });
  add([](configuration& c) { c.filtered.way = blur_way::linear, c.filtered.fraction_bits = 0; });
  add([](configuration& c) { c.filtered.shape = blur_shape::box, c.blur_taps = 3; });
  add([](configuration& c) { c.filtered.lookups = 3, c.blur_taps = 0; });
  add([](configuration& c) {
    c.filtered.msaa = 4, c.filtered.lookups = 3, c.bleeding_reduction = 0.25;
    c.filtered.way = blur_way::linear;
  });
  return all;
}

}  // namespace

TEST_CASE("samples, ways to blur and lookups are their definitions, bit for bit, in every format") {
  for (configuration how : variants()) {
    const auto scene = test::with_samples(test::small_frame(17, 13, 80, 31), how.filtered.msaa, 32);
    for (const auto& name : {"unorm8", "unorm16", "snorm16", "half", "bfloat16", "binary32"}) {
      how.format = name;
      const storage_format format = storage_named(name);
      const auto texels = texels_of<float>(scene, how, [&](image<float>& out) {
        for (int y = 0; y < out.height; ++y) round_row(format, out.row(y));
      });
      const auto got = run(scene, how);
      for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
        const receiver& r = scene.receivers[i];
        if (r.surface == 0) continue;
        const double expected = static_cast<double>(light_of<float>(texels, how, r));
        CAPTURE(how.key(), i, got.visibility[i], expected);
        REQUIRE(got.visibility[i] == expected);
      }
    }
  }
}

TEST_CASE("in exact arithmetic they are rationals rounded once: blurs of any way are one blur") {
  for (configuration how : variants()) {
    const auto scene = test::with_samples(test::small_frame(9, 8, 25, 33), how.filtered.msaa, 34);
    how.format = "exact";
    how.min_variance = 1e-7;
    configuration plain = how;  // exact kernels have no fractions and no passes
    plain.filtered.way = blur_way::separable;
    const auto texels = texels_of<q>(scene, plain, [](image<q>&) {});
    const auto got = run(scene, how);
    for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
      const receiver& r = scene.receivers[i];
      if (r.surface == 0) continue;
      const double expected = nearest_double(light_of<q>(texels, how, r));
      CAPTURE(how.key(), i, got.visibility[i], expected);
      REQUIRE(got.visibility[i] == expected);
    }
  }
}

TEST_CASE("two planes under one texel: coverage by samples gives the exact light") {
  // Receivers on the far plane, k of n samples on the near one: p is the uncovered share (C1).
  for (const int n : {2, 4, 8}) {
    for (int covered = 0; covered <= n; ++covered) {
      frame scene = test::with_samples(test::small_frame(4, 4, 1, 1), n, 1);
      scene.receivers[0] = receiver{};
      scene.receivers[0].u = scene.receivers[0].v = 0.375F;
      scene.receivers[0].t = 0.75F;
      scene.receivers[0].surface = 1;
      for (float& x : scene.depth.texels) x = 0.75F;
      for (int s = 0; s < n; ++s) {
        for (float& x : scene.samples.at(n)[static_cast<std::size_t>(s)].depth.texels)
          x = s < covered ? 0.25F : 0.75F;
      }
      configuration how;
      how.blur_taps = 0;
      how.min_variance = 0;
      how.filtered.msaa = n;
      const double expected = 1 - static_cast<double>(covered) / n;
      for (const technique method : {technique::vsm, technique::pcf, technique::savsm}) {
        how.method = method;
        for (const auto& format : {"exact", "binary32", "half"}) {
          how.format = format;
          CAPTURE(n, covered, how.key());
          CHECK(run(scene, how).visibility[0] == expected);
        }
      }
      CHECK(truth_pcf(scene, how)[0] == expected);
    }
  }
}

TEST_CASE("equal samples are left out with evidence, and simulating them changes no bit") {
  auto scene = test::small_frame(16, 16, 60, 41);
  for (const sample_position at : sample_pattern(8)) {
    scene.samples[8].push_back({scene.depth, scene.surface, at});
  }
  for (const technique method :
       {technique::pcf, technique::vsm, technique::lvsm, technique::savsm, technique::evsm4,
        technique::esm, technique::csm, technique::msm}) {
    for (const auto& format : {"unorm16", "half", "binary32", "exact"}) {
      configuration how, single;
      how.method = method;
      how.format = format;
      how.exponent = how.negative_exponent = 4;
      how.layers = method == technique::lvsm ? 2 : 1;
      if (method == technique::savsm)
        how.format = std::string(format) == "half" ? "snorm16" : format;
      single = how;
      how.filtered.msaa = 8;
      const plan p = make_plan(scene, how);
      CAPTURE(how.key());
      CHECK_FALSE(p.simulates("msaa"));
      CHECK(p.effects.back().evidence == "0 of 256 texels have samples of several depths");
      const auto lean = run_pipeline(scene, how, p, 2);
      CHECK(same_bits(lean.visibility, run_pipeline(scene, how, p.everything(), 2).visibility));
      CHECK(same_bits(lean.visibility, run(scene, single).visibility));
    }
  }
  scene.samples.at(8)[3].depth.at(2, 2) = 0.125F;
  configuration how;
  how.filtered.msaa = 8;
  const plan p = make_plan(scene, how);
  CHECK(p.simulates("msaa"));
  CHECK(p.effects.back().evidence == "1 of 256 texels have samples of several depths");
}

TEST_CASE("every technique takes samples and lookups: plan right, light in [0,1], any threads") {
  const auto scene = test::with_samples(test::small_frame(15, 11, 40, 51), 4, 52);
  for (const technique method :
       {technique::pcf, technique::vsm, technique::lvsm, technique::savsm, technique::evsm2,
        technique::evsm4, technique::esm, technique::csm, technique::msm}) {
    for (const auto& format : {"unorm16", "half", "binary32", "exact"}) {
      configuration how;
      how.method = method;
      how.format = format;
      how.exponent = how.negative_exponent = 4;
      how.terms = 2;
      how.blur_taps = 3;
      how.layers = method == technique::lvsm ? 3 : 1;
      how.transition = true;
      how.filter = texel_filter::trilinear;
      how.max_anisotropy = 3;
      how.filtered = {4, blur_shape::gaussian, blur_way::one_pass, 8, 3};
      const plan p = make_plan(scene, how);
      const auto one = run_pipeline(scene, how, p, 1),
                 all = run_pipeline(scene, how, p.everything(), 3);
      CAPTURE(how.key());
      CHECK(same_bits(one.visibility, all.visibility));
      for (const double v : one.visibility) CHECK((v != v || (v >= 0 && v <= 1)));
    }
  }
}
