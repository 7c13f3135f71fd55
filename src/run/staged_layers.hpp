// All layers of a staged run.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "run/parallel.hpp"
#include "run/staged_base.hpp"

namespace bitshade {

/// All layers, as run_layers() does, with lights that remember which arithmetic they came from.
///
/// Shapes   an Engine has generate(layer), lights(receiver), blended(near, far, receiver, split)
///          and finished(lights).
template <class Engine>
void run_staged_layers(const staged_run& run) {
  Engine engine(run);
  const frame& scene = run.scene;
  const layer_table& table = run.layers;
  auto& visibility = run.result.visibility;
  visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::vector<staged_exact>> waiting(table.blends.empty() ? 0 : scene.receivers.size());
  for (std::size_t i = 0; i < table.intervals.size(); ++i) {
    const auto& users = table.users[i];
    if (users.empty()) continue;
    engine.generate(table.intervals[i]);
    for_ranges(run.threads, users.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::uint32_t at = users[k];
        const receiver& r = scene.receivers[at];
        auto p = engine.lights(r);
        if (table.blends.empty() || table.blends[at].near == table.blends[at].far) {
          visibility[at] = engine.finished(p);
        } else if (static_cast<int>(i) == table.blends[at].near) {
          waiting[at] = std::move(p);
        } else {
          const double split = table.splits[static_cast<std::size_t>(table.blends[at].far)];
          visibility[at] = engine.finished(engine.blended(waiting[at], p, r, split));
        }
      }
    });
  }
}

}  // namespace bitshade
