// Per-pixel certificates: intervals that certainly hold what exact arithmetic would give.
#pragma once

#include <vector>

#include "run/pipeline.hpp"

namespace bitshade {

/// Bounds of a visibility; where there is no receiver both are NaN.
struct light_interval {
  double low = 0, high = 1;
  double width() const { return high - low; }
};

/// Intervals of each receiver, every one narrower than the one before or as wide.
///
///   global    from the format alone: K roundings of half a step, the worst footprint
///   stored    from the stored moments, each within K half steps, and depths in [0,1]
///   running   from the stored moments and the roundings that really happened on their way
///
/// Of a summed-area table in floating point the sums' roundings count to all three; what bounds them
/// beforehand grows with the map's texels (summed_mean_error), what happened rarely does.
struct certificates {
  std::vector<light_interval> global, stored, running;
  int roundings = 0;
};

/// Certificates of vsm, savsm and lvsm from the format pipeline's own numbers: the map as it was stored,
/// and a radius beside every moment that grows by each rounding's actual size and by a bound of the
/// arithmetic's. No exact run is made.
///
/// Error    evaluated in binary64 and widened by its own rounding: certain.
/// Failure  usage_error for other techniques, --lookup, --slope-term, --noise-floor and second
///          moments other than the square.
/// Source   docs/theory.md section 10.
certificates certify(const frame& scene, const configuration& how, int threads = 0);

/// The interval of p over all moments within the radii of m1 and m2 that depths in [0,1] can have.
///
/// Units    receiver and floor in the layer's own; `loose` an absolute error of the receiver.
light_interval light_of_box(double m1, double r1, double m2, double r2, double t, double floor,
                            double loose = 0x1p-50);

}  // namespace bitshade
