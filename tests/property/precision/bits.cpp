// The fewest bits: what the bound predicts, what adversarial footprints need, and their slope.
#include <cmath>
#include <random>
#include <vector>

#include "precision/needed.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::bit_search;

namespace {

precision_question question(double deviation, int roundings) {
  precision_question q;
  q.floor_deviation = deviation;
  q.roundings = roundings;
  return q;
}

std::vector<needed_bits> curve(double deviation, int roundings, double overlap, int most) {
  std::vector<needed_bits> points;
  for (int n = 1; n <= most; n *= 2) {
    points.push_back(bits_needed(question(deviation, roundings), n, overlap, false, 2000));
  }
  return points;
}

/// Bits that the variance's share of the bound asks for where means are no larger than `mean`.
double share_at(precision_question q, double mean) {
  q.mean = mean;
  return std::log2(steps_needed(q) + 1);
}

}  // namespace

TEST_CASE("bits against layers: a unorm follows 2 log2 N where delta N is small") {
  for (const double overlap : {0.0, 0.001}) {
    const auto points = curve(0.003, 1, overlap, 16);
    for (const needed_bits& p : points) {
      const double reachable = share_at(p.question, p.witness.error.mean);
      CAPTURE(p.layers, overlap, p.predicted, p.found, reachable);
      CHECK(p.found <= p.predicted);
      CHECK(p.found >= reachable + std::log2(reached_once));
      CHECK(p.found_whole <= p.predicted_whole);
      CHECK(p.predicted_whole <= p.found_whole + 1);
    }
    // 2 log2 N, and what docs/theory.md takes off it: the overlap's 2 log2 (1 + 2 delta N), and
    // means that cannot reach 1, here log2 of (1 + 2 mu)/3 at 16 layers: under 0.05 bits an octave.
    const auto line = line_through(points, &needed_bits::found);
    CAPTURE(overlap, line.slope, line.largest_residual);
    CHECK(std::fabs(line.slope + 2) <= 0.05);
    CHECK(line.largest_residual <= 0.05);
    CHECK(deviations(points).size() >= 4);
  }
}

TEST_CASE("bits against layers: each further rounding costs log2 of their number") {
  const auto once = curve(0.01, 1, 0, 4), thrice = curve(0.01, 3, 0, 4);
  for (std::size_t i = 0; i < once.size(); ++i) {
    const needed_bits& p = thrice[i];
    CAPTURE(p.layers, once[i].found, p.found, p.predicted);
    CHECK(p.found <= p.predicted);
    CHECK(p.found >= share_at(p.question, p.witness.error.mean) + std::log2(reached_repeatedly));
    CHECK(p.predicted - once[i].predicted == Approx(std::log2(3)).margin(0.01));
  }
}

TEST_CASE("a significand needs the bits of a unorm, for depths just below 1") {
  const auto grid = bits_needed(question(0.01, 1), 4, 0, false, 2000);
  const auto real = bits_needed(question(0.01, 1), 4, 0, true, 2000);
  CAPTURE(grid.found_whole, real.found_whole, real.predicted_whole);
  CHECK(real.found_whole == grid.found_whole);
  CHECK(real.found_whole <= real.predicted_whole);
}

TEST_CASE("the predicted bits suffice: no random footprint breaks them") {
  std::mt19937_64 random(11);
  const auto unit = [&] { return static_cast<double>(random() >> 24) * 0x1p-40; };
  for (const int layers : {1, 4}) {
    auto asked = question(0.01, 1);
    asked.width = uniform_layer_width(layers, 0);
    footprint_question f;
    f.store = moment_store::unorm(unorm_bits_needed(asked));
    f.floor = layer_floor_variance(asked);
    double largest = 0;
    for (int i = 0; i < 400; ++i) {
      const double spread = std::sqrt(f.floor) * (0.5 + 3 * unit());
      const double b = 1 - 0.1 * unit(), a = std::max(0.0, b - 2 * spread);
      const footprint texels{{a}, {b}, std::min(1.0, (a + b) / 2 + spread * 2 * unit())};
      largest = std::max(largest, judged(f, texels).size());
    }
    CAPTURE(layers, largest);
    CHECK(largest <= asked.tolerated);
    CHECK(largest > 0);
  }
}

TEST_CASE("what breaks the bits in rationals breaks the pipeline as well") {
  constexpr int layers = 4;
  auto asked = question(0.01, 1);
  asked.width = 1.0 / layers;
  footprint_question f;
  f.store = moment_store::unorm(15);
  f.floor = layer_floor_variance(asked);
  f.depth_grid = 0x1p-22;  // in the last of four layers: binary32's grid below 1
  const worst_case worst = worst_footprint(f);
  REQUIRE(worst.error.size() > asked.tolerated);

  const auto in_depth = [](double x) { return static_cast<float>(0.75 + x / 4); };
  frame scene;
  scene.depth = image<float>(2, 1);
  scene.surface = image<std::uint32_t>(2, 1);
  scene.depth.at(0, 0) = in_depth(worst.texels.near[0]);
  scene.depth.at(1, 0) = in_depth(worst.texels.far[0]);
  scene.view_width = scene.view_height = 1;
  receiver r;
  r.u = r.v = 0.5F;
  r.t = in_depth(worst.texels.receiver);
  r.surface = 1;
  scene.receivers = {r};
  configuration how;
  how.method = technique::lvsm;
  how.layers = layers;
  how.overlap = 0;
  how.blur_taps = 0;
  how.min_variance = asked.floor_deviation * asked.floor_deviation;
  const auto light = [&](const std::string& format) {
    how.format = format;
    return run_pipeline(scene, how, make_plan(scene, how)).visibility[0];
  };
  const double error = std::fabs(light("unorm15") - light("exact"));
  CAPTURE(error, worst.error.size());
  CHECK(error > asked.tolerated);
  // The pipeline shades in binary32: its own noise of 2^-24 counts for 1.5 2^-24 / floor at most.
  CHECK(std::fabs(error - worst.error.size()) <= 4 * 0x1p-24 / f.floor);
}

TEST_CASE("a floor that fills the layer is refused with the cure") {
  CHECK_THROWS_AS(bits_needed(question(0.1, 1), 8, 0), std::invalid_argument);
}
