#include "claims/table.hpp"

namespace bitshade::claims {

const std::vector<claim>& all_claims() {
  static const std::vector<claim> all{
      planar_claim(),       bleeding_falls_claim(), monotonic_warp_claim(), perfect_warp_claim(),
      chosen_layer_claim(), one_sample_claim(),     above_layer_claim(),    boundary_claim(),
      layer_floor_claim(),  within_layer_claim()};
  return all;
}

}  // namespace bitshade::claims
