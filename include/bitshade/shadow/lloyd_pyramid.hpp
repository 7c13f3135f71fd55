// Lloyd's sums as a device takes them: weighted values, averaged down a mip pyramid in a format.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/lloyd_samples.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// Samples in their places, whose cluster sums are reduced level by level in a format.
///
/// Every level holds w, w v and w v^2 of one cluster, each the mean of 2x2; an odd size's last row
/// or column joins the one before it. Texels count by how many samples they stand for, so that at
/// the top stands the cluster's mean over the whole map, whatever its size. Each mean is rounded to
/// the format, as a render target rounds it.
///
/// Policy   sums in binary64, so that nothing but the store rounds; counts are exact.
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
    level_of_means level{{samples_.width, samples_.height, 3},
                         std::vector<double>(static_cast<std::size_t>(samples_.width), 1),
                         std::vector<double>(static_cast<std::size_t>(samples_.height), 1)};
    auto& means = level.means.texels;
    bool any = false;
    for (std::size_t i = 0; i < samples_.texels.size(); ++i) {
      const auto& s = samples_.texels[i];
      if (!(s.value >= low && s.value < high)) continue;
      any = any || s.weight > 0;
      means[3 * i] = kept(s.weight);
      means[3 * i + 1] = kept(s.weight * s.value);
      means[3 * i + 2] = kept(s.weight * s.value * s.value);
    }
    while (level.means.width > 1 || level.means.height > 1) level = halved(level);
    const sums s{means[0], means[1], means[2], false};
    return {s.weight, s.first, s.second, any && s.weight == 0};
  }

  /// As lloyd_samples::cost, but as a mean over the map, and never below 0.
  double cost(double low, double high, double split) const {
    const sums s = between(low, high);
    return std::max(0.0, s.second - 2 * split * s.first + split * split * s.weight);
  }

 private:
  double kept(double x) const { return round_to(store_, x); }

  /// Means, and how many samples each column and row of them stands for.
  struct level_of_means {
    image<double> means;
    std::vector<double> columns, rows;
  };

  level_of_means halved(const level_of_means& from) const {
    struct range {
      std::size_t first, last;
    };
    const auto source = [](std::size_t i, std::size_t size, std::size_t of) {
      const std::size_t first = size == 1 ? 0 : 2 * i;
      return range{first, i + 1 == of ? size : first + 2};
    };
    const auto counts = [&](const std::vector<double>& in) {
      std::vector<double> out(std::max<std::size_t>(1, in.size() / 2));
      for (std::size_t i = 0; i < out.size(); ++i) {
        const auto [first, last] = source(i, in.size(), out.size());
        for (std::size_t k = first; k < last; ++k) out[i] += in[k];
      }
      return out;
    };
    level_of_means to{{}, counts(from.columns), counts(from.rows)};
    const std::size_t width = to.columns.size(), height = to.rows.size();
    to.means = image<double>(static_cast<int>(width), static_cast<int>(height), 3);
    for (std::size_t y = 0; y < height; ++y) {
      const auto [top, bottom] = source(y, from.rows.size(), height);
      for (std::size_t x = 0; x < width; ++x) {
        const auto [left, right] = source(x, from.columns.size(), width);
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::size_t j = top; j < bottom; ++j) {
            for (std::size_t i = left; i < right; ++i) {
              sum += from.columns[i] * from.rows[j] *
                     from.means.texels[(j * from.columns.size() + i) * 3 + c];
            }
          }
          to.means.texels[(y * width + x) * 3 + c] = kept(sum / (to.columns[x] * to.rows[y]));
        }
      }
    }
    return to;
  }

  image<lloyd_sample> samples_;
  encoding store_;
};

}  // namespace bitshade
