// The level of detail as a device computes it from derivatives, in binary32.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/filter_model.hpp"
#include "bitshade/texture/lod.hpp"

namespace bitshade {

namespace lod_detail {

/// log2(1 + i/256), i = 0 .. 256, rounded to binary32.
inline const std::array<float, 257>& log2_table() {
  static const std::array<float, 257> table = [] {
    std::array<float, 257> t{};
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<float>(log2_fixed(1 + static_cast<double>(i) / 256));
    return t;
  }();
  return table;
}

}  // namespace lod_detail

/// log2 x by the model's rule, for finite x >= 0.
inline float model_log2(log2_rule rule, float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto exponent = static_cast<float>(static_cast<int>((bits >> 23) & 255) - 127);
  switch (rule) {
    case log2_rule::nearest:
      return static_cast<float>(log2_fixed(static_cast<double>(x)));
    case log2_rule::mantissa_line:
      return exponent + (std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1.0f);
    case log2_rule::table_256:
      return exponent + lod_detail::log2_table()[((bits & 0x7fffffu) + (1u << 14)) >> 15];
    case log2_rule::squared_as_bits: {
      const float square = x * x;
      const auto number = static_cast<float>(std::bit_cast<std::int32_t>(square));
      return (number - 0x1.fcp+29f) * 0x1p-24f;  // half of this is 2^-25: see model_lambda
    }
  }
  return 0;
}

/// The squared lengths of both derivatives in texels of level 0, in binary32.
struct derivative_lengths {
  float ux, vx, uy, vy;  ///< derivatives in texels
  float x2, y2;

  derivative_lengths(const gradients& g, int width, int height)
      : ux(static_cast<float>(g.du_dx) * static_cast<float>(width)),
        vx(static_cast<float>(g.dv_dx) * static_cast<float>(height)),
        uy(static_cast<float>(g.du_dy) * static_cast<float>(width)),
        vy(static_cast<float>(g.dv_dy) * static_cast<float>(height)),
        x2(ux * ux + vx * vx),
        y2(uy * uy + vy * vy) {}
};

/// Half the log2 of a squared length.
inline float half_log2(log2_rule rule, float square) {
  // SwiftShader's log takes the square of the square: 2^-25 = 2^-23 / 4.
  if (rule == log2_rule::squared_as_bits) {
    const float fourth = square * square;
    return (static_cast<float>(std::bit_cast<std::int32_t>(fourth)) - 0x1.fcp+29f) * 0x1p-25f;
  }
  return 0.5f * model_log2(rule, square);
}

/// Level of detail of an isotropic lookup with derivatives.
inline float model_lambda(const filter_model& model, const gradients& g, int width, int height) {
  const derivative_lengths d(g, width, height);
  if (model.rho == rho_rule::max_abs) {
    const float x =
        std::max(std::fabs(static_cast<float>(g.du_dx)), std::fabs(static_cast<float>(g.du_dy))) *
        static_cast<float>(width);
    const float y =
        std::max(std::fabs(static_cast<float>(g.dv_dx)), std::fabs(static_cast<float>(g.dv_dy))) *
        static_cast<float>(height);
    return model_log2(model.log2, std::max(x, y));
  }
  return half_log2(model.log2, std::max(d.x2, d.y2));
}

}  // namespace bitshade
