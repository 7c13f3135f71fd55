#include "report/colours.hpp"

#include <algorithm>
#include <cmath>

namespace bitshade {
namespace {

double linear(std::uint8_t code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::uint8_t encoded(double c) {
  c = std::clamp(c, 0.0, 1.0);
  const double s = c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(s * 255 + 0.5);
}

}  // namespace

oklab to_oklab(rgb colour) {
  const double r = linear(colour[0]), g = linear(colour[1]), b = linear(colour[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

rgb from_oklab(const oklab& c) {
  const double l = c.lightness + 0.3963377774 * c.a + 0.2158037573 * c.b;
  const double m = c.lightness - 0.1055613458 * c.a - 0.0638541728 * c.b;
  const double s = c.lightness - 0.0894841775 * c.a - 1.2914855480 * c.b;
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {encoded(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3),
          encoded(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3),
          encoded(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3)};
}

const std::vector<rgb>& error_palette() {
  static const std::vector<rgb> palette = [] {
    // Lightness falls linearly with the step; chroma rises fast and falls again towards the dark
    // ends, as far as sRGB holds it. Hues: blue 255 degrees, orange 52 degrees, as (a, b).
    constexpr double blue_a = -0.2588, blue_b = -0.9659, orange_a = 0.6157, orange_b = 0.7880;
    std::vector<rgb> colours(256, rgb{0, 0, 0});
    for (int step = -error_steps; step <= error_steps; ++step) {
      const double x = std::abs(step) / static_cast<double>(error_steps);
      const double chroma = 0.158 * (1 - (1 - x) * (1 - x) * (1 - x)) * (1 - 0.30 * x * x);
      const oklab colour{0.968 - 0.60 * x, chroma * (step < 0 ? blue_a : orange_a),
                         chroma * (step < 0 ? blue_b : orange_b)};
      colours[static_cast<std::size_t>(step + error_steps)] = from_oklab(colour);
    }
    colours[ink_index] = {34, 34, 34};
    colours[paper_index] = {255, 255, 255};
    return colours;
  }();
  return palette;
}

std::uint8_t error_index(double error) {
  // Thresholds by repeated multiplication: no libm, so a picture's bytes are the same everywhere.
  // 1.0759... is 10^(4/126), so that error_steps steps span the four decades.
  static const std::array<double, error_steps> thresholds = [] {
    std::array<double, error_steps> t{};
    double value = error_scale_least;
    for (double& threshold : t) {
      threshold = value;
      value *= 1.0758297;
    }
    return t;
  }();
  if (error != error) return ink_index;
  const double magnitude = error < 0 ? -error : error;
  const auto step =
      std::upper_bound(thresholds.begin(), thresholds.end(), magnitude) - thresholds.begin();
  return static_cast<std::uint8_t>(error_steps + (error < 0 ? -step : step));
}

std::span<const rgb> categories() {
  static constexpr std::array<rgb, 6> colours{
      {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}}};
  return colours;
}

std::string hex(rgb colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "#";
  for (const std::uint8_t c : colour) {
    out += digits[c >> 4];
    out += digits[c & 15];
  }
  return out;
}

}  // namespace bitshade
