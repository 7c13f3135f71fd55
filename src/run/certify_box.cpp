#include <algorithm>
#include <cmath>

#include "run/certify.hpp"

namespace bitshade {

namespace {

constexpr double outward = 0x1p-48;  // more than a dozen roundings of binary64

/// v / (v + d^2) with v no lower than the floor; 1 before the mean.
double light(double mean, double second, double t, double floor) {
  const double d = t - mean, v = std::max({second - mean * mean, floor, 0.0});
  if (!(d > 0)) return 1;
  const double sum = v + d * d;
  return sum > 0 ? v / sum : 0;
}

}  // namespace

light_interval light_of_box(double m1, double r1, double m2, double r2, double t, double floor,
                            double loose) {
  // Depths in [0,1]: M2 <= M1 and M1^2 <= M2.
  const double second_high = std::min(1.0, m2 + r2 + outward);
  const double second_low = std::max(0.0, m2 - r2 - outward);
  const double low = std::max({0.0, m1 - r1 - outward, second_low - outward});
  const double high = std::min({1.0, m1 + r1 + outward, std::sqrt(second_high) + outward});
  const double a = std::min(low, high), b = std::max(low, high);
  const double near = t - loose, far = t + loose;
  const double floor_high = floor * (1 + outward), floor_low = floor * (1 - outward);
  // p rises with M2. With an active variance it rises with M1 up to M2 / t and falls from there;
  // with an active floor it rises.
  double most =
      std::max(light(a, second_high, near, floor_high), light(b, second_high, near, floor_high));
  if (near > 0) {
    const double top = std::clamp(second_high / near, a, b);
    most = std::max(most, light(top, second_high, near, floor_high));
  }
  double least =
      std::min(light(a, second_low, far, floor_low), light(b, second_low, far, floor_low));
  const double turn = std::clamp(std::sqrt(std::max(0.0, second_low - floor_low)), a, b);
  least = std::min(least, light(turn, second_low, far, floor_low));
  // A variance is a difference: its rounding counts against the floor, or against itself.
  const double v = std::max(floor, 0x1p-50);
  const double slack = outward + 0x1p-50 / v;
  return {std::max(0.0, least - std::min(1.0, slack)), std::min(1.0, most + std::min(1.0, slack))};
}

}  // namespace bitshade
