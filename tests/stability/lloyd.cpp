// Hard cases 5, 9, 30, 31, 32 and 37: Lloyd relaxation where its sums are poor.
#include <bit>
#include <cmath>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/lloyd_pyramid.hpp"
#include "bitshade/shadow/moments.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// A 64 x 64 map under a light that moves: a plate whose edge and height drift over a ground that
/// waves, so that both occluders' depths change every frame.
image<float> moving_map(int frame) {
  const auto triangle = [](int at, int period) {  // 0 .. 1 .. 0
    const int k = at % (2 * period);
    return static_cast<float>(k < period ? k : 2 * period - k) / static_cast<float>(period);
  };
  image<float> depth(64, 64);
  const float plate = 0.1F + 0.5F * triangle(frame, 977), edge = 64 * triangle(frame, 131);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float ground = 0.85F + 0.1F * triangle(x + y + frame, 23);
      depth.at(x, y) = static_cast<float>((x * 7 + y) % 64) < edge ? plate : ground;
    }
  }
  return depth;
}

image<lloyd_sample> samples_of(const image<float>& depth) {
  image<lloyd_sample> samples(depth.width - 1, depth.height - 1);
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      double m1 = 0, m2 = 0;
      for (int k = 0; k < 4; ++k) {
        const double d = depth.at(x + k % 2, y + k / 2);
        m1 += d / 4;
        m2 += d * d / 4;
      }
      samples.at(x, y) = lloyd_sample_of(m1, m2);
    }
  }
  return samples;
}

void check_splits(const std::vector<double>& splits, int frame) {
  double before = 0;
  for (const double s : splits) {
    if (!(s >= before && s <= 1)) {
      CAPTURE(frame, before, s);
      FAIL("a split is out of order, outside [0,1] or NaN");
    }
    before = s;
  }
}

void run_frames(int frames) {
  // Fields repeat with the scene's period; each is summed once.
  std::vector<lloyd_samples> fields;
  for (int i = 0; i < 512; ++i) fields.emplace_back(samples_of(moving_map(i * 7)).texels);
  lloyd_relaxation relaxation({0.2, 0.4, 0.6, 0.8}, {2, 2});
  lloyd_relaxation again = relaxation;
  for (int frame = 0; frame < frames; ++frame) {
    const auto& field = fields[static_cast<std::size_t>(frame) % fields.size()];
    relaxation.step(field);
    check_splits(relaxation.interior(), frame);
    if (frame < 2048) {
      again.step(field);
      REQUIRE(again.interior() == relaxation.interior());
    }
  }
  // No drift: on a frame that stands still the splits come to rest where a fresh start does.
  lloyd_relaxation fresh(relaxation.interior());
  const int rest = fresh.relax(fields[0], 1000);
  CHECK(rest < 1000);
  check_splits(fresh.interior(), frames);
}

}  // namespace

TEST_CASE("hard case 37: 100,000 frames of a moving light keep splits ordered and finite") {
  run_frames(100000);
}

TEST_CASE("hard case 37: 1,000,000 frames", "[.long]") { run_frames(1000000); }

TEST_CASE("hard cases 5 and 32: a negative variance and mu + sigma past 1") {
  for (const double m1 : {0.0, 0.25, 0.5, 1.0}) {
    for (const double error : {-1e-3, -0x1p-53, 0.0, 0x1p-53, 1e-3}) {
      const auto s = lloyd_sample_of(m1, m1 * m1 + error);
      CAPTURE(m1, error, s.value, s.weight);
      CHECK((s.value >= m1 && s.value <= 1));
      CHECK((s.weight >= 0 && s.weight <= weight_limits{}.high));
    }
  }
}

TEST_CASE("hard case 9: coincident splits are merged, deterministically") {
  const std::vector<double> twice{0.5, 0.25, 0.5, 0.5 + 0x1p-30, 0.0, 1.0};
  CHECK(splits_from(twice) == std::vector<double>{0, 0.25, 0.5, 1});
  CHECK(splits_from(twice, 0x1p-2) == std::vector<double>{0, 0.25, 0.5, 1});
  CHECK(splits_from(twice, 0.375) == std::vector<double>{0, 0.5, 1});
}

TEST_CASE("hard case 30: 16-bit sums lose small weights, which is told; binary32 keeps them") {
  image<lloyd_sample> map(64, 64, 1, {0.5, 0.0});
  map.at(10, 10) = {0.75, 1e-4};
  map.at(40, 50) = {0.25, 1e-4};
  for (const auto& [store, keeps] :
       {std::pair{unorm_encoding(16), false}, {binary16::value, false}, {binary32::value, true}}) {
    const lloyd_pyramid field(map, store);
    const auto sums = field.between(0.6, 0.9);
    CHECK((sums.weight > 0) == keeps);
    CHECK(sums.lost == !keeps);
    if (keeps) CHECK(std::fabs(sums.mean() - 0.75) < 1e-6);
    CHECK_FALSE(field.between(0.45, 0.55).lost);  // samples without weight lose none
    lloyd_relaxation relaxation({0.3, 0.7});
    for (int frame = 0; frame < 100; ++frame) {
      relaxation.step(field);
      check_splits(relaxation.interior(), frame);
    }
  }
}

TEST_CASE("hard case 31: nothing, noise, one depth, more clusters than peaks") {
  const std::vector<double> start{0.2, 0.4, 0.6, 0.8};
  const auto relaxed = [&](const std::vector<lloyd_sample>& samples) {
    lloyd_relaxation relaxation(start);
    const lloyd_samples field(samples);
    const int frames = relaxation.relax(field, 1000);
    CHECK(frames < 200);
    check_splits(relaxation.interior(), frames);
    CHECK(relaxation.teleportations() < 20);
    lloyd_relaxation again(start);
    again.relax(field, 1000);
    CHECK(again.interior() == relaxation.interior());
    return relaxation.interior();
  };
  CHECK(relaxed({}) == start);
  CHECK(relaxed(std::vector<lloyd_sample>(4096, {0.5, 0.0})) == start);  // all weights are noise
  const auto one = relaxed(std::vector<lloyd_sample>(4096, {0.5, 0.001}));
  CHECK(std::count(one.begin(), one.end(), 0.5) >= 1);
  std::vector<lloyd_sample> two(2048, {0.125, 0.001});
  two.resize(4096, {0.875, 0.001});
  const auto both = relaxed(two);
  CHECK(std::count(both.begin(), both.end(), 0.125) >= 1);
  CHECK(std::count(both.begin(), both.end(), 0.875) >= 1);
}
