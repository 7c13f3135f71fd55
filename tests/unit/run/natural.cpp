// Texels that lie in memory as their format's bits give the bits of values rounded in place.
#include <bit>

#include "run/device_cost.hpp"
#include "run/pipeline.hpp"
#include "run/timing.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

/// Whether both speeds give the same bits; and whether natural storage was there.
bool natural_is_emulated(const frame& scene, const configuration& how) {
  CAPTURE(how.key());
  const plan effects = make_plan(scene, how);
  const cell a = run_pipeline(scene, how, effects);
  const cell b = run_pipeline(scene, how, effects, 0, storage_speed::natural);
  CHECK(!a.natural);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < a.visibility.size(); ++i)
    differ += std::bit_cast<std::uint64_t>(a.visibility[i]) !=
              std::bit_cast<std::uint64_t>(b.visibility[i]);
  CHECK(differ == 0);
  if (b.natural) CHECK(b.emulation_seconds == 0);
  return b.natural;
}

}  // namespace

TEST_CASE("natural storage gives the bits of emulation", "[run]") {
  const frame scene = test::small_frame(61, 45, 700, 9);
  int natural = 0;
  for (const technique method :
       {technique::hard, technique::pcf, technique::vsm, technique::lvsm, technique::evsm2,
        technique::evsm4, technique::esm, technique::csm, technique::msm, technique::savsm}) {
    for (const char* format :
         {"unorm8", "unorm16", "half", "bfloat16", "unorm32", "binary32", "unorm12", "binary64"}) {
      configuration how;
      how.method = method;
      how.format = format;
      how.layers = method == technique::lvsm ? 3 : 1;
      how.bleeding_reduction = 0.125;
      if (method == technique::savsm && how.format == "half") how.blur_taps = 3;
      natural += natural_is_emulated(scene, how);
    }
  }
  CHECK(natural >= 9 * 6);
}

TEST_CASE("filters beyond a plain fetch are natural where they can be, and never wrong", "[run]") {
  frame scene = test::small_frame(32, 24, 300, 4);
  for (int i = 0; i < 4; ++i)
    scene.samples[4].push_back(
        {test::small_frame(32, 24, 1, 20 + static_cast<unsigned>(i)).depth, scene.surface, {}});
  for (const technique method : {technique::pcf, technique::lvsm}) {
    configuration plain;
    plain.method = method;
    plain.layers = method == technique::lvsm ? 2 : 1;
    plain.blur_taps = 5;
    const bool pcf = method == technique::pcf;
    const auto natural = [&](auto change) {
      configuration how = plain;
      change(how);
      return natural_is_emulated(scene, how);
    };
    CHECK(natural([](configuration& c) { c.filtered.shape = blur_shape::box; }));
    CHECK(natural([](configuration& c) { c.one_pass = true; }));
    CHECK(natural([](configuration& c) { c.bleeding_power = 1.5; }));
    // PCF blurs answers, and loads depths wherever it reads them.
    CHECK(natural([](configuration& c) { c.filtered.way = blur_way::one_pass; }) == pcf);
    CHECK(natural([](configuration& c) { c.filtered.lookups = 3; }) == pcf);
    CHECK(natural([](configuration& c) { c.filtered.msaa = 4; }) == pcf);
    CHECK(natural([](configuration& c) { c.transition = true; }) == pcf);
    CHECK(natural([](configuration& c) {
      c.filtered.lookups = 3;
      c.format = "binary32";  // native arithmetic is its storage
    }));
  }
}

TEST_CASE("median and quartiles", "[run]") {
  CHECK(spread_of({}).median == 0);
  const spread one = spread_of({3});
  CHECK((one.median == 3 && one.low == 3 && one.high == 3));
  const spread four = spread_of({4, 1, 3, 2});
  CHECK((four.median == 2.5 && four.low == 1.75 && four.high == 3.25));
}

TEST_CASE("a device's passes, fetches and bytes", "[run]") {
  frame scene = test::small_frame(64, 32, 100, 5);
  std::size_t receivers = 0;
  for (receiver& r : scene.receivers) r.t = 0.75F, receivers += r.surface != 0;
  const auto cost = [&](technique method, int layers, int blur) {
    configuration how;
    how.method = method;
    how.layers = layers;
    how.blur_taps = blur;
    return device_cost_of(scene, how, make_plan(scene, how),
                          2 * how.channels() * (method == technique::lvsm ? layers : 1));
  };
  const double texels = 64 * 32, samples = static_cast<double>(receivers);
  const device_cost vsm = cost(technique::vsm, 1, 9);
  CHECK(vsm.passes == 3);
  CHECK(vsm.fetches_per_sample == 1);
  // The depth map is read, five maps of 4 bytes are written or read, four texels fetched a sample.
  CHECK(vsm.bytes_per_frame == texels * 4 + 5 * texels * 4 + samples * 4 * 4);
  // Every receiver looks into one of two layers: the other is not made.
  CHECK(cost(technique::lvsm, 2, 9).passes == 3);
  CHECK(cost(technique::lvsm, 2, 9).bytes_per_frame == vsm.bytes_per_frame);
  CHECK(cost(technique::pcf, 1, 9).fetches_per_sample == 25);
  CHECK(cost(technique::pcf, 1, 9).passes == 1);
  const auto changed = [&](technique method, auto change) {
    configuration how;
    how.method = method;
    change(how);
    return device_cost_of(scene, how, make_plan(scene, how), 2 * how.channels());
  };
  const device_cost square =
      changed(technique::vsm, [](auto& c) { c.filtered.way = blur_way::one_pass; });
  CHECK(square.passes == 2);
  CHECK(square.bytes_per_frame == vsm.bytes_per_frame - 2 * texels * 4);
  CHECK(changed(technique::vsm, [](auto& c) { c.filtered.lookups = 3; }).fetches_per_sample == 9);
  // A deep map of 40 bytes a texel: ten steps of two halves; a search of 4 + 1 reads in four texels.
  configuration deep;
  deep.method = technique::deep;
  deep.format = "half";
  const device_cost steps = device_cost_of(scene, deep, make_plan(scene, deep), 40);
  CHECK(steps.fetches_per_sample == 4 * 5);
  CHECK(steps.bytes_per_frame == texels * 4 + texels * 40 + samples * 4 * 5 * 2);
  CHECK(cost(technique::msm, 1, 0).passes == 1);
  CHECK(cost(technique::msm, 1, 0).fetches_per_sample == 1);
}
