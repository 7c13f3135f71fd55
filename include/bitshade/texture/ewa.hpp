// The elliptical weighted average, as Mesa's software renderers do it [Heckbert89], [Mesa22].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/lod_model.hpp"

namespace bitshade {

namespace ewa_detail {

inline constexpr int table_size = 1024;
using weight_table = std::array<float, table_size>;

/// e^(-2 i / 1023) as the C library's expf gives it to softpipe: the nearest binary32 but for two
/// entries, which lie within 0.002 ulp of a tie and go the other way.
inline const weight_table& weights() {
  static const weight_table table = [] {
    weight_table t{};
    for (int i = 0; i < table_size; ++i) {
      const float r2 = static_cast<float>(i) / static_cast<float>(table_size - 1);
      t[static_cast<std::size_t>(i)] =
          static_cast<float>(exp_fixed(-2.0 * static_cast<double>(r2)));
    }
    t[191] = 0x1.607398p-1f;
    t[519] = 0x1.7339acp-2f;
    return t;
  }();
  return table;
}

/// The same with six decimals: llvmpipe's table was typed in.
inline const weight_table& printed_weights() {
  static const weight_table table = [] {
    weight_table t = weights();
    for (float& w : t) {
      const int millionths = static_cast<int>(static_cast<double>(w) * 1e6 + 0.5);
      w = static_cast<float>(millionths / 1e6);
    }
    return t;
  }();
  return table;
}

}  // namespace ewa_detail

/// The one level that is averaged: floor(1/2 log2 of the shorter squared derivative), the shorter
/// one raised until the ratio keeps the limit (0: no limit).
inline int ewa_level(const filter_model& model, const gradients& g, int width, int height,
                     int limit) {
  const derivative_lengths d(g, width, height);
  const float longer = d.x2 < d.y2 ? d.y2 : d.x2;
  float shorter = d.x2 < d.y2 ? d.x2 : d.y2;
  const auto most = static_cast<float>(limit * limit);
  if (limit > 0 && longer / shorter > most) shorter = longer / most;
  return static_cast<int>(half_log2(model.log2, shorter));
}

/// The ellipse of a lookup in texels of one level, scaled so that q < 1024 is inside.
///
///   A = sum v^2 + 1, B = -2 sum u v, C = sum u^2 + 1, F = A C - B^2/4, all three times 1023/F
struct ewa_ellipse {
  float a, b, c, box_u, box_v, scaling;

  ewa_ellipse(const gradients& g, int width, int height, int level)
      : scaling(1.0f / static_cast<float>(1 << level)) {
    const derivative_lengths d(g, width, height);
    const float ux = d.ux * scaling, vx = d.vx * scaling;
    const float uy = d.uy * scaling, vy = d.vy * scaling;
    a = vx * vx + vy * vy + 1;
    b = -2 * (ux * vx + uy * vy);
    c = ux * ux + uy * uy + 1;
    const float f = a * c - b * b / 4.0f;
    const float det = -b * b + 4.0f * c * a;
    box_u = 2.0f / det * std::sqrt(det * c * f);
    box_v = 2.0f / det * std::sqrt(a * det * f);
    const float scale = static_cast<float>(ewa_detail::table_size - 1) / f;
    a *= scale;
    b *= scale;
    c *= scale;
  }
};

/// Texels in the ellipse's bounding box, all of which ewa_sum visits.
inline double ewa_texels(const ewa_ellipse& e) {
  return (2 * static_cast<double>(e.box_u) + 2) * (2 * static_cast<double>(e.box_v) + 2);
}

/// sum w texel / sum w over the ellipse's bounding box, row by row, q by forward differences.
///
/// Shapes   texel: float(float u, float v), the nearest texel at normalised coordinates;
///          llvmpipe: its printed weights, and (U U) A where softpipe has (A U) U.
template <class Texel>
float ewa_sum(const ewa_ellipse& e, bool llvmpipe, float s, float t, int base_width,
              int base_height, Texel texel) {
  const auto& table = llvmpipe ? ewa_detail::printed_weights() : ewa_detail::weights();
  const float tex_u = -0.5f + s * static_cast<float>(base_width) * e.scaling;
  const float tex_v = -0.5f + t * static_cast<float>(base_height) * e.scaling;
  const float width = std::max(1.0f, std::floor(static_cast<float>(base_width) * e.scaling));
  const float height = std::max(1.0f, std::floor(static_cast<float>(base_height) * e.scaling));
  const int u0 = texel_floor(tex_u - e.box_u), u1 = -texel_floor(-(tex_u + e.box_u));
  const int v0 = texel_floor(tex_v - e.box_v), v1 = -texel_floor(-(tex_v + e.box_v));
  const float u_from = static_cast<float>(u0) - tex_u;
  float sum = 0, weights = 0;
  const float ddq = 2 * e.a;
  for (int v = v0; v <= v1; ++v) {
    const float v_from = static_cast<float>(v) - tex_v;
    float dq = e.a * (2 * u_from + 1) + e.b * v_from;
    float q = (e.c * v_from + e.b * u_from) * v_from +
              (llvmpipe ? u_from * u_from * e.a : e.a * u_from * u_from);
    for (int u = u0; u <= u1; ++u) {
      if (q < static_cast<float>(ewa_detail::table_size)) {
        const float w = table[static_cast<std::size_t>(q >= 0 ? static_cast<int>(q) : 0)];
        sum += w * texel(static_cast<float>(u) / width, static_cast<float>(v) / height);
        weights += w;
      }
      q += dq;
      dq += ddq;
    }
  }
  return weights > 0 ? sum / weights : texel(s, t);
}

}  // namespace bitshade
