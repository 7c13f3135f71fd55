// Exponential shadow maps without rounding.
#include "io/error.hpp"
#include "run/filtered_exact.hpp"
#include "run/texel_maps.hpp"

namespace bitshade {

void run_esm_exact(run_context& run) {
  if (run.how.exponent > exact_exponent_cap) {
    throw usage_error("exact ESM takes exponents up to 300, not " +
                      std::to_string(run.how.exponent));
  }
  run_filtered_exact(run, esm_map{{run.how.exponent, 0}});
}

}  // namespace bitshade
