#include "run/timing.hpp"

#include <algorithm>
#include <cmath>

namespace bitshade {

spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {at(0.5), at(0.25), at(0.75)};
}

configuration reference_of(const configuration& how) {
  configuration reference = how;
  reference.method = technique::vsm;
  reference.format = "binary32";
  reference.layers = 1;
  reference.splits = split_rule::uniform;
  reference.manual_splits.clear();
  return reference;
}

natural_times time_naturally(const frame& scene, const configuration& how, const plan& effects,
                             int repeats, int threads) {
  natural_times times;
  times.repeats = repeats;
  const configuration reference = reference_of(how);
  const plan reference_effects = make_plan(scene, reference, threads);
  std::vector<double> map, shade, relative_map, relative_shade, relative;
  for (int i = 0; i <= repeats; ++i) {
    const cell beside =
        run_pipeline(scene, reference, reference_effects, threads, storage_speed::natural);
    const cell one = run_pipeline(scene, how, effects, threads, storage_speed::natural);
    if (i == 0) continue;  // caches and threads warm up
    times.natural = one.natural;
    map.push_back(one.map_seconds);
    shade.push_back(one.shade_seconds);
    const double unit = std::max(beside.map_seconds + beside.shade_seconds, 1e-9);
    relative_map.push_back(one.map_seconds / unit);
    relative_shade.push_back(one.shade_seconds / unit);
    relative.push_back((one.map_seconds + one.shade_seconds) / unit);
  }
  times.map = spread_of(map);
  times.shade = spread_of(shade);
  times.relative_map = spread_of(relative_map);
  times.relative_shade = spread_of(relative_shade);
  times.relative = spread_of(relative);
  return times;
}

}  // namespace bitshade
