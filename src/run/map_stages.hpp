// The stages of a map between its samples and its mips, for native arithmetic.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/resolve.hpp"
#include "run/lookup.hpp"

namespace bitshade {

/// The texels of a map, stored: of its centres, or of its samples, resolved and stored again.
///
/// Shapes   fill(depth map, y, row) makes row y; pass(row kernel, out) runs a kernel over all rows
///          of an image and stores them.
template <class T, class Fill, class Pass>
image<T> resolved_texels(const frame& scene, int samples_a_texel, int channels, Fill fill,
                         Pass pass) {
  std::vector<image<T>> samples;
  for (const image<float>* depth : depth_maps(scene, samples_a_texel)) {
    image<T>& sample = samples.emplace_back(depth->width, depth->height, channels);
    pass([&](int y) { fill(*depth, y, sample.row(y)); }, sample);
  }
  if (samples.size() == 1) return std::move(samples.front());
  image<T> out(scene.depth.width, scene.depth.height, channels);
  pass([&](int y) { resolve_row<T>(samples, y, out.row(y)); }, out);
  return out;
}

/// Blurs a map by a configuration's kernel and way.
///
/// Shapes   fraction_bits: of linear fetches, as the plan left them; pass as above.
template <class T, class Pass>
void blur_map(const configuration& how, int fraction_bits, image<T>& texels, Pass pass) {
  const kernel blur = blur_of(how);
  if (blur.weights.size() == 1) return;
  image<T> other(texels.width, texels.height, texels.channels);
  switch (how.filtered.way) {
    case blur_way::separable:
      pass([&](int y) { blur_row_x<T>(texels, blur, map_address, y, other.row(y)); }, other);
      pass([&](int y) { blur_row_y<T>(other, blur, map_address, y, texels.row(y)); }, texels);
      return;
    case blur_way::one_pass:
      pass([&](int y) { blur_row_square<T>(texels, blur, map_address, y, other.row(y)); }, other);
      texels = std::move(other);
      return;
    case blur_way::linear: {
      const auto taps = linear_taps(blur, fraction_bits);
      pass([&](int y) { blur_row_linear<T>(texels, taps, map_address, y, other.row(y)); }, other);
      pass([&](int y) { blur_column_linear<T>(other, taps, map_address, y, texels.row(y)); },
           texels);
      return;
    }
  }
}

}  // namespace bitshade
