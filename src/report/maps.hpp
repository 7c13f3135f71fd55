// Pictures of a frame's results: visibility, signed errors with their legend, layers, shading.
#pragma once

#include <span>
#include <vector>

#include "bitshade/study/frame.hpp"
#include "report/picture.hpp"

namespace bitshade {

/// Values with 1, white, where there is no receiver and so no number.
std::vector<double> without_gaps(std::span<const double> values);

/// Grey, black where no light arrives and white where all of it does; pixels without a receiver
/// are white.
picture visibility_map(std::span<const double> visibility, int width, int height);

/// `value` - `truth` in the error palette, above a legend in the picture itself.
picture error_map(std::span<const double> value, std::span<const double> truth, int width,
                  int height);

/// The legend alone: the palette with its ticks, `width` pixels wide, legend_height high.
picture error_legend(int width);
inline constexpr int legend_height = 30;

/// The light's depth map, near dark and far light; where nothing was drawn it is white.
picture depth_map(const frame& input);

/// The scene lit by a directional light, with `visibility` as its shadow.
picture shaded_map(const frame& input, std::span<const double> visibility);

/// Each receiver in the colour of the layer that it falls into, darkened by `visibility`;
/// `layers[i]` is the index of pixel i's layer.
picture layer_map(const frame& input, std::span<const double> visibility,
                  std::span<const int> layers);

}  // namespace bitshade
