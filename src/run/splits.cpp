#include "run/splits.hpp"

#include <algorithm>

#include "bitshade/shadow/optimal_splits.hpp"
#include "bitshade/study/measures.hpp"
#include "run/lloyd.hpp"
#include "run/pipeline.hpp"

namespace bitshade {

namespace {

/// Splits of least measured error: one split after the other tries places around it, first far,
/// then near, and keeps the one whose RMSE over every 16th receiver is smallest.
std::vector<double> searched_splits(const frame& scene, const configuration& how,
                                    std::vector<double> interior, int threads) {
  frame some;
  some.depth = scene.depth;
  some.surface = scene.surface;
  some.samples = scene.samples;
  for (std::size_t i = 0; i < scene.receivers.size(); i += 16) {
    some.receivers.push_back(scene.receivers[i]);
  }
  some.view_width = static_cast<int>(some.receivers.size());
  some.view_height = 1;
  const auto truth = truth_geometric(some, how, threads);
  const auto error_of = [&](std::vector<double> splits) {
    configuration trial = how;
    trial.format = "binary64";
    trial.splits = split_rule::manual;
    std::sort(splits.begin(), splits.end());
    const auto full = splits_from(splits);
    trial.manual_splits.assign(full.begin() + 1, full.end() - 1);
    trial.layers = static_cast<int>(full.size()) - 1;
    const auto seen = run_pipeline(some, trial, make_plan(some, trial, threads), threads);
    return compare(seen.visibility, truth).rmse;
  };
  double least = error_of(interior);
  for (double reach = 0.25; reach > 0x1p-10; reach /= 4) {
    for (auto& split : interior) {
      const double middle = split;
      for (int k = -4; k <= 4; ++k) {
        const double before = split;
        const double tried =
            on_split_grid(std::clamp(middle + k * reach / 4, split_grid, 1 - split_grid));
        if (tried == before) continue;
        split = tried;
        const double error = error_of(interior);
        if (error < least) {
          least = error;
        } else {
          split = before;
        }
      }
    }
  }
  return interior;
}

}  // namespace

found_splits splits_of(const frame& scene, const configuration& how, int threads) {
  if (how.method != technique::lvsm || how.layers == 1) return {{0, 1}, {}};
  if (how.splits == split_rule::uniform) return {uniform_splits(how.layers), {}};
  const double narrowest = std::max(split_grid, on_split_grid(how.min_width));
  if (how.splits == split_rule::manual) return {splits_from(how.manual_splits, narrowest), {}};
  const lloyd_field field(scene, how, threads);
  if (how.splits == split_rule::optimal) {
    const auto count = static_cast<std::size_t>(how.layers - 1);
    return {splits_from(optimal_splits(field.samples(), count), narrowest), {}};
  }
  const lloyd_result rest = relaxed_splits(field, how);
  found_splits found{{}, notes_of(rest, how)};
  found.splits = splits_from(how.splits == split_rule::receivers
                                 ? searched_splits(scene, how, rest.interior, threads)
                                 : rest.interior,
                             narrowest);
  return found;
}

}  // namespace bitshade
