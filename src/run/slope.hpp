// The slope term (12) on the rows of a map, in whatever its depths are warped to.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// Rows y - 1, y and y + 1 of a map's depths in a layer; the border repeats.
template <class T>
std::array<std::vector<T>, 3> rows_around(const image<float>& depth, int y, const interval& layer,
                                          layer_warp beyond = layer_warp::clamped) {
  std::array<std::vector<T>, 3> rows;
  for (int k = 0; k < 3; ++k) {
    auto& row = rows[static_cast<std::size_t>(k)];
    row.resize(static_cast<std::size_t>(depth.width));
    warp_row<T>(depth.row(std::clamp(y + k - 1, 0, depth.height - 1)), layer, row, 1, beyond);
  }
  return rows;
}

/// Adds the term to row y of a layer's two moments.
template <class T>
void add_layer_slope(const image<float>& depth, int y, const interval& layer,
                     const configuration& how, std::span<T> row) {
  auto rows = rows_around<T>(depth, y, layer, how.warping);
  // In centred storage, 4 (x - 1/2)^2, a variance counts four times.
  if (how.second == second_moment::centred) {
    for (auto& r : rows) {
      for (T& x : r) x = x + x;
    }
  }
  add_slope_row<T>(rows[0], rows[1], rows[2], row, 2);
}

/// Adds the term to row y of the moments of w+, and of w- where a texel has four components.
template <class T>
void add_evsm_slope(const image<float>& depth, int y, const evsm_constants& c, std::size_t channels,
                    std::span<T> row) {
  const auto rows = rows_around<T>(depth, y, interval{0, 1});
  const std::span<const T> above(rows[0]), here(rows[1]), below(rows[2]);
  for (std::size_t x = 0; x < here.size(); ++x) {
    const T slope = slope_variance_in(above, here, below, x);
    T* const texel = &row[x * channels];
    add_warped_slope(slope, c.positive, texel[0], texel[1]);
    if (channels == 4) add_warped_slope(slope, c.negative, texel[2], texel[3]);
  }
}

}  // namespace bitshade
