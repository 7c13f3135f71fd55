#include "run/lloyd.hpp"

#include <algorithm>

#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/optimal_splits.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/storage.hpp"

namespace bitshade {

namespace {

image<lloyd_sample> samples_of_map(const image<float>& depth, const weight_limits& limits,
                                   int threads) {
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
      samples.at(x, y) = lloyd_sample_of(mean(0), mean(1), limits);
    }
  });
  return samples;
}

/// The same samples where the camera's receivers look, one a pixel: a texel that no one sees has no
/// say, one that fills the picture has a large one. Pixels without a receiver weigh nothing.
image<lloyd_sample> samples_in_view(const frame& scene, const image<lloyd_sample>& samples) {
  image<lloyd_sample> seen(scene.view_width, scene.view_height);
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const receiver& r = scene.receivers[i];
    if (!has_receiver(r)) continue;
    const auto at = [](float u, int size, int last) {
      return std::clamp(texel_floor(static_cast<double>(u) * size - 0.5), 0, last);
    };
    seen.texels[i] = samples.at(at(r.u, scene.depth.width, samples.width - 1),
                                at(r.v, scene.depth.height, samples.height - 1));
  }
  return seen;
}

image<lloyd_sample> samples_of(const frame& scene, const configuration& how, int threads) {
  auto samples = samples_of_map(scene.depth, how.lloyd.weights, threads);
  if (how.splits != split_rule::lloyd_view) return samples;
  return samples_in_view(scene, samples);
}

}  // namespace

lloyd_field::lloyd_field(const frame& scene, const configuration& how, int threads)
    : lloyd_field(samples_of(scene, how, threads), how.lloyd) {}

lloyd_field::lloyd_field(const image<lloyd_sample>& samples, const lloyd_choices& choices)
    : exact_(samples.texels) {
  if (choices.sums != "exact") rounded_.emplace_back(samples, storage_named(choices.sums).format);
}

double lloyd_field::step(lloyd_relaxation& splits) const {
  return rounded_.empty() ? splits.step(exact_) : splits.step(rounded_.front());
}

int lloyd_field::relax(lloyd_relaxation& splits, int most_frames) const {
  return rounded_.empty() ? splits.relax(exact_, most_frames)
                          : splits.relax(rounded_.front(), most_frames);
}

double lloyd_field::cost(const std::vector<double>& interior) const {
  return lloyd_relaxation::cost(std::span<const double>(interior), exact_);
}

double lloyd_field::least_cost(std::size_t count) const {
  // Samples are grouped for the search; relaxing from what it finds undoes that.
  lloyd_options options;
  options.teleport = false;
  const auto best = optimal_splits(exact_, count);
  lloyd_relaxation polished(best, options);
  polished.relax(exact_, 1000);
  return std::min(cost(best), cost(polished.interior()));
}

lloyd_result relaxed_splits(const lloyd_field& field, const configuration& how) {
  const auto start = uniform_splits(how.layers);
  lloyd_relaxation splits({start.begin() + 1, start.end() - 1}, how.lloyd.steps);
  lloyd_result result;
  result.frames = field.relax(splits, how.lloyd.most_frames);
  result.interior = splits.interior();
  result.teleportations = splits.teleportations();
  result.lost = splits.lost();
  return result;
}

std::vector<std::string> notes_of(const lloyd_result& result, const configuration& how) {
  std::vector<std::string> notes;
  if (result.lost) {
    notes.push_back("Lloyd's sums in " + how.lloyd.sums +
                    " lost samples that had weight: their splits stayed where they were; "
                    "binary32 keeps them");
  }
  if (result.frames >= how.lloyd.most_frames) {
    notes.push_back("Lloyd's splits were taken after " + std::to_string(result.frames) +
                    " frames, before they came to rest");
  }
  return notes;
}

std::vector<lloyd_comparison> compare_with_optimum(const frame& scene, const configuration& how,
                                                   int threads) {
  const lloyd_field field(scene, how, threads);
  const double least = field.least_cost(static_cast<std::size_t>(how.layers - 1));
  std::vector<lloyd_comparison> list;
  const auto add = [&](const std::string& name, int splits_per_frame) {
    configuration variant = how;
    variant.lloyd.steps.splits_per_frame = splits_per_frame;
    lloyd_comparison c{name, relaxed_splits(field, variant), 0, least};
    c.cost = field.cost(c.result.interior);
    list.push_back(std::move(c));
  };
  const int own = how.lloyd.steps.splits_per_frame;
  if (own != 0 && own != 2) add(std::to_string(own) + " a frame", own);
  add("all a frame", 0);
  add("two a frame", 2);
  return list;
}

}  // namespace bitshade
