#include "run/lookup.hpp"

namespace bitshade {

layer_table layers_of(const frame& scene, const configuration& how, const plan& effects) {
  layer_table table;
  table.splits = effects.splits;
  table.intervals = layer_intervals(table.splits, effects.simulates("overlap") ? how.overlap : 0.0);
  table.users.resize(table.intervals.size());
  table.own.assign(scene.receivers.size(), -1);
  const bool blending = effects.simulates("transition");
  if (blending) table.blends.resize(scene.receivers.size());

  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const receiver& r = scene.receivers[i];
    if (!has_receiver(r)) continue;
    const auto index = static_cast<std::uint32_t>(i);
    table.own[i] =
        how.direct_index ? uniform_layer_of(r.t, how.layers) : layer_of(r.t, table.splits);
    if (how.lookup != layer_lookup::own) {
      const auto count = how.lookup == layer_lookup::every
                             ? table.users.size()
                             : static_cast<std::size_t>(table.own[i]) + 1;
      for (std::size_t k = 0; k < count; ++k) table.users[k].push_back(index);
    } else if (blending) {
      table.blends[i] = blended_layers(static_cast<double>(r.t), table.splits, how.overlap);
      table.users[static_cast<std::size_t>(table.blends[i].near)].push_back(index);
      if (table.blends[i].far != table.blends[i].near) {
        table.users[static_cast<std::size_t>(table.blends[i].far)].push_back(index);
      }
    } else {
      table.users[static_cast<std::size_t>(table.own[i])].push_back(index);
    }
  }
  return table;
}

}  // namespace bitshade
