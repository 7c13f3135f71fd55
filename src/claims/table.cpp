#include "claims/table.hpp"

namespace bitshade::claims {

const std::vector<claim>& all_claims() {
  static const std::vector<claim> all{
      planar_claim(),       bleeding_falls_claim(), monotonic_warp_claim(), perfect_warp_claim(),
      chosen_layer_claim(), one_sample_claim(),     above_layer_claim(),    boundary_claim(),
      layer_floor_claim(),  overlap_claim(),        transition_claim(),     less_precision_claim(),
      sixteen_bits_claim(), two_layers_claim(),     higher_moments_claim(), second_occluder_claim(),
      convergence_claim(),  teleportation_claim(),  split_between_claim(),  uniform_splits_claim(),
      fourier_claim(),      layer_cost_claim(),     exponential_claim(),    blur_cost_claim(),
      summed_area_claim(),  depth_range_claim(),    within_layer_claim(),   border_claim(),
      sampling_claim()};
  return all;
}

}  // namespace bitshade::claims
