#include "run/splits.hpp"

#include "bitshade/formats/encoding.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/moments.hpp"
#include "run/parallel.hpp"
#include "run/storage.hpp"

namespace bitshade {

namespace {

/// The samples that the source takes: a 16-bit VSM of the whole depth range, read between texels.
/// The storage is the same for every format of a study, so that the splits are, too.
std::vector<lloyd_sample> samples_of(const image<float>& depth, int threads) {
  const auto storage = storage_named("unorm16");
  image<float> moments(depth.width, depth.height, 2);
  for_rows(threads, depth.height, [&](int y) {
    warp_row<float>(depth.row(y), interval{0, 1}, moments.row(y), 2);
    square_row<float>(moments.row(y), 2);
    round_row(storage, moments.row(y));
  });
  const int columns = std::max(1, depth.width - 1), rows = std::max(1, depth.height - 1);
  std::vector<lloyd_sample> samples(static_cast<std::size_t>(columns) *
                                    static_cast<std::size_t>(rows));
  for_rows(threads, rows, [&](int y) {
    const int below = std::min(y + 1, depth.height - 1);
    for (int x = 0; x < columns; ++x) {
      const int right = std::min(x + 1, depth.width - 1);
      const auto mean = [&](int c) {
        return (static_cast<double>(moments.at(x, y, c)) + moments.at(right, y, c) +
                moments.at(x, below, c) + moments.at(right, below, c)) /
               4;
      };
      samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
              static_cast<std::size_t>(x)] = lloyd_sample_of(mean(0), mean(1));
    }
  });
  return samples;
}

/// Frames after which a scene that stands still is taken as it is.
constexpr int most_frames = 1000;

}  // namespace

std::vector<double> splits_of(const frame& scene, const configuration& how, int threads) {
  if (how.method != technique::lvsm || how.layers == 1) return {0, 1};
  if (how.splits == split_rule::uniform) return uniform_splits(how.layers);
  if (how.splits == split_rule::manual) return splits_from(how.manual_splits);
  const lloyd_samples samples(samples_of(scene.depth, threads));
  const auto start = uniform_splits(how.layers);
  lloyd_relaxation relaxation({start.begin() + 1, start.end() - 1});
  relaxation.relax(samples, most_frames);
  return splits_from(relaxation.interior());
}

}  // namespace bitshade
