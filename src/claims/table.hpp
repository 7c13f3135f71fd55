// The claims, each from the file that measures it.
#pragma once

#include "claims/claim.hpp"

namespace bitshade::claims {

claim planar_claim();          // C1
claim bleeding_falls_claim();  // C2
claim monotonic_warp_claim();  // C3
claim perfect_warp_claim();    // C4
claim chosen_layer_claim();    // C5
claim one_sample_claim();      // C6
claim above_layer_claim();     // C7
claim boundary_claim();        // C8
claim layer_floor_claim();     // C9
claim within_layer_claim();    // C27

}  // namespace bitshade::claims
