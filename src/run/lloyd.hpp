// Lloyd relaxation on frames: what it samples, how it steps, and how good its splits are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/lloyd_pyramid.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade {

/// What one frame says about where the splits should lie.
class lloyd_field {
 public:
  /// Samples of the map, or of what the camera's receivers see of it (split_rule::lloyd_view), from
  /// a 16-bit VSM of the whole depth range, read between texels: the same for every format of a
  /// study, so that the splits are, too.
  /// Failure  usage_error where the format of the sums is none.
  lloyd_field(const frame& scene, const configuration& how, int threads);

  /// One frame's relaxation; returns the largest move.
  double step(lloyd_relaxation& splits) const;
  /// Steps until rest; returns the number of frames.
  int relax(lloyd_relaxation& splits, int most_frames) const;
  /// The exact cost of splits, in units of weight * depth^2.
  double cost(const std::vector<double>& interior) const;
  /// The least cost that `count` splits can have.
  double least_cost(std::size_t count) const;
  const lloyd_samples& samples() const { return exact_; }

 private:
  lloyd_field(const image<lloyd_sample>& samples, const lloyd_choices& choices);

  lloyd_samples exact_;
  std::vector<lloyd_pyramid> rounded_;  ///< the sums that the steps use, if they are not exact
};

/// Where relaxation came to rest.
struct lloyd_result {
  std::vector<double> interior;
  int frames = 0;
  int teleportations = 0;
  bool lost = false;  ///< the sums' format lost samples that had weight
};

/// Relaxes from equal distances to rest, or for as many frames as the choices allow.
lloyd_result relaxed_splits(const lloyd_field& field, const configuration& how);

/// What the user should know of a result: sums that lost weights, splits that still move.
std::vector<std::string> notes_of(const lloyd_result& result, const configuration& how);

/// A relaxation's cost beside the least that there is.
struct lloyd_comparison {
  std::string name;
  lloyd_result result;
  double cost = 0, least = 0;

  double ratio() const { return least > 0 ? cost / least : 1; }
};

/// Relaxation as configured, then with all splits a frame and with two, each held to the optimum.
std::vector<lloyd_comparison> compare_with_optimum(const frame& scene, const configuration& how,
                                                   int threads);

}  // namespace bitshade
