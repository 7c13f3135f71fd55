// The fewest bits that keep an error on one scene: each stage alone in the format, the rest exact,
// or every stage in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bitshade/study/frame.hpp"
#include "run/stages.hpp"

namespace bitshade::bit_search {

/// What bits are counted of.
enum class bit_unit { unorm, significand, fraction };

/// One search: a stage alone, or all of them, in one kind of format.
struct scene_search {
  std::optional<stage> which;  ///< none: every stage
  bit_unit unit = bit_unit::unorm;
};

/// `found` bits keep every receiver of the scene within eps, and one bit fewer does not.
struct scene_bits {
  std::string technique;
  std::string stage;  ///< "all": every stage in the format
  std::string unit;
  int layers = 1;
  double min_variance = 0;  ///< 0: the technique has no floor
  bool bounded = true;     ///< whether a bound predicts; not of all stages, nor of four moments
  int predicted = 0;       ///< for every footprint; 0: more than the widest looked at
  int found = 0;           ///< on this scene; 0: the widest does not suffice
  double error = 0;        ///< largest format error with `found` bits
  double error_below = 0;  ///< and with one bit fewer
};

/// The searches that a configuration calls for, its format not read: stores (texels, resolve, blur,
/// mips) in unorms, of ESM and EVSM in significands, of savsm in both; the running sums of savsm in
/// significands, since sums of unorms lose nothing; weights in fraction bits; shading of variances
/// in significands; and all stages together in the stores' formats, which is what a map takes. The
/// arithmetic of filters has no format of its own.
std::vector<scene_search> searches_of(const configuration& how);

/// Searches the fewest bits of a configuration, whose format is not read; one exact run serves all
/// searches.
///
/// Policy   bits are halved: the largest error is taken to fall with them. Of all stages in a
///          format, everything but stores is done in binary32 or binary64, as run_pipeline() does.
/// Failure  as run_staged().
std::vector<scene_bits> search_scene(const frame& scene, const configuration& how,
                                     const std::vector<scene_search>& searches, double tolerated,
                                     int threads = 0);

}  // namespace bitshade::bit_search
