// The rectangles that a summed-area variance shadow map is read with.
#pragma once

#include <algorithm>
#include <cmath>

#include "bitshade/study/frame.hpp"
#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// Texels [x0, x1) x [y0, y1) of a map.
struct texel_box {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int area() const { return (x1 - x0) * (y1 - y0); }
};

/// The widest box along one axis: its sums of 16-bit codes still fit 32 bits.
inline constexpr int widest_box = 256;

/// The texels under a pixel: as wide as its screen derivatives, at least `smallest`, within the
/// map. [LauritzenMcCoolSAVSM]
inline texel_box box_of(const receiver& r, int width, int height, int smallest) {
  struct range {
    int first, last;
  };
  const auto axis = [&](double at, double dx, double dy, int size) {
    const double extent = std::ceil((std::fabs(dx) + std::fabs(dy)) * size);
    const int most = std::min(widest_box, size);
    const int count =
        extent < most ? std::clamp(static_cast<int>(extent), std::min(smallest, most), most) : most;
    const int first = texel_floor(at * size - count * 0.5 + 0.5);
    const int from = std::clamp(first, 0, size - 1);
    return range{from, std::clamp(first + count, from + 1, size)};
  };
  const range x = axis(r.u, r.du_dx, r.du_dy, width), y = axis(r.v, r.dv_dx, r.dv_dy, height);
  return {x.first, y.first, x.last, y.last};
}

}  // namespace bitshade
