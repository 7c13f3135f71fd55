#include "run/natural.hpp"

#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"

namespace bitshade {

bool runs_naturally(const run_context& run) {
  return run.natural && natural_texels::can_hold(run.storage) && run.look.plain() &&
         run.look.samples == 1 && run.how.filtered.lookups == 1 &&
         (run.how.filtered.way == blur_way::separable || !run.how.blurred()) &&
         run.layers.blends.empty() && run.how.lookup == layer_lookup::own;
}

double finished_light(const configuration& how, float light) {
  if (how.bleeding_reduction == 0) return static_cast<double>(light);
  return static_cast<double>(
      reduce_bleeding(light, static_cast<float>(on_split_grid(how.bleeding_reduction))));
}

}  // namespace bitshade
