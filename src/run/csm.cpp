// Convolution shadow maps as runs.
#include "run/filtered_exact.hpp"
#include "run/texel_maps.hpp"
#include "run/texel_technique.hpp"

namespace bitshade {

void run_csm_native(run_context& run) {
  run_texel_map(run, csm_map{csm_constants_for(run.how.terms, run.storage.format)});
}

void run_csm_exact(run_context& run) {
  csm_constants constants;
  constants.terms = run.how.terms;
  constants.biased = false;
  run_filtered_exact(run, csm_map{constants});
}

}  // namespace bitshade
