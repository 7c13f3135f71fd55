// Kernels against the templates that define them, and what must not change a bit.
#include "run/pipeline.hpp"

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>

#include "bitshade/shadow/moment_map.hpp"
#include "io/error.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

const std::vector<std::string> formats{"unorm8",   "unorm16", "half",    "bfloat16", "binary32",
                                       "binary64", "unorm24", "snorm16", "e5m7",     "exact"};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

cell run(const frame& scene, const configuration& how, int threads = 0) {
  return run_pipeline(scene, how, make_plan(scene, how), threads);
}

/// The templated pipeline of format F against the run of the format of that name.
template <class F>
void check_definition(const std::string& name, bool slope_term = false) {
  const auto scene = test::small_frame(23, 17, 200, 7);
  configuration how;
  how.method = technique::lvsm;
  how.format = name;
  how.layers = 3;
  how.overlap = 0.03;
  how.slope_term = slope_term;
  const auto got = run(scene, how);
  std::vector<moment_map<policy<F>>> maps;
  for (const auto& layer : layer_intervals(got.splits, how.overlap)) {
    maps.emplace_back(scene.depth, layer, gaussian_kernel(how.blur_taps, how.blur_sigma),
                      address::clamp, slope_term);
  }
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const receiver& r = scene.receivers[i];
    if (r.surface == 0) continue;
    const auto layer = static_cast<std::size_t>(layer_of(r.t, got.splits));
    const auto expected =
        static_cast<double>(maps[layer].visibility(r.u, r.v, r.t, how.min_variance));
    CAPTURE(name, i, r.t, layer, expected, got.visibility[i]);
    REQUIRE(got.visibility[i] == expected);
  }
}

}  // namespace

TEST_CASE("row kernels and run-time rounding equal the templated definition") {
  check_definition<unorm8>("unorm8");
  check_definition<unorm16>("unorm16");
  check_definition<unorm24>("unorm24");
  check_definition<snorm16>("snorm16");
  check_definition<binary16>("half");
  check_definition<bfloat16>("bfloat16");
  check_definition<binary<5, 7>>("e5m7");
  check_definition<binary32>("binary32");
  check_definition<binary64>("binary64");
  check_definition<unorm16>("unorm16", true);
  check_definition<binary16>("half", true);
  check_definition<binary64>("binary64", true);
}

TEST_CASE("an LVSM of one layer is a VSM, bit for bit, in every format") {
  const auto scene = test::small_frame(31, 20, 400, 8);
  for (const auto& format : formats) {
    configuration vsm;
    vsm.format = format;
    configuration lvsm = vsm;
    lvsm.method = technique::lvsm;
    for (const auto rule : {split_rule::uniform, split_rule::lloyd}) {
      lvsm.splits = rule;
      CAPTURE(format);
      CHECK(same_bits(run(scene, vsm).visibility, run(scene, lvsm).visibility));
    }
  }
}

TEST_CASE("any number of threads and any floating-point environment gives the same bits") {
  const auto scene = test::small_frame(64, 48, 3000, 9);
  for (const auto& format : formats) {
    configuration how;
    how.method = technique::lvsm;
    how.format = format;
    how.layers = 4;
    how.splits = split_rule::lloyd;
    const auto one = run(scene, how, 1);
    CAPTURE(format);
    CHECK(same_bits(one.visibility, run(scene, how, 2).visibility));
    CHECK(same_bits(one.visibility, run(scene, how, 7).visibility));
    std::fesetround(FE_UPWARD);
    const auto hostile = run(scene, how, 2);
    const int mode = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(mode == FE_UPWARD);
    CHECK(same_bits(one.visibility, hostile.visibility));
  }
}

TEST_CASE("a plan leaves out nothing that changes a bit") {
  for (const bool tiny : {false, true}) {
    const auto scene = test::small_frame(32, 16, 500, 10, tiny);
    for (const auto& format : {"unorm16", "half", "e5m7", "binary32", "exact"}) {
      for (const int layers : {1, 4, 9}) {
        configuration how;
        how.method = technique::lvsm;
        how.format = format;
        how.layers = layers;
        how.transition = true;
        how.filter = layers == 4 ? texel_filter::trilinear : texel_filter::bilinear;
        const auto p = make_plan(scene, how);
        const auto lean = run_pipeline(scene, how, p),
                   full = run_pipeline(scene, how, p.everything());
        CAPTURE(how.key(), tiny);
        CHECK(same_bits(lean.visibility, full.visibility));
      }
    }
  }
}

TEST_CASE("a plan says what a frame needs, and why not") {
  auto scene = test::small_frame(32, 16, 100, 11);
  for (auto& r : scene.receivers) {
    r.t = 0.9F;
    r.surface = 2;
    r.du_dx = r.dv_dy = 0x1p-8F;
    r.du_dy = r.dv_dx = 0;
  }
  for (auto& x : scene.depth.texels) x = 0.5F;
  configuration how;
  how.method = technique::lvsm;
  how.format = "half";
  how.layers = 4;
  how.transition = true;
  how.filter = texel_filter::trilinear;
  const auto p = make_plan(scene, how);
  const auto find = [&](const std::string& name) {
    for (const auto& e : p.effects) {
      if (e.name == name) return e;
    }
    FAIL("no effect named " + name);
    return effect{};
  };
  CHECK(find("overlap").simulated());
  CHECK(find("overlap").evidence == "100 of 100 receivers look up a layer that it widens");
  CHECK(find("transition").asked);
  CHECK_FALSE(find("transition").needed);
  CHECK(find("transition").evidence == "0 of 100 receivers lie in an overlap");
  CHECK_FALSE(find("mips").needed);
  CHECK_FALSE(find("anisotropy").asked);
  CHECK_FALSE(find("subnormals").needed);
  CHECK(find("layers without receivers").evidence == "3 of 4 layers have no receiver");
  CHECK_FALSE(find("layers without receivers").needed);

  scene.receivers[5].t = 0.75F;
  scene.receivers[6].du_dx = 1;
  scene.depth.at(3, 3) = 0.9376F;  // phi^2 of the last layer is a half, and that of 0.7401 is not
  scene.depth.at(4, 3) = 0.7401F;
  const auto changed = make_plan(scene, how);
  CHECK(changed.simulates("transition"));
  CHECK(changed.simulates("mips"));
  CHECK(changed.simulates("subnormals"));
}

TEST_CASE("exact pcf is the truth, and hard tests are one texel") {
  const auto scene = test::small_frame(32, 16, 300, 12);
  configuration how;
  how.method = technique::pcf;
  how.format = "exact";
  CHECK(same_bits(run(scene, how).visibility, truth_pcf(scene, how)));
  how.method = technique::hard;
  const auto hard = run(scene, how);
  how.format = "binary32";
  CHECK(same_bits(hard.visibility, run(scene, how).visibility));
  for (const double p : hard.visibility) CHECK((p != p || p == 0 || p == 1));
  how.method = technique::pcf;
  how.format = "binary64";
  const auto wide = run(scene, how);
  const auto truth = truth_pcf(scene, how);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // 100 products and sums of numbers up to 1, each to within 2^-53.
    if (truth[i] == truth[i]) CHECK(std::fabs(wide.visibility[i] - truth[i]) <= 300 * 0x1p-53);
  }
}

TEST_CASE("a depth bias leaves lit what a format's rounding would shade, and nothing beyond") {
  frame scene = test::small_frame(16, 16, 40, 5);
  const float plane = 0.9F;  // unorm16 and half store it as less
  for (float& x : scene.depth.texels) x = plane;
  for (receiver& r : scene.receivers) r.t = plane, r.surface = 2;
  for (const technique method : {technique::hard, technique::pcf, technique::deep}) {
    configuration how;
    how.method = method;
    const auto light = [&](const char* format, double bias, float t) {
      for (receiver& r : scene.receivers) r.t = t;
      how.format = format;
      how.depth_bias = bias;
      const auto shown = run(scene, how).visibility;
      REQUIRE(std::all_of(shown.begin(), shown.end(),
                          [&](double p) { return std::fabs(p - shown.front()) <= 0x1p-20; }));
      return std::round(shown.front() * 0x1p16) * 0x1p-16;  // sums of the kernel's weights
    };
    CAPTURE(name_of(method));
    CHECK(light("unorm16", 0, plane) == 0);
    CHECK(light("half", 0, plane) == 0);
    CHECK(light("unorm16", 1.0 / 65535, plane) == 1);
    CHECK(light("half", 0x1p-12, plane) == 1);
    for (const char* const format : {"binary32", "binary64", "exact"}) {
      CAPTURE(format);
      const float behind = plane + 0x1p-10F;  // exact: both lie in [1/2, 1)
      CHECK(light(format, 0, plane) == 1);
      CHECK(light(format, 0x1p-10, behind) == 1);
      CHECK(light(format, 0x1p-10 - 0x1p-24, behind) == 0);
    }
  }
}

TEST_CASE("a depth bias under a format's half step is noted") {
  const auto scene = test::small_frame(8, 8, 10, 5);
  configuration how;
  how.method = technique::pcf;
  const auto notes = [&](const char* format, double bias) {
    how.format = format;
    how.depth_bias = bias;
    return run(scene, how).notes.size();
  };
  CHECK(notes("unorm16", 0x1p-18) == 1);
  CHECK(notes("unorm16", 0x1p-16) == 0);
  CHECK(notes("half", 0x1p-13) == 1);
  CHECK(notes("half", 0x1p-12) == 0);
  CHECK(notes("binary32", 0) == 0);  // a map is binary32 already
  CHECK(notes("exact", 0) == 0);
}

TEST_CASE("a name that is no format is refused with the nearest one") {
  const auto scene = test::small_frame(8, 8, 4, 13);
  configuration how;
  how.format = "unorn16";
  try {
    run(scene, how);
    FAIL("accepted");
  } catch (const usage_error& e) {
    CHECK(std::string(e.what()).find("unorm16") != std::string::npos);
  }
  how.format = "unorm16";
  how.blur_taps = 2;
  CHECK_THROWS_AS(make_plan(scene, how), usage_error);
}
