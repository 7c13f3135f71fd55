// The claims, each from the file that measures it.
#pragma once

#include "claims/claim.hpp"

namespace bitshade::claims {

claim planar_claim();           // C1
claim bleeding_falls_claim();   // C2
claim monotonic_warp_claim();   // C3
claim perfect_warp_claim();     // C4
claim chosen_layer_claim();     // C5
claim one_sample_claim();       // C6
claim above_layer_claim();      // C7
claim boundary_claim();         // C8
claim layer_floor_claim();      // C9
claim overlap_claim();          // C10
claim transition_claim();       // C11
claim less_precision_claim();   // C12
claim sixteen_bits_claim();     // C13
claim two_layers_claim();       // C14
claim higher_moments_claim();   // C15
claim second_occluder_claim();  // C16
claim convergence_claim();      // C17
claim teleportation_claim();    // C18
claim split_between_claim();    // C19
claim uniform_splits_claim();   // C20
claim fourier_claim();          // C21
claim layer_cost_claim();       // C22
claim exponential_claim();      // C23
claim blur_cost_claim();        // C24
claim summed_area_claim();      // C25
claim depth_range_claim();      // C26
claim within_layer_claim();     // C27
claim border_claim();           // C28
claim sampling_claim();         // C29

}  // namespace bitshade::claims
