// Shading in an arithmetic chosen at run time: the templates, instantiated once for each width.
#pragma once

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/layers.hpp"

namespace bitshade {

/// One receiver's moments and what shades them.
///
/// Units    moments in the layer's own depth; t and min_variance in depth.
struct shading_input {
  double first = 0, second = 0;
  double t = 1;
  interval layer{0, 1};
  double min_variance = 1e-5;
  bool centred = false;  ///< the second moment is 4 (x - 1/2)^2
};

/// Loads, warps and shades: every value rounded on the way in, every operation rounded once.
using shading_function = double (*)(const shading_input&);

/// The shading of an arithmetic: half, bfloat16 and every e8m1 .. e8m23, binary32 included;
/// binary64. Null for any other.
shading_function shading_in(const encoding& arithmetic);

/// The arithmetics that shading_in knows, for messages.
inline constexpr const char* shading_arithmetics =
    "half, bfloat16, tf32, e8m1 to e8m23 (binary32) and binary64";

}  // namespace bitshade
