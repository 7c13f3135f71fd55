#include "run/splits.hpp"

#include <algorithm>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/optimal_splits.hpp"
#include "bitshade/study/measures.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/pipeline.hpp"
#include "run/storage.hpp"

namespace bitshade {

namespace {

/// The samples that the source takes: a 16-bit VSM of the whole depth range, read between texels.
/// The storage is the same for every format of a study, so that the splits are, too.
image<lloyd_sample> samples_of(const image<float>& depth, int threads) {
  const auto storage = storage_named("unorm16");
  image<float> moments(depth.width, depth.height, 2);
  for_rows(threads, depth.height, [&](int y) {
    warp_row<float>(depth.row(y), interval{0, 1}, moments.row(y), 2);
    square_row<float>(moments.row(y), 2);
    round_row(storage, moments.row(y));
  });
  image<lloyd_sample> samples(std::max(1, depth.width - 1), std::max(1, depth.height - 1));
  for_rows(threads, samples.height, [&](int y) {
    const int below = std::min(y + 1, depth.height - 1);
    for (int x = 0; x < samples.width; ++x) {
      const int right = std::min(x + 1, depth.width - 1);
      const auto mean = [&](int c) {
        return (static_cast<double>(moments.at(x, y, c)) + moments.at(right, y, c) +
                moments.at(x, below, c) + moments.at(right, below, c)) /
               4;
      };
      samples.at(x, y) = lloyd_sample_of(mean(0), mean(1));
    }
  });
  return samples;
}

/// The same samples where the camera's receivers look: a texel that no one sees has no say, one
/// that fills the picture has a large one.
std::vector<lloyd_sample> seen_samples(const frame& scene, const image<lloyd_sample>& samples) {
  std::vector<lloyd_sample> seen;
  for (const receiver& r : scene.receivers) {
    if (!has_receiver(r)) continue;
    const auto at = [](float u, int size, int last) {
      return std::clamp(texel_floor(static_cast<double>(u) * size - 0.5), 0, last);
    };
    seen.push_back(samples.at(at(r.u, scene.depth.width, samples.width - 1),
                              at(r.v, scene.depth.height, samples.height - 1)));
  }
  return seen;
}

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

/// Frames after which a scene that stands still is taken as it is.
constexpr int most_frames = 1000;

}  // namespace

std::vector<double> splits_of(const frame& scene, const configuration& how, int threads) {
  if (how.method != technique::lvsm || how.layers == 1) return {0, 1};
  if (how.splits == split_rule::uniform) return uniform_splits(how.layers);
  if (how.splits == split_rule::manual) return splits_from(how.manual_splits);
  const auto all = samples_of(scene.depth, threads);
  const lloyd_samples samples(how.splits == split_rule::lloyd_view ? seen_samples(scene, all)
                                                                   : all.texels);
  const auto interior = static_cast<std::size_t>(how.layers - 1);
  if (how.splits == split_rule::optimal) return splits_from(optimal_splits(samples, interior));
  const auto start = uniform_splits(how.layers);
  lloyd_relaxation relaxation({start.begin() + 1, start.end() - 1});
  relaxation.relax(samples, most_frames);
  if (how.splits == split_rule::receivers) {
    return splits_from(searched_splits(scene, how, relaxation.interior(), threads));
  }
  return splits_from(relaxation.interior());
}

}  // namespace bitshade
