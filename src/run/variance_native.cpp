#include "run/variance.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"

namespace bitshade {

namespace {

/// Says so where the floor is under what the format's noise needs, in the widest layer in use.
void note_low_floor(run_context& run) {
  if (run.how.noise_floor) return;
  double width = 0;
  for (std::size_t i = 0; i < run.layers.intervals.size(); ++i) {
    const interval& layer = run.layers.intervals[i];
    if (!run.layers.users[i].empty()) width = std::max(width, layer.far - layer.near);
  }
  const double noise = variance_noise(run.how, run.storage, run.scene.depth);
  const double needed = floor_for(noise, tolerated_error) * width * width;
  if (!(run.how.min_variance < needed)) return;
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, needed, std::chars_format::general, 3).ptr;
  run.result.notes.push_back("the floor " + detail::shortest(run.how.min_variance) + " is under " +
                             std::string(text, end) + ", which the noise of " + run.how.format +
                             " needs to keep lit receivers within 1/255");
}

template <class T>
void run_in(run_context& run) {
  native_engine<T, variance_technique<T>> engine(
      run, variance_technique<T>(run.how, run.storage, run.scene.depth));
  run_layers(engine, run);
}

}  // namespace

void run_variance_native(run_context& run) {
  note_low_floor(run);
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
