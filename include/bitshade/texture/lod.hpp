// Which level, and how many probes: given data in binary64, so that exact sampling can start from
// it. Devices' own approximations of these are data for sampler.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// Derivatives of the texture coordinates along two screen directions.
struct gradients {
  double du_dx = 0, dv_dx = 0, du_dy = 0, dv_dy = 0;
};

/// Two neighbouring levels and how far the sample lies towards the second.
struct level_blend {
  int near = 0, far = 0;
  double fraction = 0;
};

/// The two levels of a level of detail.
///
///   lambda in [0, levels - 1], near = floor lambda, fraction on the grid of 2^-bits (floor)
///
/// Units    bits: mipmapPrecisionBits, 8 in D3D; 0: the nearest level alone, ties down.
/// Failure  none; NaN is level 0.
/// Source   [D3D11] 7.18.10; [Vulkan] "Level-of-Detail Operation" and "Scale Factor Operation".
inline level_blend blend_levels(double lambda, int levels, int bits = 8) {
  const double last = levels - 1;
  const double lod = lambda > 0 ? std::min(lambda, last) : 0.0;
  if (bits == 0) {
    const int nearest = static_cast<int>(std::ceil(lod + 0.5)) - 1;
    return {nearest, nearest, 0};
  }
  const double grid = static_cast<double>(1 << bits);
  const double snapped = std::floor(lod * grid) / grid;
  const int near = static_cast<int>(snapped);
  return {near, std::min(near + 1, levels - 1), snapped - near};
}

/// Probes of one lookup: offsets of (u, v), all of weight 1 / size, at one level of detail.
struct probe_set {
  struct offset {
    double du = 0, dv = 0;
  };
  double lambda = 0;
  std::vector<offset> offsets;
};

/// Probe offsets are multiples of this, as texture coordinates are.
inline constexpr double probe_grid = 0x1p-24;

/// Level and probes of a lookup with derivatives, as Vulkan's specification words it.
///
///   eta = min(rho_max / rho_min, limit), N = ceil eta, lambda = log2(rho_max / eta),
///   offsets (i/(N+1) - 1/2) along the longer derivative, i = 1 .. N
///
/// Shapes   N offsets, 1 <= N <= max(1, limit); symmetric about 0.
/// Units    derivatives per pixel; w, h the size of level 0 in texels.
/// Policy   rounded once more to probe_grid, half away from zero.
/// Failure  none: derivatives that are not finite give one probe at level 0.
/// Source   [Vulkan] "Scale Factor Operation, Level-of-Detail Operation and Image Level(s)
///          Selection", "Texel Anisotropic Filtering".
inline probe_set vulkan_probes(const gradients& g, int w, int h, int limit) {
  const double x2 = g.du_dx * w * (g.du_dx * w) + g.dv_dx * h * (g.dv_dx * h);
  const double y2 = g.du_dy * w * (g.du_dy * w) + g.dv_dy * h * (g.dv_dy * h);
  const double longer = std::max(x2, y2), shorter = std::min(x2, y2);
  if (!(longer > 0) || !(longer < 0x1p1000) || !(shorter >= 0)) return {0, {{0, 0}}};
  const double cap = std::max(1, limit);
  // An empty minor axis is infinitely anisotropic: the limit decides.
  const double ratio = shorter * cap * cap <= longer ? cap : std::sqrt(longer / shorter);
  const int count = static_cast<int>(std::ceil(std::min(ratio, cap)));
  const bool along_x = x2 > y2;
  const double du = along_x ? g.du_dx : g.du_dy;
  const double dv = along_x ? g.dv_dx : g.dv_dy;
  probe_set result{log2_fixed(std::sqrt(longer) / std::min(ratio, cap)), {}};
  const auto snap = [](double x) { return std::round(x / probe_grid) * probe_grid; };
  for (int i = 1; i <= count; ++i) {
    // (2i - N - 1) / (2N + 2), an exact numerator, keeps the set symmetric bit for bit.
    const double at = static_cast<double>(2 * i - count - 1) / (2 * count + 2);
    result.offsets.push_back({snap(at * du), snap(at * dv)});
  }
  return result;
}

}  // namespace bitshade
