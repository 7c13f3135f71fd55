// How a map is filtered beyond its taps and their spread: part of a configuration.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bitshade {

/// The shape of a blur's weights.
enum class blur_shape { gaussian, box };

inline constexpr std::array<std::string_view, 2> blur_shape_names{"gaussian", "box"};

/// How the blur reads its taps.
///
///   separable  along the rows, stored, then along the columns
///   one_pass   over the square of taps at once: nothing is stored between
///   linear     separable, two taps in one bilinear fetch between them
enum class blur_way { separable, one_pass, linear };

inline constexpr std::array<std::string_view, 3> blur_way_names{"separable", "one-pass", "linear"};

/// Source   [EVSMReport] for all of them.
struct filtering {
  int msaa = 1;  ///< samples a texel, resolved before shading: 1, 2, 4 or 8
  blur_shape shape = blur_shape::gaussian;
  blur_way way = blur_way::separable;
  int fraction_bits = 8;  ///< of a linear fetch's place between two texels; 0: not rounded
  int lookups = 1;        ///< n: each light is the mean of n x n lookups a texel apart

  /// Throws std::invalid_argument with one sentence where a field has no meaning.
  void validate() const {
    const auto refuse = [](const std::string& why) { throw std::invalid_argument(why); };
    if (msaa != 1 && msaa != 2 && msaa != 4 && msaa != 8) {
      refuse("msaa = " + std::to_string(msaa) + ": give 1, 2, 4 or 8 samples a texel");
    }
    if (fraction_bits < 0 || fraction_bits > 16) {
      refuse("blur fraction bits = " + std::to_string(fraction_bits) +
             " is outside 1 to 16, and not 0 for all of them");
    }
    if (lookups < 1 || lookups > 5 || lookups % 2 == 0) {
      refuse("lookups = " + std::to_string(lookups) +
             " along each side: give 1, 3 or 5, so that the middle one is the receiver's own");
    }
  }
};

}  // namespace bitshade
