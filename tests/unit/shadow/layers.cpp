// Layers generated at once and alone, their overlaps, and blends across splits.
#include "bitshade/shadow/layers.hpp"

#include <random>

#include "bitshade/shadow/layer_packing.hpp"
#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("generation in one pass and layer by layer give the same bits") {
  std::mt19937 random(1);
  std::vector<float> depth(257);
  for (float& x : depth) x = static_cast<float>(random() >> 8) * 0x1p-24F;
  for (const int count : {1, 2, 3, 7}) {
    const auto layers = layer_intervals(uniform_splits(count), 0.03);
    std::vector<float> all(depth.size() * 2 * layers.size());
    layers_row<float>(depth, layers, all);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      std::vector<float> alone(depth.size() * 2);
      warp_row<float>(depth, layers[i], alone, 2);
      square_row<float>(alone, 2);
      for (std::size_t x = 0; x < depth.size(); ++x) {
        REQUIRE(all[(x * layers.size() + i) * 2] == alone[2 * x]);
        REQUIRE(all[(x * layers.size() + i) * 2 + 1] == alone[2 * x + 1]);
      }
    }
    CHECK(packed_textures(count) == (count + 1) / 2);
  }
  CHECK(packed(3).texture == 1);
  CHECK(packed(3).channel == 2);
}

TEST_CASE("overlaps widen interior sides only, and stay in [0,1]") {
  const std::vector<double> splits{0, 0.25, 0.75, 1};
  CHECK(layer_intervals(splits, 0.0625) ==
        std::vector<interval>{{0, 0.3125}, {0.1875, 0.8125}, {0.6875, 1}});
  CHECK(layer_intervals(splits, 0.5) == std::vector<interval>{{0, 0.75}, {0, 1}, {0.25, 1}});
  CHECK(layer_intervals(splits, 0) == std::vector<interval>{{0, 0.25}, {0.25, 0.75}, {0.75, 1}});
}

TEST_CASE("a transition blends the two layers beside a split, from one's light to the other's") {
  const std::vector<double> splits{0, 0.25, 0.5, 1};
  const auto pair = [&](double t) {
    const auto p = blended_layers(t, splits, 0.0625);
    return std::pair{p.near, p.far};
  };
  CHECK(pair(0.125) == std::pair{0, 0});
  CHECK(pair(0.1875) == std::pair{0, 0});  // at s - delta the share would be 0
  CHECK(pair(0.2) == std::pair{0, 1});
  CHECK(pair(0.3) == std::pair{0, 1});
  CHECK(pair(0.3125) == std::pair{1, 1});
  CHECK(pair(0.45) == std::pair{1, 2});
  CHECK(pair(0.9) == std::pair{2, 2});
  CHECK(transition_share(0.1875, 0.25, 0.0625) == 0);
  CHECK(transition_share(0.25, 0.25, 0.0625) == 0.5);
  CHECK(transition_share(0.3125, 0.25, 0.0625) == 1);
  // Overlaps that meet: the nearer split, and of two at one distance the nearer one to the light.
  const auto wide = [&](double t) { return blended_layers(t, splits, 0.25).near; };
  CHECK(wide(0.3) == 0);
  CHECK(wide(0.45) == 1);
  CHECK(wide(0.375) == 0);
}
