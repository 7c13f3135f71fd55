// One engine over all layers: generate, shade whoever looks it up, combine.
#pragma once

#include <limits>
#include <vector>

#include "run/lookup.hpp"
#include "run/pipeline.hpp"

namespace bitshade {

/// Runs an engine (native_engine, exact_engine, ...) over a table of layers.
///
/// An engine generates one layer at a time, so that memory does not grow with their number, and
/// tells the darker of two lights, their blend at a split, and a light's number.
template <class Engine>
void run_layers(Engine& engine, const frame& scene, const configuration& how,
                const layer_table& table, bool empty_layers, cell& result) {
  using light = typename Engine::light;
  result.visibility.assign(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  const bool several = how.lookup != layer_lookup::own && table.intervals.size() > 1;
  const bool blending = !table.blends.empty() && how.lookup == layer_lookup::own;
  const bool pairs = blending || several;
  std::vector<light> waiting(pairs ? scene.receivers.size() : 0);

  for (std::size_t i = 0; i < table.intervals.size(); ++i) {
    if (table.users[i].empty() && !empty_layers) continue;
    engine.generate(table.intervals[i]);
    engine.shade(table.users[i], [&](std::uint32_t at, const light& p) {
      if (several) {
        waiting[at] = i == 0 ? p : Engine::darker(waiting[at], p);
        const std::size_t last = how.lookup == layer_lookup::nearer
                                     ? static_cast<std::size_t>(table.own[at])
                                     : table.intervals.size() - 1;
        if (i == last) result.visibility[at] = engine.finished(waiting[at]);
      } else if (blending && table.blends[at].near != table.blends[at].far) {
        const auto& pair = table.blends[at];
        if (static_cast<int>(i) == pair.near) {
          waiting[at] = p;
        } else {
          const double split = table.splits[static_cast<std::size_t>(pair.far)];
          result.visibility[at] =
              engine.finished(engine.blended(waiting[at], p, scene.receivers[at], split));
        }
      } else {
        result.visibility[at] = engine.finished(p);
      }
    });
  }
}

}  // namespace bitshade
