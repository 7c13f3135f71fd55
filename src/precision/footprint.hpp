// Footprints that a store serves as badly as it can: found by search, judged in exact arithmetic.
#pragma once

#include <vector>

#include "precision/store.hpp"

namespace bitshade::bit_search {

/// What a search is to break.
///
/// Units    floor in the layer's own depth^2.
struct footprint_question {
  moment_store store;
  int roundings = 1;            ///< K: the store, then K - 1 further ones, each of a blend of two
  double floor = 1e-4;          ///< sigma_min^2 / w^2
  int tries = 4000;             ///< depths looked at for each texel
  double depth_grid = 0x1p-40;  ///< of depths and receivers: finer than any store that is searched
};

/// Two halves of 2^(K-1) texels each, blended pairwise and stored again K - 1 times, as a blur's
/// passes are; their mean, which no store touches, shades the receiver. The blend is 5/8 and 3/8:
/// of plain means a tie goes to an even code, and the mean of two even codes needs no rounding.
///
/// Units    depths in the layer's own units.
struct footprint {
  std::vector<double> near, far;
  double receiver = 1;
};

/// The visibility that the stored moments give and the one that exact ones give.
struct footprint_error {
  double stored = 0, exact = 0;
  double mean = 0;      ///< of the true depths
  double variance = 0;  ///< of the true depths
  double size() const { return stored < exact ? exact - stored : stored - exact; }
};

/// Both visibilities in exact arithmetic: each is rounded once, to binary64.
footprint_error judged(const footprint_question& question, const footprint& texels);

struct worst_case {
  footprint texels;
  footprint_error error;
};

/// The worst footprint found: the same question gives the same one.
///
///   variance too small: true f + D, stored at the floor f; too large: the other way round. The
///   mean lies as near to 1 as the receiver beyond it allows, which is where D is largest.
///
/// Source   docs/theory.md sections 1, 6 and 9.
worst_case worst_footprint(const footprint_question& question);

}  // namespace bitshade::bit_search
