#include "run/staged_variance.hpp"

#include "run/staged.hpp"
#include "run/staged_layers.hpp"

namespace bitshade {

void run_staged_variance(const staged_run& run) {
  in_arithmetic_of(run.storage, [&]<class T>(T) {
    run_staged_layers<staged_engine<T, staged_variance>>(run);
  });
}

}  // namespace bitshade
