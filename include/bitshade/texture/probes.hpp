// Anisotropic lookups made of several isotropic ones: how many, where, with what weights.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/lod_model.hpp"

namespace bitshade {

/// Probes at (u, v) + (first + i * spacing) * (du, dv), i = 0 .. count - 1.
struct probe_plan {
  float lambda = 0;
  int count = 1;
  float du = 0, dv = 0;
  float first = 0, spacing = 0;
  std::array<float, 17> weights{};  ///< all equal when `uniform`
  bool uniform = true;

  float weight(int i) const {
    return uniform ? 1.0f / static_cast<float>(count) : weights[static_cast<std::size_t>(i)];
  }
};

/// Most probes that a plan can hold; a limit beyond it is brought down to it.
inline constexpr int max_probes = 16;

namespace probe_detail {

/// The ellipse's own axes from the two derivatives that span it: the columns of [x y] rotated so
/// that they are orthogonal, which keeps the ellipse.
inline void orthogonalise(float& ux, float& vx, float& uy, float& vy) {
  const double a = ux, b = vx, c = uy, d = vy;
  const double cross = 2 * (a * c + b * d);
  const double difference = (a * a + b * b) - (c * c + d * d);
  if (cross == 0) return;
  // tan(2 phi) = cross / difference, by half angles with square roots alone.
  const double length = std::sqrt(cross * cross + difference * difference);
  const double cosine = std::sqrt((1 + difference / length) / 2);
  const double sine = (cross < 0 ? -1 : 1) * std::sqrt((1 - difference / length) / 2);
  ux = static_cast<float>(cosine * a + sine * c);
  vx = static_cast<float>(cosine * b + sine * d);
  uy = static_cast<float>(cosine * c - sine * a);
  vy = static_cast<float>(cosine * d - sine * b);
}

/// Feline, as [McCormack99b] 3.1 has it: probes on the major axis of the ellipse, so far apart that
/// their own footprints, of the minor radius, cover it. Radii are 1 texel at least.
///
///   n = floor(2 major/minor - 1 + 1/2), limited; where that is fewer than 2 major/minor - 1,
///   minor' = 2 major/(n + 1); level log2 minor'; places on 2 (major - minor'), (n - 1) equal steps;
///   weights e^(-alpha d^2), d = 1 at the ellipse's end; alpha = 2, EWA's
inline void plan_feline(probe_plan& plan, float major, float minor, float cap, log2_rule log2) {
  major = std::max(major, 1.0f);
  minor = std::max(minor, 1.0f);
  const bool limited = !(2 * major <= (cap + 1) * minor);
  const float wanted = limited ? cap : std::max(1.0f, 2 * major / minor - 1);
  plan.count = std::max(1, std::min(texel_floor(wanted + 0.5f), static_cast<int>(cap)));
  const auto n = static_cast<float>(plan.count);
  if (n < wanted || limited) minor = 2 * major / (n + 1);
  plan.lambda = half_log2(log2, minor * minor);
  if (plan.count == 1) return;
  plan.first = -(major - minor) / major;
  plan.spacing = -2 * plan.first / (n - 1);
  plan.uniform = false;
  double total = 0;
  std::array<double, max_probes> w{};
  for (int i = 0; i < plan.count; ++i) {
    // (2i - n + 1) / (n - 1), an exact numerator, keeps the weights symmetric bit for bit.
    const double r = static_cast<double>(plan.first) * (2 * i - plan.count + 1) / (plan.count - 1);
    total += w[static_cast<std::size_t>(i)] = exp_fixed(-2 * r * r);
  }
  for (int i = 0; i < plan.count; ++i)
    plan.weights[static_cast<std::size_t>(i)] =
        static_cast<float>(w[static_cast<std::size_t>(i)] / total);
}

}  // namespace probe_detail

/// One probe where Feline's level is beyond the `last`, at the texture's own resolution there.
inline void limit_feline(probe_plan& plan, int last) {
  if (plan.lambda <= static_cast<float>(last)) return;
  probe_plan one;
  one.lambda = plan.lambda;
  plan = one;
}

/// Ratio, number and place of the probes by one rule.
///
/// Shapes   1 <= count <= min(limit, max_probes).
/// Policy   weights sum to 1 up to count roundings; probes are symmetric about the centre.
/// Failure  none: derivatives that are not finite, or zero, give one probe at level 0.
/// Source   [Vulkan], [SwiftShader], [D3D11] 7.18.11, [McCormack99b] 3.1 (Feline).
inline probe_plan plan_probes(anisotropy_rule rule, log2_rule log2, const gradients& g, int width,
                              int height, int limit) {
  derivative_lengths d(g, width, height);
  const float cap = static_cast<float>(std::clamp(limit, 1, max_probes));
  probe_plan plan;
  if (!(d.x2 + d.y2 > 0) || !(d.x2 + d.y2 < 0x1p126f)) return plan;
  float gu = static_cast<float>(g.du_dx), gv = static_cast<float>(g.dv_dx);
  float hu = static_cast<float>(g.du_dy), hv = static_cast<float>(g.dv_dy);
  if (rule == anisotropy_rule::ellipse || rule == anisotropy_rule::feline) {
    probe_detail::orthogonalise(d.ux, d.vx, d.uy, d.vy);
    d.x2 = d.ux * d.ux + d.vx * d.vx;
    d.y2 = d.uy * d.uy + d.vy * d.vy;
    gu = d.ux / static_cast<float>(width);
    gv = d.vx / static_cast<float>(height);
    hu = d.uy / static_cast<float>(width);
    hv = d.vy / static_cast<float>(height);
  }
  const bool along_x = d.x2 >= d.y2;
  const float longer = along_x ? d.x2 : d.y2, shorter = along_x ? d.y2 : d.x2;
  plan.du = along_x ? gu : hu;
  plan.dv = along_x ? gv : hv;

  if (rule == anisotropy_rule::feline) {
    probe_detail::plan_feline(plan, std::sqrt(longer), std::sqrt(shorter), cap, log2);
    return plan;
  }
  float ratio;
  if (rule == anisotropy_rule::vulkan) {
    ratio = shorter * cap * cap <= longer ? cap : std::sqrt(longer / shorter);
  } else {  // major^2 / area: the same for orthogonal axes
    const float det = std::fabs(d.ux * d.vy - d.vx * d.uy);
    ratio = det * cap <= longer ? cap : longer * (1.0f / det);
  }
  ratio = std::min(ratio, cap);
  if (rule == anisotropy_rule::determinant) {
    const int below = texel_floor(ratio);
    const float rest = ratio - static_cast<float>(below);
    plan.count = below + (rest > 0.5f || (rest == 0.5f && (below & 1) != 0) ? 1 : 0);
  } else {
    plan.count = static_cast<int>(std::ceil(ratio));
  }
  plan.count = std::max(1, plan.count);
  const auto n = static_cast<float>(plan.count);
  if (rule == anisotropy_rule::vulkan) {
    plan.spacing = 1.0f / (n + 1);
    plan.first = plan.spacing - 0.5f;
  } else {
    plan.spacing = 1.0f / n;
    plan.first = -(n - 1) / (2 * n);
  }
  plan.lambda = half_log2(log2, longer * (1.0f / (ratio * ratio)));
  return plan;
}

}  // namespace bitshade
