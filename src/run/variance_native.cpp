#include "run/variance.hpp"

#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"

namespace bitshade {

namespace {

template <class T>
void run_in(run_context& run) {
  variance_technique<T> technique(run.how, run.storage, run.scene.depth);
  native_engine<T, variance_technique<T>> engine(run.scene, run.how, technique, run.storage,
                                                 run.look, run.threads, run.result);
  run_layers(engine, run.scene, run.how, run.layers,
             run.effects.simulates("layers without receivers"), run.result);
}

}  // namespace

void run_variance_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
