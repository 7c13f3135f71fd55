// Exponential shadow maps without rounding.
#include "io/error.hpp"
#include "io/text.hpp"
#include "run/filtered_exact.hpp"
#include "run/texel_maps.hpp"

namespace bitshade {

void require_exact_exponent(double exponent) {
  if (exponent <= exact_exponent_cap) return;
  throw usage_error("exact exponential maps take exponents up to " + brief(exact_exponent_cap) +
                    ", not " + shortest(exponent));
}

void run_esm_exact(run_context& run) {
  require_exact_exponent(run.how.exponent);
  run_filtered_exact(run, esm_map{{run.how.exponent, 0}});
}

}  // namespace bitshade
