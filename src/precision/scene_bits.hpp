// The fewest bits that keep an error on one scene: each stage alone in the format, the rest exact.
#pragma once

#include <string>
#include <vector>

#include "bitshade/study/frame.hpp"
#include "run/stages.hpp"

namespace bitshade::bit_search {

/// `found` bits keep every receiver of the scene within eps, and one bit fewer does not.
struct scene_bits {
  std::string technique, stage, unit;
  int layers = 1;
  double min_variance = 0;
  int predicted = 0;       ///< for every footprint; 0: no bound up to the widest looked at
  int found = 0;           ///< on this scene; 0: the widest does not suffice
  double error = 0;        ///< largest format error with `found` bits
  double error_below = 0;  ///< and with one bit fewer
};

/// Searches one stage of a configuration, whose format is not read: store, blur and mips in unorms
/// (significands for evsm), weights in fraction bits, shading in significand bits.
///
/// Policy   bits are halved: the largest error is taken to fall with them.
/// Failure  as run_staged().
scene_bits search_scene(const frame& scene, const configuration& how, stage which, double tolerated,
                        int threads = 0);

}  // namespace bitshade::bit_search
