// How the Khronos conformance suite judges a trilinear result: its range search, with an interval
// of levels of detail beside those of the coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "bitshade/texture/lod.hpp"
#include "support/filter_judge.hpp"

namespace bitshade::test {

/// Precisions of a level of detail.
struct level_precision {
  int derivative_bits = 18;  ///< relative, of every derivative
  int level_bits = 6;        ///< absolute, of the level of detail
};

/// The levels of detail that derivatives allow.
///
///   along each direction of the screen rho lies between max |m| and sqrt(2) * sum |m|, m the
///   derivatives in texels; the longer direction counts; lambda = log2 rho, to within 2^-level_bits
///
/// Source   [Vulkan] "Scale Factor Operation"; [CTS].
inline judge_detail::range level_range(const gradients& g, int width, int height,
                                       const level_precision& p) {
  const double error = std::ldexp(1.0, -p.derivative_bits);
  const auto direction = [&](double du, double dv) {
    const double u = std::fabs(du) * width, v = std::fabs(dv) * height;
    return judge_detail::range{std::max(u, v) * (1 - error),
                               std::sqrt(2.0) * (u + v) * (1 + error)};
  };
  const auto x = direction(g.du_dx, g.dv_dx), y = direction(g.du_dy, g.dv_dy);
  const double slack = std::ldexp(1.0, -p.level_bits);
  return {std::log2(std::max(x.low, y.low)) - slack, std::log2(std::max(x.high, y.high)) + slack};
}

/// The same for a level that is given as it is.
inline judge_detail::range level_range(double lambda, const level_precision& p) {
  const double slack = std::ldexp(1.0, -p.level_bits);
  return {lambda - slack, lambda + slack};
}

namespace judge_detail {

/// Weights of one quad in each of two levels, and between them: every result is linear in each.
using trilinear_box = std::array<range, 5>;  // x, y of the near level, x, y of the far one, mip

struct quad {
  int x0, x1, y0, y1;
};

inline double value_at(const image<double>& in, const quad& q, double fx, double fy, int c) {
  const double upper = in.at(q.x0, q.y0, c) + fx * (in.at(q.x1, q.y0, c) - in.at(q.x0, q.y0, c));
  const double lower = in.at(q.x0, q.y1, c) + fx * (in.at(q.x1, q.y1, c) - in.at(q.x0, q.y1, c));
  return upper + fy * (lower - upper);
}

/// Whether some point of the box gives `got` within the threshold, all channels together: boxes
/// that no corner brings near are dropped, the others halved.
inline bool reaches(const image<double>& near, const quad& a, const image<double>& far,
                    const quad& b, const trilinear_box& start, const std::vector<double>& got,
                    double threshold) {
  constexpr int most_boxes = 200000;
  std::vector<trilinear_box> open{start};
  for (int n = 0; n < most_boxes && !open.empty(); ++n) {
    const trilinear_box box = open.back();
    open.pop_back();
    const auto at = [&](const std::array<double, 5>& f, int c) {
      const double x = value_at(near, a, f[0], f[1], c), y = value_at(far, b, f[2], f[3], c);
      return x + f[4] * (y - x);
    };
    std::array<double, 5> middle{}, spread{};
    for (std::size_t k = 0; k < 5; ++k) middle[k] = (box[k].low + box[k].high) / 2;
    bool possible = true, hit = true;
    for (int c = 0; c < near.channels && possible; ++c) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      std::array<double, 32> corner{};
      for (unsigned i = 0; i < 32; ++i) {
        std::array<double, 5> f{};
        for (std::size_t k = 0; k < 5; ++k) f[k] = (i >> k & 1) != 0 ? box[k].high : box[k].low;
        corner[i] = at(f, c);
        low = std::min(low, corner[i]);
        high = std::max(high, corner[i]);
      }
      for (std::size_t k = 0; k < 5; ++k)
        for (unsigned i = 0; i < 32; ++i)
          spread[k] = std::max(spread[k], std::fabs(corner[i] - corner[i ^ (1u << k)]));
      const double wanted = got[static_cast<std::size_t>(c)];
      possible = low - threshold <= wanted && wanted <= high + threshold;
      hit = hit && std::fabs(at(middle, c) - wanted) <= threshold;
    }
    if (!possible) continue;
    if (hit) return true;
    const auto widest =
        static_cast<std::size_t>(std::max_element(spread.begin(), spread.end()) - spread.begin());
    if (spread[widest] <= threshold * 1e-3) continue;  // all of it is as far off as its middle
    trilinear_box low = box, high = box;
    low[widest].high = high[widest].low = middle[widest];
    open.push_back(low);
    open.push_back(high);
  }
  return false;
}

}  // namespace judge_detail

/// Whether some level of the interval, and some coordinates within theirs, give a trilinear result
/// within the threshold of `got`.
inline bool search_accepts_mips(std::span<const image<double>> chain, float u, float v,
                                address mode, const judge_detail::range& levels,
                                const std::vector<double>& got, const search_precision& p) {
  using namespace judge_detail;
  const auto last = static_cast<double>(chain.size() - 1);
  const double low = std::clamp(levels.low, 0.0, last), high = std::clamp(levels.high, 0.0, last);
  const auto quads = [&](const image<double>& in, auto use) {
    const range xs = texel_range(u, in.width, p), ys = texel_range(v, in.height, p);
    const auto first = [](double x) { return static_cast<int>(std::floor(x)); };
    for (int j = first(ys.low); j <= first(ys.high); ++j)
      for (int i = first(xs.low); i <= first(xs.high); ++i)
        use(quad{wrap(i, in.width, mode), wrap(i + 1, in.width, mode), wrap(j, in.height, mode),
                 wrap(j + 1, in.height, mode)},
            range{std::max(0.0, xs.low - i), std::min(1.0, xs.high - i)},
            range{std::max(0.0, ys.low - j), std::min(1.0, ys.high - j)});
  };
  bool accepted = false;
  for (int level = static_cast<int>(low); level <= static_cast<int>(high); ++level) {
    const image<double>& near = chain[static_cast<std::size_t>(level)];
    const image<double>& far =
        chain[std::min(chain.size() - 1, static_cast<std::size_t>(level) + 1)];
    const range mip{std::max(0.0, low - level), std::min(1.0, high - level)};
    quads(near, [&](const quad& a, const range& ax, const range& ay) {
      quads(far, [&](const quad& b, const range& bx, const range& by) {
        accepted = accepted || reaches(near, a, far, b, {ax, ay, bx, by, mip}, got, p.threshold);
      });
    });
  }
  return accepted;
}

}  // namespace bitshade::test
