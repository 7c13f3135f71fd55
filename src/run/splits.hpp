// The splits of a configuration on a frame.
#pragma once

#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade {

/// s_0 = 0 .. s_N = 1, and what the user should know of how they were found.
struct found_splits {
  std::vector<double> splits;
  std::vector<std::string> notes;
};

/// Splits by the configuration's rule: uniform, as given, or found on this frame. Techniques
/// without layers have {0, 1}.
found_splits splits_of(const frame& scene, const configuration& how, int threads);

}  // namespace bitshade
