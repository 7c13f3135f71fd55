#include "claims/method.hpp"

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/metric.hpp"

namespace bitshade::claims {
namespace {

number mean_of(std::span<const number> values) {
  number sum = 0;
  for (const number& v : values) sum += v;
  return sum / number(values.size());
}

double one_frame(lloyd_relaxation& splits, const lloyd_samples& field) {
  return splits.step(field);
}

number clamped_warp(const number& x, const interval& layer) {
  return bitshade::warp(x, layer, layer_warp::clamped);
}

cell run(const frame& scene, const configuration& how, int threads) {
  return run_pipeline(scene, how, make_plan(scene, how, threads), threads);
}

}  // namespace

method library_method() {
  return {mean_of,
          linear_metric<number>,
          clamped_warp,
          mean_and_variance<number>,
          bitshade::chebyshev<number>,
          layer_floor<number>,
          layer_intervals,
          bitshade::layer_of<number>,
          bitshade::uniform_splits,
          reduce_bleeding<number>,
          lloyd_sample_of,
          one_frame,
          evsm_bound<double>,
          hamburger_bound<enclosed>,
          run};
}

}  // namespace bitshade::claims
