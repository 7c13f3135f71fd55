// Percentage-closer filtering: compare first, filter the answers afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/bilinear.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// The most taps that a blur may have along one axis.
inline constexpr std::size_t max_blur_taps = 25;

/// The texels along one axis that a blurred, bilinear lookup is made of, and their weights.
template <class W>
struct axis_footprint {
  std::size_t count = 0;
  std::array<int, 2 * max_blur_taps> index{};
  std::array<W, 2 * max_blur_taps> weight{};
};

/// The blur kernel around each of the two bilinear texels, merged where they are neighbours.
///
///   near texel's share `one - f`, far texel's share f; each times the kernel around it
///
/// Shapes   near, far: indices after the address mode; equal ones are one texel of share `one`.
/// Policy   products and sums are W's; with integers, f and `one` are in units of the grid.
template <class W>
axis_footprint<W> blurred_axis(int near, int far, const W& f, const W& one, std::span<const W> blur,
                               int size, address mode) {
  axis_footprint<W> result;
  const auto taps = blur.size();
  const int radius = static_cast<int>(taps / 2);
  const auto add = [&](int texel, const W& weight) {
    result.index[result.count] = wrap(texel, size, mode);
    result.weight[result.count++] = weight;
  };
  if (near == far || f == W(0)) {
    for (std::size_t k = 0; k < taps; ++k) add(near - radius + static_cast<int>(k), one * blur[k]);
  } else if (far == near + 1) {
    const W rest = one - f;
    add(near - radius, rest * blur[0]);
    for (std::size_t k = 1; k < taps; ++k) {
      add(near - radius + static_cast<int>(k), rest * blur[k] + f * blur[k - 1]);
    }
    add(far + radius, f * blur[taps - 1]);
  } else {  // neighbours only across a repeating border
    const W rest = one - f;
    for (std::size_t k = 0; k < taps; ++k) add(near - radius + static_cast<int>(k), rest * blur[k]);
    for (std::size_t k = 0; k < taps; ++k) add(far - radius + static_cast<int>(k), f * blur[k]);
  }
  return result;
}

/// The share of a separable footprint that is lit.
///
///   sum over y of weight_y * (sum over x of weight_x where lit(x, y)), both first to last
///
/// Shapes   lit: bool(int x, int y, size_t i, size_t j) for entry i of the columns, j of the rows.
/// Policy   sums over x are Column's, products and sums over y Result's.
template <class Result, class Column, class Lit>
Result lit_share(const axis_footprint<Column>& columns, const axis_footprint<Column>& rows,
                 Lit lit) {
  Result share = Result(0);
  for (std::size_t j = 0; j < rows.count; ++j) {
    Column row = Column(0);
    for (std::size_t i = 0; i < columns.count; ++i) {
      row = row + (lit(columns.index[i], rows.index[j], i, j) ? columns.weight[i] : Column(0));
    }
    share = share + static_cast<Result>(rows.weight[j]) * static_cast<Result>(row);
  }
  return share;
}

}  // namespace bitshade
