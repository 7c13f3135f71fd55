// What is said of a picture: error figures, bleeding, acne, violations, jumps and banding.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/study/frame.hpp"

namespace bitshade {

/// The error of one picture against another, over the pixels where both have a value.
struct error_figures {
  std::size_t count = 0;  ///< pixels compared
  double rmse = 0;
  double largest = 0;      ///< of |got - wanted|
  double p999 = 0;         ///< the 99.9th percentile of |got - wanted|
  double signed_mean = 0;  ///< of got - wanted: positive where there is too much light
};

/// Figures of got against wanted.
///
/// Shapes   equal sizes; NaN on either side leaves the pixel out.
/// Failure  none; all zero where nothing can be compared.
inline error_figures compare(std::span<const double> got, std::span<const double> wanted) {
  error_figures figures;
  std::vector<double> errors;
  errors.reserve(got.size());
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < got.size() && i < wanted.size(); ++i) {
    const double error = got[i] - wanted[i];
    if (error != error) continue;
    errors.push_back(error < 0 ? -error : error);
    squares += error * error;
    sum += error;
  }
  figures.count = errors.size();
  if (errors.empty()) return figures;
  const auto n = static_cast<double>(errors.size());
  figures.rmse = std::sqrt(squares / n);
  figures.signed_mean = sum / n;
  // The smallest error that at least 999 of 1000 pixels do not exceed.
  const std::size_t rank = (errors.size() * 999 + 999) / 1000 - 1;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank),
                   errors.end());
  figures.p999 = errors[rank];
  figures.largest =
      *std::max_element(errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
  return figures;
}

/// Everything that a study's row says of a visibility picture.
///
/// Units    areas and integrals are shares of the receivers, in [0,1].
struct measures {
  error_figures method;      ///< exact technique against the geometric truth
  error_figures method_pcf;  ///< exact technique against percentage-closer filtering
  error_figures format;      ///< technique in the format against itself in exact arithmetic
  error_figures total;       ///< technique in the format against the geometric truth
  std::size_t receivers = 0;
  double bleed_area = 0;         ///< truth < 1/255 and p > truth + eps
  double bleed_integral = 0;     ///< mean of p over that area, times the area
  double acne_area = 0;          ///< truth = 1 and p < 1 - eps
  std::size_t violations = 0;    ///< p below the pcf truth: the upper bound does not hold
  double largest_violation = 0;  ///< pcf truth - p
  double jump = 0;     ///< largest step of p between neighbours of two layers, less truth's step
  double banding = 0;  ///< largest step of the format error between neighbours of one surface
};

/// The visibilities that measures are taken from, one value a receiver, NaN where there is none.
struct pictures {
  std::span<const double> visibility;  ///< the technique in its format
  std::span<const double> exact;       ///< the technique in exact arithmetic
  std::span<const double> geometric;   ///< truth: the receiver's tangent plane over the footprint
  std::span<const double> pcf;         ///< truth: percentage-closer filtering of the same map
  std::span<const int> layer = {};     ///< the layer that each receiver looked up; may be empty
};

/// The visibility error that a user tolerates: one step of an 8-bit display.
inline constexpr double tolerated_error = 1.0 / 255;

/// A violation smaller than this is binary64's rounding of the pictures themselves: both p and
/// the truth are rounded once, to within 2^-53 each.
inline constexpr double violation_noise = 0x1p-52;

/// Measures one picture of a frame.
///
/// Source   the measures of the project's scenes: bleed, acne, violations, jump, banding.
inline measures measure(const frame& scene, const pictures& p, double eps = tolerated_error) {
  measures m;
  m.method = compare(p.exact, p.geometric);
  m.method_pcf = compare(p.exact, p.pcf);
  m.format = compare(p.visibility, p.exact);
  m.total = compare(p.visibility, p.geometric);

  std::size_t bleeding = 0, acne = 0;
  double light = 0;
  for (std::size_t i = 0; i < p.visibility.size(); ++i) {
    const double seen = p.visibility[i];
    if (seen != seen) continue;
    ++m.receivers;
    // Against truth + eps, not eps alone: in a penumbra whose truth is just under 1/255 a format
    // error of 1e-4 would else count as bleeding.
    if (p.geometric[i] < 1.0 / 255 && seen > p.geometric[i] + eps) {
      ++bleeding;
      light += seen;
    }
    if (p.geometric[i] == 1 && seen < 1 - eps) ++acne;
    const double short_of = p.pcf[i] - seen;
    if (short_of > violation_noise) {
      ++m.violations;
      m.largest_violation = std::max(m.largest_violation, short_of);
    }
  }
  if (m.receivers > 0) {
    const auto n = static_cast<double>(m.receivers);
    m.bleed_area = static_cast<double>(bleeding) / n;
    m.bleed_integral = light / n;
    m.acne_area = static_cast<double>(acne) / n;
  }

  const auto neighbours = [&](std::size_t i, std::size_t j) {
    const auto &a = scene.receivers[i], &b = scene.receivers[j];
    if (a.surface == 0 || a.surface != b.surface) return;
    const auto step = [&](auto values) { return std::fabs(values[i] - values[j]); };
    if (!p.layer.empty() && p.layer[i] != p.layer[j]) {
      m.jump = std::max(m.jump, step(p.visibility) - step(p.geometric));
    }
    const double banding = (p.visibility[i] - p.exact[i]) - (p.visibility[j] - p.exact[j]);
    m.banding = std::max(m.banding, std::fabs(banding));
  };
  const auto width = static_cast<std::size_t>(scene.view_width);
  for (std::size_t i = 0; width > 0 && i < p.visibility.size(); ++i) {
    if (i % width + 1 < width) neighbours(i, i + 1);
    if (i + width < p.visibility.size()) neighbours(i, i + width);
  }
  return m;
}

}  // namespace bitshade
