// The plan's part on how the map is filtered: samples, ways to blur, lookups.
#pragma once

#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "bitshade/study/plan.hpp"

namespace bitshade {

/// The effects of configuration::filtered that are asked for, with their evidence.
std::vector<effect> filter_effects(const frame& scene, const configuration& how);

/// The smallest share of a texel that a blur's pass lets through, as it is simulated.
double smallest_blur_share(const configuration& how);

}  // namespace bitshade
