// Four-moment shadow maps as runs.
#include "run/filtered_exact.hpp"
#include "run/texel_maps.hpp"
#include "run/texel_technique.hpp"

namespace bitshade {

void run_msm_native(run_context& run) {
  run_texel_map(run, stored_msm_map(run.how));
}

/// A basis changes no exact result: filters are affine, and so is it.
void run_msm_exact(run_context& run) {
  run_filtered_exact(run, msm_map{nullptr, run.how.moment_bias, run.how.bound});
}

}  // namespace bitshade
