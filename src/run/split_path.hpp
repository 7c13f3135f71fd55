// Splits that follow a moving scene: Lloyd relaxation from frame to frame.
#pragma once

#include <vector>

#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade {

/// Where one frame's splits lie, and how good that is.
struct split_place {
  std::vector<double> interior;
  double move = 0;         ///< the largest move since the frame before
  double cost = 0;         ///< of these splits on this frame (lloyd_relaxation::cost)
  double least = 0;        ///< of the best splits on this frame
  int teleportations = 0;  ///< since the first frame
};

/// Carries splits from frame to frame. Rules that relax start from equal distances and take some
/// steps a frame, as an engine does; other rules find their splits anew on every frame.
class split_follower {
 public:
  split_follower(const configuration& how, int steps_a_frame);

  /// The configuration of the next frame, its splits as numbers where they relax.
  configuration follow(const frame& scene, int threads);
  /// The place of the splits that a run of that configuration used.
  split_place place_of(const frame& scene, const std::vector<double>& splits, int threads);

 private:
  bool relaxing() const;

  configuration how_;
  int steps_;
  lloyd_relaxation relaxation_;
  split_place last_;
};

}  // namespace bitshade
