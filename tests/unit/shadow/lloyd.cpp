// Splits by Lloyd relaxation and by dynamic programming, against hand-made clusters.
#include "bitshade/shadow/lloyd.hpp"

#include <random>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/lloyd_pyramid.hpp"
#include "bitshade/shadow/optimal_splits.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

std::vector<lloyd_sample> peaks(const std::vector<double>& centres, int each, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<lloyd_sample> samples;
  for (const double c : centres) {
    for (int i = 0; i < each; ++i) {
      const double noise = static_cast<double>(random() >> 40) * 0x1p-24 - 0.5;
      samples.push_back({on_split_grid(c + noise * 0x1p-6), 0x1p-8});
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("a sample is the second occluder, weighted by the variance between its limits") {
  // Half at 0.25, half at 0.75: mu + sigma = 0.75 exactly.
  const auto s = lloyd_sample_of(0.5, 0.3125);
  CHECK(s.value == 0.75);
  CHECK(s.weight == weight_limits{}.high);
  CHECK(lloyd_sample_of(0.5, 0.25 + 1e-5).weight == 0);
  CHECK(lloyd_sample_of(0.5, 0.25 + 1e-3).weight == Approx(1e-3));
  CHECK(lloyd_sample_of(0.5, 0.2).value == 0.5);  // a negative variance is none
  CHECK(lloyd_sample_of(0.9, 0.9).value == 1);    // past 1
}

TEST_CASE("prefix sums are the sums") {
  const auto samples = peaks({0.2, 0.7}, 500, 1);
  const lloyd_samples field(samples);
  for (const auto& [low, high] : {std::pair{0.0, 2.0}, {0.19, 0.2}, {0.2, 0.7}, {0.5, 0.6}}) {
    double weight = 0, first = 0, cost = 0;
    for (const auto& s : samples) {
      if (!(s.value >= low && s.value < high)) continue;
      weight += s.weight;
      first += s.weight * s.value;
      cost += s.weight * (s.value - 0.25) * (s.value - 0.25);
    }
    const auto sums = field.between(low, high);
    CHECK(static_cast<double>(sums.weight) * 0x1p-32 == weight);
    if (weight > 0) CHECK(std::fabs(sums.mean() - first / weight) <= split_grid);
    CHECK(field.cost(low, high, 0.25) == Approx(cost).epsilon(1e-12));
  }
}

TEST_CASE("relaxation finds as many peaks as there are splits, all or two a frame, late or not") {
  const lloyd_samples field(peaks({0.15, 0.4, 0.6, 0.9}, 300, 2));
  for (const int per_frame : {0, 1, 2}) {
    for (const int latency : {0, 1, 3}) {
      lloyd_relaxation relaxation({0.2, 0.4, 0.6, 0.8}, {per_frame, latency});
      const int frames = relaxation.relax(field, 1000);
      CAPTURE(per_frame, latency, frames);
      CHECK(frames < 100);
      const std::vector<double> expected{0.15, 0.4, 0.6, 0.9};
      for (std::size_t i = 0; i < 4; ++i) {
        CHECK(relaxation.interior()[i] == Approx(expected[i]).margin(0x1p-6));
      }
    }
  }
}

TEST_CASE("relaxation never raises the cost, and teleports out of a bad start") {
  const lloyd_samples field(peaks({0.1, 0.11, 0.12, 0.95}, 200, 3));
  const std::vector<double> start{0.3, 0.5, 0.6};
  const auto cost_of = [&](const lloyd_relaxation& relaxation) {
    return lloyd_relaxation::cost(std::span<const double>(relaxation.interior()), field);
  };
  const auto relaxed = [&](const lloyd_options& options) {
    lloyd_relaxation relaxation(start, options);
    double before = cost_of(relaxation);
    for (int frame = 0; frame < 50; ++frame) {
      relaxation.step(field);
      // Splits are rounded to 2^-24: each sample's distance may grow by half of that.
      CHECK(cost_of(relaxation) <= before + 1e-9);
      before = cost_of(relaxation);
    }
    return relaxation;
  };
  lloyd_options options;
  options.teleport = false;
  const auto stuck = relaxed(options);
  CHECK(stuck.interior()[1] == 0.5);
  options.teleport = true;
  for (const auto target :
       {teleport_target::layer_mean, teleport_target::layer_middle, teleport_target::costly_half}) {
    options.target = target;
    const auto moved = relaxed(options);
    CAPTURE(static_cast<int>(target), moved.interior()[0], moved.interior()[1],
            moved.interior()[2]);
    CHECK(cost_of(moved) <= cost_of(stuck));
    if (target == teleport_target::costly_half) {
      CHECK(moved.teleportations() > 0);
      CHECK(cost_of(moved) < 0.55 * cost_of(stuck));
    }
  }
}

TEST_CASE("an idle split teleports into the heaviest layer, as the source says") {
  // 0.15 serves the peaks at 0.1 and 0.2, 0.95 its own, 0.5 nobody; most weight lies in front.
  const lloyd_samples field(peaks({0.1, 0.1, 0.1, 0.2, 0.95}, 200, 7));
  lloyd_relaxation moved({0.15, 0.5, 0.95});
  moved.relax(field, 100);
  CHECK(moved.teleportations() == 1);
  CHECK(moved.interior()[0] == Approx(0.1).margin(0x1p-6));
  CHECK(moved.interior()[1] == Approx(0.2).margin(0x1p-6));
}

TEST_CASE("dynamic programming is no worse than any start of the relaxation, or all splits") {
  std::mt19937_64 random(4);
  for (int round = 0; round < 20; ++round) {
    std::vector<lloyd_sample> samples;
    for (int i = 0; i < 40; ++i) {
      samples.push_back({static_cast<double>(random() % 64) / 64,
                         0x1p-10 * static_cast<double>(1 + random() % 8)});
    }
    const lloyd_samples field(samples);
    const auto best = optimal_splits(field, 2);
    REQUIRE(best.size() == 2);
    const double least = lloyd_relaxation::cost(std::span<const double>(best), field);
    // Every pair on a grid of 2^-6, and wherever Lloyd comes to rest.
    for (int a = 0; a < 64; ++a) {
      for (int b = a; b < 64; ++b) {
        const std::vector<double> pair{a / 64.0, b / 64.0};
        REQUIRE(least <= lloyd_relaxation::cost(std::span<const double>(pair), field) * (1 + 1e-6));
      }
    }
    lloyd_relaxation relaxation({0.25, 0.75});
    relaxation.relax(field, 200);
    CHECK(least <= lloyd_relaxation::cost(std::span<const double>(relaxation.interior()), field) *
                       (1 + 1e-6));
  }
}

TEST_CASE("a pyramid in binary64 gives the samples' own sums, for maps of any size") {
  for (const auto& [w, h] : {std::pair{16, 16}, {13, 7}, {1, 9}, {63, 63}, {31, 2}}) {
    image<lloyd_sample> map(w, h);
    std::mt19937_64 random(5);
    for (auto& s : map.texels)
      s = {static_cast<double>(random() % 1024) / 1024,
           0x1p-10 * static_cast<double>(random() % 16)};
    const lloyd_samples field(map.texels);
    const lloyd_pyramid pyramid(map, binary64::value);
    const auto exact = field.between(0.25, 0.75);
    const auto reduced = pyramid.between(0.25, 0.75);
    CAPTURE(w, h);
    // A level's mean is of up to 9 products and a quotient: 10 roundings, of at most 6 levels.
    const double weight = static_cast<double>(exact.weight) * 0x1p-32;
    CHECK(std::fabs(reduced.weight * w * h - weight) <= 6 * 10 * 0x1p-53 * weight);
    CHECK(std::fabs(reduced.mean() - exact.mean()) <= split_grid);
    const double cost = field.cost(0.25, 0.75, 0.5);
    CHECK(std::fabs(pyramid.cost(0.25, 0.75, 0.5) * w * h - cost) <= 1e-9 * weight);
    if (w == 16) CHECK(reduced.weight * w * h == weight);  // divisions by 4: no rounding at all
  }
}
