// Bilinear filtering as arithmetic defines it: no grid, no snap, every operation T's.
// Devices' ways are data for sampler.hpp; this is the definition that they are compared with.
#pragma once

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// The four texels around a point and how far it lies towards the second ones.
/// An index of -1 is the border.
template <class T>
struct bilinear_taps {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  T fx{}, fy{};
};

/// Where (u, v) falls among the texels of a w x h image.
///
///   x = u*w - 1/2, x0 = floor x, fx = x - x0;  y likewise
///
/// Units    u, v in [0,1] across the image; texel centres lie at halves.
/// Policy   every operation is T's; the indices are exact for the x that T gives. Beyond
///          max_texel_index the index is limited to it and the fraction 0: within_period() first
///          where such places count.
/// Failure  none: indices lie in the image or are -1 (address::border) for every u, v.
template <class T>
bilinear_taps<T> locate(const T& u, const T& v, int w, int h, address mode) {
  const T x = u * static_cast<T>(w) - static_cast<T>(0.5);
  const T y = v * static_cast<T>(h) - static_cast<T>(0.5);
  const int x0 = texel_floor(x);
  const int y0 = texel_floor(y);
  const auto fraction = [](const T& at, int floor) {
    return beyond_indices(floor) ? static_cast<T>(0) : at - static_cast<T>(floor);
  };
  return {wrap(x0, w, mode),     wrap(x0 + 1, w, mode), wrap(y0, h, mode),
          wrap(y0 + 1, h, mode), fraction(x, x0),       fraction(y, y0)};
}

/// a + f (b - a): every operation T's, no fma.
template <class T>
T lerp(const T& a, const T& b, const T& f) {
  return a + f * (b - a);
}

/// The texel (x, y), or `border` where an index is -1.
template <class T>
const T& texel_or(const image<T>& in, int x, int y, int channel, const T& border) {
  return x < 0 || y < 0 ? border : in.at(x, y, channel);
}

/// The filtered value of one channel.
///
///   lerp(lerp(t00, t10, fx), lerp(t01, t11, fx), fy): x, then y
///
/// Policy   every operation is T's.
/// Error    none for exact T.
/// Failure  none for taps from locate() on an image of this size.
template <class T>
T bilinear(const image<T>& in, const bilinear_taps<T>& at, int channel, const T& border = T(0)) {
  const T upper = lerp(texel_or(in, at.x0, at.y0, channel, border),
                       texel_or(in, at.x1, at.y0, channel, border), at.fx);
  const T lower = lerp(texel_or(in, at.x0, at.y1, channel, border),
                       texel_or(in, at.x1, at.y1, channel, border), at.fx);
  return lerp(upper, lower, at.fy);
}

}  // namespace bitshade
