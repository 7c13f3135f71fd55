// Small frames with everything that can go wrong in a depth map: edges, ties, extremes.
#pragma once

#include <cmath>
#include <random>

#include "bitshade/study/frame.hpp"

namespace bitshade::test {

/// A map of a few planes, steps and random texels, looked at by random receivers: a quarter of
/// them exactly at a stored depth. `tiny` adds depths far below 2^-8.
inline frame small_frame(int width, int height, int receivers, unsigned seed, bool tiny = false) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<float>(random() >> 40) * 0x1p-24F; };
  frame scene;
  scene.name = "small";
  scene.depth = image<float>(width, height);
  scene.surface = image<std::uint32_t>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool plate = (x / 5 + y / 3) % 2 == 0;
      float depth =
          plate ? 0.25F : 0.75F + 0.125F * static_cast<float>(x) / static_cast<float>(width);
      if (random() % 8 == 0) depth = 0.5F + unit() / 2;
      if (random() % 16 == 0) depth = random() % 2 ? 1.0F : 0x1p-7F;
      if (tiny && random() % 4 == 0) depth = std::ldexp(unit(), -static_cast<int>(random() % 120));
      scene.depth.at(x, y) = depth;
      scene.surface.at(x, y) = plate ? 1 : 2;
    }
  }
  scene.view_width = receivers;
  scene.view_height = 1;
  for (int i = 0; i < receivers; ++i) {
    receiver r;
    r.u = unit();
    r.v = unit();
    r.t = unit() < 0x1p-3F ? std::ldexp(unit(), -6) : 0x1p-8F + unit() * 0.99F;
    r.t = static_cast<float>(static_cast<double>(std::uint64_t(r.t * 0x1p32)) * 0x1p-32);
    if (random() % 4 == 0) {
      r.t = scene.depth.at(static_cast<int>(random() % static_cast<unsigned>(width)),
                           static_cast<int>(random() % static_cast<unsigned>(height)));
    }
    const auto slope = [&] { return (unit() - 0.5F) * 0.25F; };
    r.dt_du = slope();
    r.dt_dv = slope();
    r.du_dx = slope();
    r.dv_dx = slope();
    r.du_dy = slope();
    r.dv_dy = slope();
    r.surface = random() % 10 == 0 ? 0 : 2;
    scene.receivers.push_back(r);
  }
  return scene;
}

/// The same frame with a few of its samples' depths changed.
inline frame with_samples(frame scene, int count, unsigned seed) {
  std::mt19937 random(seed);
  for (const sample_position at : sample_pattern(count)) {
    if (count == 1) break;
    map_sample s{scene.depth, scene.surface, at};
    for (float& x : s.depth.texels) {
      if (random() % 3 == 0) x = static_cast<float>(random() >> 8) * 0x1p-24F;
    }
    scene.samples[count].push_back(std::move(s));
  }
  return scene;
}

}  // namespace bitshade::test
