// Hard cases 8 to 11, 15, 31, 34, 36 and 37 in every format that they concern, through whole runs:
// what tests/stability/{moments,lloyd,evsm,msm}.cpp derive, seen in each storage format.
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/lloyd_pyramid.hpp"
#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"

using namespace bitshade;
using test::format_named;
using test::hard_formats;

namespace {

/// Half of the map near, half far, seen from the middle of the edge at each of these depths.
frame edge(float near, float far, std::vector<float> depths) {
  frame scene;
  scene.name = "edge";
  scene.depth = image<float>(8, 8);
  for (std::size_t i = 0; i < 64; ++i) scene.depth.texels[i] = i % 8 < 4 ? near : far;
  scene.view_width = static_cast<int>(depths.size());
  scene.view_height = 1;
  for (const float t : depths) {
    receiver r;
    r.u = r.v = 0.5F;
    r.t = t;
    r.surface = 1;
    scene.receivers.push_back(r);
  }
  return scene;
}

cell run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how), 1);
}

configuration layered(std::string_view format, std::vector<double> splits) {
  configuration how;
  how.method = technique::lvsm;
  how.format = format;
  how.layers = static_cast<int>(splits.size()) + 1;
  how.splits = split_rule::manual;
  how.manual_splits = std::move(splits);
  how.overlap = 0;
  how.blur_taps = 0;
  return how;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Every storage format, and exact arithmetic.
template <class Use>
void each_format(Use use) {
  for (const auto name : hard_formats) use(std::string(name));
  use(std::string("exact"));
}

}  // namespace

TEST_CASE("hard case 8 in every format: a layer of one step is the step at its depth") {
  // t at the far end of a layer 2^-24 wide: half the map before it, half behind; no floor.
  const float t = 0.5F + 0x1p-24F;
  const frame scene = edge(0.25F, 0.75F, {t});
  each_format([&](const std::string& format) {
    configuration how = layered(format, {0.5, 0.5 + 0x1p-24});
    how.min_variance = 0;
    CAPTURE(format);
    const auto got = run(scene, how);
    CHECK(got.layer[0] == 1);
    CHECK(got.visibility[0] == 0.5);  // 0 and 1 are exact everywhere, and so is their mean
    // A floor would be over 2^30 of the layer's units: it is 1, and lights no more than it must.
    how.min_variance = 1e-5;
    CHECK(std::fabs(run(scene, how).visibility[0] - 1 / 1.25) <= 0x1p-24);
  });
}

TEST_CASE("hard case 9 in every format: coincident splits are one, with the bits of one") {
  const frame scene = edge(0.25F, 0.75F, {0.3F, 0.5F, 0.6F, 0.9F});
  each_format([&](const std::string& format) {
    const auto twice = run(scene, layered(format, {0.5, 0.5 + 0x1p-30, 0.5 + 0x1p-27}));
    CAPTURE(format);
    CHECK(twice.splits == std::vector<double>{0, 0.5, 1});
    CHECK(same_bits(twice.visibility, run(scene, layered(format, {0.5})).visibility));
  });
}

TEST_CASE("hard case 10 in every format: a receiver on a split looks up the nearer layer") {
  // There half of the depths lie in front: half light. The layer behind would see none: all light.
  const frame scene = edge(0.25F, 1.0F, {0.5F, std::nextafter(0.5F, 1.0F)});
  each_format([&](const std::string& format) {
    const auto got = run(scene, layered(format, {0.5}));
    CAPTURE(format, got.visibility[0], got.visibility[1]);
    CHECK(got.layer == std::vector<int>{0, 1});
    CHECK(got.visibility[0] < 0.55);
    CHECK(got.visibility[1] == 1);
  });
}

TEST_CASE("hard case 11 in every format: t = 1 is in the last of any number of layers") {
  const frame scene = edge(0.25F, 1.0F, {1.0F});
  each_format([&](const std::string& format) {
    for (int layers = 1; layers <= 16; ++layers) {
      configuration how;
      how.method = technique::lvsm;
      how.layers = layers;
      how.format = format;
      how.blur_taps = 0;
      for (const bool direct : {false, true}) {
        how.direct_index = direct;
        const auto got = run(scene, how);
        CAPTURE(format, layers, direct, got.visibility[0]);
        CHECK(got.layer[0] == layers - 1);
        CHECK((got.visibility[0] >= 0.45 && got.visibility[0] <= 0.55));
      }
    }
  });
}

TEST_CASE("hard case 15 in every format: light below the cap, a sentence above it") {
  const frame scene = edge(0.125F, 1.0F, {0.125F, 0.5F, 1.0F});
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const double cap = exponent_cap(e);
    for (const technique method : {technique::evsm2, technique::evsm4}) {
      configuration how;
      how.method = method;
      how.format = name;
      how.blur_taps = 25;
      how.blur_sigma = 8;
      how.slope_term = true;
      how.exponent = how.negative_exponent = cap * (1 - 0x1p-20);
      CAPTURE(how.format, cap);
      for (const double p : run(scene, how).visibility) CHECK((p >= 0 && p <= 1));
      how.exponent = cap * 1.001;
      if (ends_at_one(e)) {
        CHECK_THROWS_AS(run(scene, how), usage_error);  // beyond what any warp takes
      } else {
        CHECK_THROWS_WITH(run(scene, how), Catch::Contains("overflows when squared in"));
      }
    }
  }
}

TEST_CASE("hard case 31 in every format: poor fields leave splits finite, ordered and at rest") {
  std::mt19937 random(3);
  std::vector<image<lloyd_sample>> fields(4, image<lloyd_sample>(16, 16, 1, {0.5, 0.0}));
  for (auto& s : fields[1].texels) s.weight = 0x1p-20 * (random() % 4);       // all noise
  for (auto& s : fields[2].texels) s.weight = 0.005;                          // one depth
  for (std::size_t i = 0; i < 256; ++i) {                                     // two peaks
    fields[3].texels[i] = {i < 128 ? 0.125 : 0.875, 0.005};
  }
  for (const auto name : hard_formats) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const lloyd_pyramid field(fields[k], format_named(name));
      lloyd_relaxation relaxation({0.2, 0.4, 0.6, 0.8}), again = relaxation;
      const int frames = relaxation.relax(field, 400);
      again.relax(field, 400);
      CAPTURE(std::string(name), k, frames, relaxation.interior());
      CHECK(frames < 400);
      CHECK(relaxation.teleportations() < 20);
      CHECK(relaxation.interior() == again.interior());
      CHECK(std::is_sorted(relaxation.interior().begin(), relaxation.interior().end()));
      for (const double s : relaxation.interior()) CHECK((s >= 0 && s <= 1));
    }
  }
}

TEST_CASE("hard case 34 in every format: two components at a depth edge; four are the cure") {
  // The background drags the mean of w+ past the receiver: all light, where half is right.
  const frame scene = edge(0.2F, 1.0F, {0.6F});
  each_format([&](const std::string& format) {
    configuration how;
    how.format = format;
    how.blur_taps = 0;
    how.exponent = how.negative_exponent = 5;
    how.method = technique::evsm2;
    CHECK(run(scene, how).visibility[0] == 1);
    how.method = technique::evsm4;
    const double p = run(scene, how).visibility[0];
    CAPTURE(format, p);
    // (4) in w-: 1/2 + e^(-2) at most; an eighth of it for the noise of 8 bits.
    CHECK(p < (0.5 + std::exp(-2.0)) * 1.125);
  });
}

TEST_CASE("hard case 36 in every format and technique: alpha next to 1 leaves light in [0,1]") {
  const frame scene = edge(0.25F, 0.75F, {0.125F, 0.25F, 0.5F, 0.75F, 1.0F});
  for (const technique method :
       {technique::vsm, technique::savsm, technique::lvsm, technique::evsm2, technique::evsm4,
        technique::esm, technique::csm, technique::msm}) {
    each_format([&](const std::string& format) {
      configuration how;
      how.method = method;
      how.layers = method == technique::lvsm ? 3 : 1;
      how.format = format;
      how.blur_taps = 3;
      for (const double alpha : {1 - 0x1p-10, 1 - 0x1p-24}) {
        how.bleeding_reduction = alpha;
        const auto lit = run(scene, how).visibility;
        for (const double p : lit) {
          CAPTURE(how.key(), p);
          CHECK((p >= 0 && p <= 1));
        }
        if (stores_variance(method)) CHECK(lit.front() == 1);  // in front of everything
      }
    });
  }
}

TEST_CASE("hard case 37 in every format: sums of a moving light lead no split astray") {
  const auto field_at = [](int frame) {
    image<lloyd_sample> map(16, 16);
    for (int i = 0; i < 256; ++i) {
      const double near = 0.1 + 0.001 * (frame % 400), far = 0.8 + 0.0005 * (frame % 300);
      map.texels[static_cast<std::size_t>(i)] = {i % 5 < 2 ? near : far,
                                                 i % 3 == 0 ? 0.0 : 1e-4 * (1 + i % 7)};
    }
    return map;
  };
  for (const auto name : hard_formats) {
    lloyd_relaxation relaxation({0.25, 0.5, 0.75}, {2, 2});
    for (int frame = 0; frame < 400; ++frame) {
      relaxation.step(lloyd_pyramid(field_at(frame), format_named(name)));
      double before = 0;
      for (const double s : relaxation.interior()) {
        CAPTURE(std::string(name), frame, s);
        REQUIRE((s >= before && s <= 1));
        before = s;
      }
    }
  }
}
