// The fewest bits that keep an error on one scene: each stage alone in the format, the rest exact.
#pragma once

#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade::bit_search {

/// `found` bits keep every receiver of the scene within eps, and one bit fewer does not.
struct scene_bits {
  std::string technique, stage, unit;
  int layers = 1;
  double min_variance = 0;
  int predicted = 0;       ///< for every footprint; 0: no bound up to the widest
  int found = 0;           ///< on this scene; 0: the widest does not suffice
  double error = 0;        ///< largest format error with `found` bits
  double error_below = 0;  ///< and with one bit fewer
};

}  // namespace bitshade::bit_search
