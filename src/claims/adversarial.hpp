// Footprints whose stored moments err as badly as a format allows: what bounds are held against.
#pragma once

#include <cmath>

namespace bitshade::claims {

/// Which way a texel's two roundings should err.
enum class worst {
  variance_too_small,  ///< first moment up, second down
  variance_too_large   ///< first moment down, second up
};

/// A depth within `reach` of `around` whose two moments both round by almost half a step, in the
/// wanted directions, on a grid of `steps` steps.
///
/// The first moment is put just past the middle of two codes; of `tries` such depths, evenly
/// spread, the one whose square lies closest to (and on the right side of) a middle is taken.
///
/// Policy   binary64; the caller measures what the depth really does in exact arithmetic.
inline double worst_texel(double steps, double around, double reach, worst side, int tries) {
  const double past = side == worst::variance_too_small ? 0x1p-12 : -0x1p-12;
  double best = around, best_loss = 2;
  for (int i = 0; i < tries; ++i) {
    const double code = std::floor((around + reach * (2.0 * i / tries - 1)) * steps);
    if (code < 0 || code + 1 > steps) continue;
    const double x = (code + 0.5 + past) / steps;
    const double scaled = x * x * steps;
    const double fraction = scaled - std::floor(scaled);
    const double loss = side == worst::variance_too_small ? 0.5 - fraction : fraction - 0.5;
    if (loss > 0x1p-20 && loss < best_loss) best_loss = loss, best = x;
  }
  return best;
}

/// Two texels, half and half.
struct texel_pair {
  double a = 0, b = 0;
};

/// A pair around `mean`, of about that standard deviation, both texels worst.
inline texel_pair worst_footprint(double steps, double mean, double deviation, double reach,
                                  worst side, int tries) {
  return {worst_texel(steps, mean - deviation, reach, side, tries),
          worst_texel(steps, mean + deviation, reach, side, tries)};
}

}  // namespace bitshade::claims
