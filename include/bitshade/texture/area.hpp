// The truth and the quality reference of anisotropic filtering.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/image.hpp"
#include "bitshade/texture/lod.hpp"

namespace bitshade {

namespace area_detail {

template <class T>
struct point {
  T x{}, y{};
};

/// The part of a convex polygon with sign * coordinate <= sign * limit along one axis.
template <class T>
std::vector<point<T>> clip(const std::vector<point<T>>& in, T point<T>::*axis, const T& limit,
                           bool below) {
  std::vector<point<T>> out;
  const auto inside = [&](const point<T>& p) {
    return below ? !(limit < p.*axis) : !(p.*axis < limit);
  };
  for (std::size_t i = 0; i < in.size(); ++i) {
    const point<T>&a = in[i], &b = in[(i + 1) % in.size()];
    const bool ia = inside(a), ib = inside(b);
    if (ia) out.push_back(a);
    if (ia != ib) {
      const T f = (limit - a.*axis) / (b.*axis - a.*axis);
      out.push_back({a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)});
    }
  }
  return out;
}

template <class T>
T twice_area(const std::vector<point<T>>& p) {
  T sum = static_cast<T>(0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const point<T>&a = p[i], &b = p[(i + 1) % p.size()];
    sum = sum + (a.x * b.y - b.x * a.y);
  }
  return sum < static_cast<T>(0) ? static_cast<T>(0) - sum : sum;
}

}  // namespace area_detail

/// The mean of level 0 over a pixel's footprint: the parallelogram that both derivatives span
/// around (u, v), texels as constant squares. The truth that anisotropic schemes approximate.
///
/// Policy   polygons clipped texel by texel; every operation T's: exact T, exact mean.
/// Failure  a footprint without area gives the nearest texel; more than 2^22 texels: the caller's
///          patience.
template <class T>
T area_mean(const image<T>& in, const T& u, const T& v, const gradients& g, address mode,
            int channel, const T& border = T(0)) {
  using namespace area_detail;
  const T w = static_cast<T>(in.width), h = static_cast<T>(in.height), half = static_cast<T>(0.5);
  const point<T> dx{static_cast<T>(g.du_dx) * w * half, static_cast<T>(g.dv_dx) * h * half};
  const point<T> dy{static_cast<T>(g.du_dy) * w * half, static_cast<T>(g.dv_dy) * h * half};
  const point<T> c{u * w, v * h};
  const std::vector<point<T>> shape{{c.x - dx.x - dy.x, c.y - dx.y - dy.y},
                                    {c.x + dx.x - dy.x, c.y + dx.y - dy.y},
                                    {c.x + dx.x + dy.x, c.y + dx.y + dy.y},
                                    {c.x - dx.x + dy.x, c.y - dx.y + dy.y}};
  const auto value = [&](int x, int y) {
    const int tx = wrap(x, in.width, mode), ty = wrap(y, in.height, mode);
    return tx < 0 || ty < 0 ? border : in.at(tx, ty, channel);
  };
  const T zero = static_cast<T>(0);
  const T whole = twice_area(shape);
  if (!(zero < whole)) return value(texel_floor(c.x), texel_floor(c.y));
  const auto bounds = [&](T point<T>::*axis) {
    int low = texel_floor(shape[0].*axis), high = low;
    for (const point<T>& p : shape) {
      low = std::min(low, texel_floor(p.*axis));
      high = std::max(high, texel_floor(p.*axis));
    }
    return std::array<int, 2>{low, high};
  };
  const auto xs = bounds(&point<T>::x), ys = bounds(&point<T>::y);
  T sum = zero;
  for (int y = ys[0]; y <= ys[1]; ++y) {
    const auto row = clip(clip(shape, &point<T>::y, static_cast<T>(y), false), &point<T>::y,
                          static_cast<T>(y + 1), true);
    if (row.size() < 3) continue;
    for (int x = xs[0]; x <= xs[1]; ++x) {
      const auto part = clip(clip(row, &point<T>::x, static_cast<T>(x), false), &point<T>::x,
                             static_cast<T>(x + 1), true);
      if (part.size() >= 3) sum = sum + twice_area(part) * value(x, y);
    }
  }
  return sum / whole;
}

/// The elliptical weighted average of level 0: a Gaussian e^(-2 r^2) over the ellipse that both
/// derivatives span, widened by one texel so that magnification stays smooth. The quality
/// reference: no levels, no table, weights in binary64.
///
/// Error    weights exact to exp_fixed_error.
/// Failure  none: the texel under (u, v) always has weight.
/// Source   [Heckbert89] 3.5.
inline double ewa_reference(const image<double>& in, double u, double v, const gradients& g,
                            address mode, int channel, double border = 0) {
  const double ux = g.du_dx * in.width, vx = g.dv_dx * in.height;
  const double uy = g.du_dy * in.width, vy = g.dv_dy * in.height;
  const double a = vx * vx + vy * vy + 1, b = -2 * (ux * vx + uy * vy), c = ux * ux + uy * uy + 1;
  const double f = a * c - b * b / 4;
  const double reach_x = std::sqrt(c), reach_y = std::sqrt(a);
  const double x = u * in.width - 0.5, y = v * in.height - 0.5;
  double sum = 0, weights = 0;
  for (int j = texel_floor(y - reach_y); j <= texel_floor(y + reach_y) + 1; ++j)
    for (int i = texel_floor(x - reach_x); i <= texel_floor(x + reach_x) + 1; ++i) {
      const double dx = i - x, dy = j - y;
      const double q = (a * dx * dx + b * dx * dy + c * dy * dy) / f;
      if (q >= 1) continue;
      const double weight = exp_fixed(-2 * q);
      const int tx = wrap(i, in.width, mode), ty = wrap(j, in.height, mode);
      sum += weight * (tx < 0 || ty < 0 ? border : in.at(tx, ty, channel));
      weights += weight;
    }
  return sum / weights;
}

}  // namespace bitshade
