// The method under test as a handful of functions, so that a test can put a worse one in its place.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bitshade/arithmetic/ball.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/msm.hpp"
#include "claims/sample.hpp"
#include "run/pipeline.hpp"

namespace bitshade::claims {

/// Certified enclosures of 1792 bits, which hold products of four moments of binary32 depths
/// without a rounding: where a root enters, nothing else is in doubt.
using enclosed = ball<28>;

/// What the claims are about: the library's own templates in exact arithmetic, its layers, its
/// relaxation, its pipeline. library_method() fills every member.
struct method {
  /// What a filter does to a footprint of equal weights: the mean.
  number (*filter)(std::span<const number>);
  number (*metric)(const number&, const number&, const number&);                    ///< (13)
  number (*warp)(const number&, const interval&);                                   ///< (6)
  mean_variance<number> (*variance)(const number&, const number&);                  ///< (2)
  number (*chebyshev)(const mean_variance<number>&, const number&, const number&);  ///< (3)
  number (*floor)(double, const interval&);                                         ///< (7)
  std::vector<interval> (*intervals)(std::span<const double>, double);              ///< (8)
  int (*layer_of)(const number&, std::span<const double>);
  std::vector<double> (*uniform_splits)(int);
  number (*reduce)(const number&, const number&);                         ///< (11)
  lloyd_sample (*second_occluder)(double, double, const weight_limits&);  ///< (9)
  double (*relax)(lloyd_relaxation&, const lloyd_samples&);               ///< one frame
  double (*darker)(const double&, const double&);                         ///< (10)
  enclosed (*four_moments)(const four_moments<enclosed>&, const enclosed&);
  std::function<cell(const frame&, const configuration&, int)> render;
};

method library_method();

}  // namespace bitshade::claims
