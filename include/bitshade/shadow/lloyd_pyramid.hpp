// Lloyd's sums as a device takes them: weighted values, averaged down a mip pyramid in a format.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/lloyd_samples.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// Samples in their places, whose cluster sums are reduced level by level in a format.
///
/// Every level holds w, w v and w v^2 of one cluster, each the mean of 2x2 (an odd size's last row
/// or column joins the one before it, with its own weight): at the top stands the cluster's mean
/// over the whole map. Each mean is rounded to the format, as a render target rounds it.
///
/// Policy   sums in binary64, so that nothing but the store rounds.
/// Failure  small weights underflow in 16 bits: `lost` says that a cluster with samples came out
///          without weight; binary32 is the cure.
class lloyd_pyramid {
 public:
  lloyd_pyramid(image<lloyd_sample> samples, const encoding& store)
      : samples_(std::move(samples)), store_(store) {}

  struct sums {
    double weight = 0, first = 0, second = 0;  ///< means over the map
    bool lost = false;

    double mean() const { return on_split_grid(std::clamp(first / weight, 0.0, 1.0)); }
  };

  bool empty() const { return samples_.texels.empty(); }

  sums between(double low, double high) const {
    image<double> level(samples_.width, samples_.height, 3);
    bool any = false;
    for (std::size_t i = 0; i < samples_.texels.size(); ++i) {
      const auto& s = samples_.texels[i];
      if (!(s.value >= low && s.value < high)) continue;
      any = any || s.weight > 0;
      level.texels[3 * i] = kept(s.weight);
      level.texels[3 * i + 1] = kept(s.weight * s.value);
      level.texels[3 * i + 2] = kept(s.weight * s.value * s.value);
    }
    while (level.width > 1 || level.height > 1) level = halved(level);
    const sums s{level.texels[0], level.texels[1], level.texels[2], false};
    return {s.weight, s.first, s.second, any && s.weight == 0};
  }

  /// As lloyd_samples::cost, but as a mean over the map, and never below 0.
  double cost(double low, double high, double split) const {
    const sums s = between(low, high);
    return std::max(0.0, s.second - 2 * split * s.first + split * split * s.weight);
  }

 private:
  double kept(double x) const { return round_to(store_, x); }

  image<double> halved(const image<double>& from) const {
    image<double> to(std::max(1, from.width / 2), std::max(1, from.height / 2), 3);
    const auto source = [](int i, int size, int of) {  // [first, last) of destination texel i
      const int first = size == 1 ? 0 : 2 * i;
      return std::pair{first, i + 1 == of ? size : first + 2};
    };
    for (int y = 0; y < to.height; ++y) {
      const auto [top, bottom] = source(y, from.height, to.height);
      for (int x = 0; x < to.width; ++x) {
        const auto [left, right] = source(x, from.width, to.width);
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int j = top; j < bottom; ++j) {
            for (int i = left; i < right; ++i) sum += from.at(i, j, c);
          }
          to.at(x, y, c) = kept(sum / ((bottom - top) * (right - left)));
        }
      }
    }
    return to;
  }

  image<lloyd_sample> samples_;
  encoding store_;
};

}  // namespace bitshade
