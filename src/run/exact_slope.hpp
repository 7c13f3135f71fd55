// The slope term of a texel in certified numbers.
#pragma once

#include <algorithm>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// The slope's variance in a texel; differences of binary32 depths are exact in any enclosure.
template <class Number>
Number exact_slope_at(const image<float>& map, int x, int y) {
  const auto depth = [&](int i, int j) {
    return Number(clamp_depth(
        map.at(std::clamp(i, 0, map.width - 1), std::clamp(j, 0, map.height - 1))));
  };
  return slope_variance(depth(x - 1, y), depth(x + 1, y), depth(x, y - 1), depth(x, y + 1),
                        depth(x, y));
}

/// Whether exact_slope_at() is more than 0: a depth between its neighbours', along either axis.
inline bool has_slope(const image<float>& map, int x, int y) {
  const auto depth = [&](int i, int j) {
    return clamp_depth(map.at(std::clamp(i, 0, map.width - 1), std::clamp(j, 0, map.height - 1)));
  };
  const float here = depth(x, y);
  const auto between = [&](float a, float b) {
    return (a < here && here < b) || (b < here && here < a);
  };
  return between(depth(x - 1, y), depth(x + 1, y)) || between(depth(x, y - 1), depth(x, y + 1));
}

}  // namespace bitshade
