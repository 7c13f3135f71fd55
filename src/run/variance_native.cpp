#include "run/variance.hpp"

#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"

namespace bitshade {

namespace {

template <class T>
void run_in(run_context& run) {
  native_engine<T, variance_technique<T>> engine(
      run, variance_technique<T>(run.how, run.storage, run.scene.depth));
  run_layers(engine, run);
}

}  // namespace

void run_variance_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
