// Times over repeated runs: medians with their quartiles.
#pragma once

#include <vector>

#include "run/pipeline.hpp"
#include "run/row.hpp"

namespace bitshade {

/// Median and quartiles, linear between the two nearest values; all zero for no values.
spread spread_of(std::vector<double> values);

/// What every time is a multiple of: a single-layer VSM in binary32 with the same filter, run
/// natively on the same frame.
configuration reference_of(const configuration& how);

/// Times a configuration at its storage's natural speed, `repeats` times, each beside a run of the
/// reference, so that whatever else the machine does slows both.
natural_times time_naturally(const frame& scene, const configuration& how, const plan& effects,
                             int repeats, int threads);

}  // namespace bitshade
