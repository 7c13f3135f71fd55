#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"

namespace bitshade {

namespace {

template <class T>
void run_in(run_context& run) {
  native_engine<T> engine(run.scene, run.how, run.storage, run.look, run.threads, run.result);
  run_layers(engine, run.scene, run.how, run.layers,
             run.effects.simulates("layers without receivers"), run.result);
}

}  // namespace

void run_variance_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
