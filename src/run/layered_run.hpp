// One engine over all layers: generate, shade whoever looks it up, combine.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "run/engines.hpp"

namespace bitshade {

/// An engine whose light is that of several lookups, one after the other: layers combine each with
/// its own kind, and only what is finished is averaged.
template <class Engine>
class averaging_engine {
 public:
  using light = std::vector<typename Engine::light>;

  averaging_engine(Engine& engine, const run_context& run) : engine_(engine), run_(run) {}

  void generate(const interval& layer) { engine_.generate(layer); }
  template <class Use>
  void visit(std::span<const std::uint32_t> users, Use use) {
    const image<float>& map = run_.scene.depth;
    engine_.visit(users, [&](std::uint32_t user, const auto& one) {
      use(user, [&](const receiver& r) {
        light all;
        each_lookup(r, run_.how.filtered.lookups, map.width, map.height,
                    [&](const receiver& there) { all.push_back(one(there)); });
        return all;
      });
    });
  }
  static light darker(const light& a, const light& b) {
    light result;
    for (std::size_t i = 0; i < a.size(); ++i) result.push_back(Engine::darker(a[i], b[i]));
    return result;
  }
  auto blended(const light& near, const light& far, const receiver& r, double split) const {
    std::vector<decltype(engine_.blended(near[0], far[0], r, split))> result;
    for (std::size_t i = 0; i < near.size(); ++i) {
      result.push_back(engine_.blended(near[i], far[i], r, split));
    }
    return result;
  }
  template <class Light>
  double finished(const std::vector<Light>& all) const {
    return engine_.mean(std::span<const Light>(all));
  }

 private:
  Engine& engine_;
  const run_context& run_;
};

/// Runs an engine over a table of layers.
///
/// An engine generates one layer at a time, so that memory does not grow with their number, and
/// tells the darker of two lights, their blend at a split, and a light's number.
template <class Engine>
void run_each_layer(Engine& engine, const frame& scene, const configuration& how,
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
    engine.visit(table.users[i], [&](std::uint32_t at, const auto& light_of) {
      const light p = light_of(scene.receivers[at]);
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

/// Runs an engine (native_engine, exact_engine) over a run's layers, with as many lookups a light
/// as it asks for.
template <class Engine>
void run_layers(Engine& engine, run_context& run) {
  const bool empty_layers = run.effects.simulates("layers without receivers");
  if (run.how.filtered.lookups == 1) {
    run_each_layer(engine, run.scene, run.how, run.layers, empty_layers, run.result);
  } else {
    averaging_engine<Engine> all(engine, run);
    run_each_layer(all, run.scene, run.how, run.layers, empty_layers, run.result);
  }
}

}  // namespace bitshade
