#include "run/engines.hpp"
#include "run/exact.hpp"
#include "run/layered_run.hpp"

namespace bitshade {

namespace {

template <int S, bool General>
void run_in(run_context& run) {
  exact_engine<S, General> engine(run);
  run_layers(engine, run);
}

}  // namespace

void run_variance_exact(run_context& run) {
  if (depth_bits_of(run.scene) <= common_depth_bits) {
    constexpr int bits = common_depth_bits + 1;
    run.look.plain() ? run_in<bits, false>(run) : run_in<bits, true>(run);
  } else {
    constexpr int bits = any_depth_bits + 1;
    run.look.plain() ? run_in<bits, false>(run) : run_in<bits, true>(run);
  }
}

}  // namespace bitshade
