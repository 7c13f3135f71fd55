// How the Khronos conformance suite judges a bilinear result: both of its models, as facts about
// them were published; written anew.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade::test {

/// Precisions of the range search.
struct search_precision {
  int coordinate_bits = 20;  ///< relative, of u and v
  int uvw_bits = 7;          ///< absolute, of texel coordinates
  double threshold = 0;      ///< on each channel
};

namespace judge_detail {

struct range {
  double low, high;
};

inline range texel_range(float u, int size, const search_precision& p) {
  const double error = u == 0 ? 0 : std::ldexp(1.0, std::ilogb(std::fabs(u)) - p.coordinate_bits);
  const double grid = std::ldexp(1.0, -p.uvw_bits);
  const double centre = static_cast<double>(u);
  return {(centre - error) * size - grid - 0.5, (centre + error) * size + grid - 0.5};
}

}  // namespace judge_detail

/// Whether some point of the coordinate intervals, in some quad that they touch, gives a bilinear
/// result within the threshold of `got`, all channels together.
///
/// For a fixed x the result is linear in y, so that the y that fit are an interval a channel; x is
/// searched in steps that move no channel by more than half the threshold.
inline bool search_accepts(const image<double>& in, float u, float v, address mode,
                           const std::vector<double>& got, const search_precision& p) {
  const auto xs = judge_detail::texel_range(u, in.width, p),
             ys = judge_detail::texel_range(v, in.height, p);
  const auto first = [](double x) { return static_cast<int>(std::floor(x)); };
  for (int j = first(ys.low); j <= first(ys.high); ++j)
    for (int i = first(xs.low); i <= first(xs.high); ++i) {
      const int x0 = wrap(i, in.width, mode), x1 = wrap(i + 1, in.width, mode);
      const int y0 = wrap(j, in.height, mode), y1 = wrap(j + 1, in.height, mode);
      const double fx0 = std::max(0.0, xs.low - i), fx1 = std::min(1.0, xs.high - i);
      const double fy0 = std::max(0.0, ys.low - j), fy1 = std::min(1.0, ys.high - j);
      double steepest = 0;
      for (int c = 0; c < in.channels; ++c)
        steepest = std::max({steepest, std::fabs(in.at(x1, y0, c) - in.at(x0, y0, c)),
                             std::fabs(in.at(x1, y1, c) - in.at(x0, y1, c))});
      const int steps = 1 + static_cast<int>((fx1 - fx0) * steepest * 2 / p.threshold);
      for (int s = 0; s <= steps; ++s) {
        const double fx = fx0 + (fx1 - fx0) * s / steps;
        double low = fy0, high = fy1;
        for (int c = 0; c < in.channels; ++c) {
          const double upper = in.at(x0, y0, c) + fx * (in.at(x1, y0, c) - in.at(x0, y0, c));
          const double lower = in.at(x0, y1, c) + fx * (in.at(x1, y1, c) - in.at(x0, y1, c));
          const double slope = lower - upper, rest = got[static_cast<std::size_t>(c)] - upper;
          if (slope == 0) {
            if (std::fabs(rest) > p.threshold) high = low - 1;
            continue;
          }
          const double a = (rest - p.threshold) / slope, b = (rest + p.threshold) / slope;
          low = std::max(low, std::min(a, b));
          high = std::min(high, std::max(a, b));
        }
        if (low <= high) return true;
      }
    }
  return false;
}

/// Precisions of the strict model.
struct strict_precision {
  int grid_bits = 8;    ///< subTexelPrecisionBits
  double step = 0;      ///< of the format: texels may be one off
  int result_bits = 0;  ///< 10 for half, 23 for binary32, n for unorm n
};

/// Whether `got` lies in the interval that some point of the grid allows: points between the grid's
/// neighbours of the coordinate's interval, inside the quad that the unsnapped coordinate lies in.
inline bool strict_accepts(const image<double>& in, float u, float v, address mode,
                           const std::vector<double>& got, const strict_precision& p) {
  const double grid = std::ldexp(1.0, p.grid_bits);
  const auto bounds = [](float coordinate, int size) {  // u*w - 1/2 in binary32, each op an ulp
    const double x = static_cast<double>(coordinate) * size;
    const double error = std::ldexp(std::max(1.0, std::fabs(x)), -23);
    return judge_detail::range{x - 0.5 - error, x - 0.5 + error};
  };
  const auto xs = bounds(u, in.width), ys = bounds(v, in.height);
  const auto floor_int = [](double x) { return static_cast<int>(std::floor(x)); };
  const auto points = [&](const judge_detail::range& r, int base, auto use) {
    const int from = std::max(floor_int(r.low * grid), base << p.grid_bits);
    const int to = std::min(static_cast<int>(std::ceil(r.high * grid)),
                            (base << p.grid_bits) + (1 << p.grid_bits) - 1);
    for (int k = from; k <= to; ++k) use((k - (base << p.grid_bits)) / grid);
  };
  bool accepted = false;
  for (int j = floor_int(ys.low); j <= floor_int(ys.high); ++j)
    for (int i = floor_int(xs.low); i <= floor_int(xs.high); ++i) {
      const int x0 = wrap(i, in.width, mode), x1 = wrap(i + 1, in.width, mode);
      const int y0 = wrap(j, in.height, mode), y1 = wrap(j + 1, in.height, mode);
      points(ys, j, [&](double fy) {
        points(xs, i, [&](double fx) {
          bool all = true;
          for (int c = 0; c < in.channels; ++c) {
            const double value = (1 - fy) * ((1 - fx) * in.at(x0, y0, c) + fx * in.at(x1, y0, c)) +
                                 fy * ((1 - fx) * in.at(x0, y1, c) + fx * in.at(x1, y1, c));
            // Texels one step off, and three lerps rounded at the result's precision.
            const double slack =
                p.step + 3 * std::ldexp(std::max(std::fabs(value), p.step), -p.result_bits);
            all = all && std::fabs(got[static_cast<std::size_t>(c)] - value) <= slack;
          }
          accepted = accepted || all;
        });
      });
    }
  return accepted;
}

}  // namespace bitshade::test
