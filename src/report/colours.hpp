// The colours of pictures and plots: chosen in Oklab, told apart by colour-blind eyes.
#pragma once

#include <array>
#include <span>

#include "report/picture.hpp"

namespace bitshade {

/// Lightness and the green-red and blue-yellow axes of a colour [Ottosson20].
struct oklab {
  double lightness = 0, a = 0, b = 0;
};
oklab to_oklab(rgb colour);
rgb from_oklab(const oklab& colour);

/// Steps on each side of an error map's palette; index error_steps is "no error".
inline constexpr int error_steps = 126;
/// The smallest error that an error map tells from none, and the largest that it tells apart.
inline constexpr double error_scale_least = 1e-4, error_scale_most = 1.0;
/// Palette indices of a legend's ink and paper.
inline constexpr std::uint8_t ink_index = 253, paper_index = 254;

/// The palette of signed error maps: blue where too dark, near-white where right, orange where too
/// light. Lightness falls evenly and alike on both sides; the sides differ in the blue-yellow axis,
/// which red-green blindness leaves whole.
const std::vector<rgb>& error_palette();

/// Index of a signed error in that palette: symmetric, logarithmic from error_scale_least to
/// error_scale_most, the same for every picture, so that any two maps compare. NaN is ink.
std::uint8_t error_index(double error);

/// Colours of layers and of plots' lines [OkabeIto08], without black and yellow.
std::span<const rgb> categories();

/// "#rrggbb".
std::string hex(rgb colour);

}  // namespace bitshade
