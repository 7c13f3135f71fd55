// The splits of a configuration on a frame.
#pragma once

#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade {

/// s_0 = 0 .. s_N = 1: uniform, as given, or where Lloyd relaxation comes to rest on this frame.
/// Techniques without layers have {0, 1}.
std::vector<double> splits_of(const frame& scene, const configuration& how, int threads);

}  // namespace bitshade
