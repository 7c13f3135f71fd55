// Sine, cosine and tangent without libm, whose last bits change with the processor.
#pragma once

namespace bitshade {

inline constexpr double pi = 3.141592653589793;

/// Sine and cosine of `turns` full turns, within 1e-15 for |turns| < 1000.
struct turn {
  double sine, cosine;

  constexpr explicit turn(double turns) : sine(0), cosine(1) {
    // Into [-1/8, 1/8] by quarter turns, which only swap and negate; then Taylor.
    const double quarters = turns * 4;
    const long whole = static_cast<long>(quarters < 0 ? quarters - 0.5 : quarters + 0.5);
    const double x = (quarters - static_cast<double>(whole)) * (pi / 2);
    const double y = x * x;
    double s = 0, c = 0;
    for (int n = 9; n >= 0; --n) {  // y^10 / 20! < 1e-20
      s = 1 - s * y / ((2 * n + 2) * (2 * n + 3));
      c = 1 - c * y / ((2 * n + 1) * (2 * n + 2));
    }
    s *= x;
    switch (((whole % 4) + 4) % 4) {
      case 0:
        sine = s, cosine = c;
        break;
      case 1:
        sine = c, cosine = -s;
        break;
      case 2:
        sine = -s, cosine = -c;
        break;
      default:
        sine = -c, cosine = s;
        break;
    }
  }
};

/// Tangent of an angle in degrees, below 90.
constexpr double tangent_of_degrees(double degrees) {
  const turn t(degrees / 360);
  return t.sine / t.cosine;
}

}  // namespace bitshade
