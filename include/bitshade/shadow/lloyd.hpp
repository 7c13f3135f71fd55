// Lloyd relaxation of the splits: clusters belong to the interior split points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitshade/arithmetic/wide.hpp"
#include "bitshade/shadow/layers.hpp"

namespace bitshade {

/// What one texel of an unwarped VSM says about the splits.
struct lloyd_sample {
  double value = 0;   ///< mu + sigma: where the second occluder lies
  double weight = 0;  ///< sigma^2: how much it would bleed
};

/// Limits of a sample's weight: below `low` it is noise and weighs nothing, above `high` it weighs
/// no more than `high`, so that the farthest pairs of occluders do not decide alone.
struct weight_limits {
  double low = 4e-5;  ///< a little more than unorm16's own noise of 2.3e-5
  double high = 0.01;
};

/// The sample of filtered moments.
///
///   value = min(1, mu + sigma), weight = min(sigma^2, high), 0 under low
///
/// Failure  none: a negative variance counts as 0, mu + sigma past 1 is clamped.
/// Source   [LauritzenMcCool08] section 5; eq. 9 for one half's coverage.
inline lloyd_sample lloyd_sample_of(double m1, double m2, const weight_limits& limits = {}) {
  const double variance = std::max(0.0, m2 - m1 * m1);
  return {std::clamp(m1 + std::sqrt(variance), 0.0, 1.0),
          variance < limits.low ? 0.0 : std::min(variance, limits.high)};
}

/// All samples of a map, sorted by value, with exact prefix sums: values in steps of 2^-24, weights
/// in steps of 2^-32. A cluster's mean and cost are then differences, whatever its size.
class lloyd_samples {
 public:
  explicit lloyd_samples(std::span<const lloyd_sample> samples) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sorted;
    for (const auto& s : samples) {
      const auto weight = static_cast<std::uint64_t>(s.weight * 0x1p32 + 0.5);
      if (weight > 0) sorted.emplace_back(grid(s.value), weight);
    }
    std::sort(sorted.begin(), sorted.end());
    sums_.push_back({});
    for (const auto& [value, weight] : sorted) {
      const uint128 first = static_cast<uint128>(value) * weight;
      sums next = sums_.back();
      next.weight += weight;
      next.first += first;
      next.second += first * value;
      if (!values_.empty() && values_.back() == value) {
        sums_.back() = next;
      } else {
        values_.push_back(value);
        sums_.push_back(next);
      }
    }
  }

  /// Sums over a range of samples: weights, weight * value, weight * value^2.
  struct sums {
    std::uint64_t weight = 0;
    uint128 first = 0, second = 0;

    /// The weighted mean on the split grid, halves up; weight > 0.
    double mean() const {
      return static_cast<double>((2 * first + weight) / (2 * static_cast<uint128>(weight))) *
             split_grid;
    }
  };

  bool empty() const { return values_.empty(); }
  std::size_t distinct() const { return values_.size(); }

  /// Samples with low <= value < high.
  sums between(double low, double high) const {
    const sums& a = sums_[below(low)];
    const sums& b = sums_[below(high)];
    return {b.weight - a.weight, b.first - a.first, b.second - a.second};
  }
  sums all() const { return sums_.back(); }

  /// The sum of weight * (value - split)^2 over the samples with low <= value < high, in depth^2.
  double cost(double low, double high, double split) const {
    const sums s = between(low, high);
    const uint128 c = grid(split);
    // second - 2 c first + c^2 weight >= 0: under 2^24 samples of 32 bits, it fits 128 bits.
    const uint128 cost = s.second + c * c * s.weight - 2 * c * s.first;
    return static_cast<double>(cost) * 0x1p-80;
  }

 private:
  static std::uint64_t grid(double x) {
    return static_cast<std::uint64_t>(std::clamp(x, 0.0, 2.0) * 0x1p24 + 0.5);
  }
  /// How many distinct values lie below x.
  std::size_t below(double x) const {
    // A midpoint of two grid values may lie between grid values: compare at half steps.
    const auto at = std::lower_bound(
        values_.begin(), values_.end(), x * 0x1p24,
        [](std::uint64_t value, double limit) { return static_cast<double>(value) < limit; });
    return static_cast<std::size_t>(at - values_.begin());
  }

  std::vector<std::uint64_t> values_;  ///< distinct, rising
  std::vector<sums> sums_;             ///< of the first i distinct values
};

/// The choices that the source leaves open, or makes and one may want to undo.
struct lloyd_options {
  int splits_per_frame = 0;  ///< 0: all; the source moves two a frame
  bool teleport = true;
  double hysteresis = 0.01;  ///< a teleportation must lower the cost by this share of it
};

/// The splits while they relax. Equal inputs give equal splits.
///
/// Source   [LauritzenMcCool08] section 5.
class lloyd_relaxation {
 public:
  explicit lloyd_relaxation(std::vector<double> interior, lloyd_options options = {})
      : splits_(std::move(interior)), options_(options) {
    std::sort(splits_.begin(), splits_.end());
  }

  const std::vector<double>& interior() const { return splits_; }

  /// The cost of splits: each sample's weight times its squared distance to the nearest split.
  static double cost(std::span<const double> interior, const lloyd_samples& samples) {
    double sum = 0;
    for (std::size_t i = 0; i < interior.size(); ++i) {
      const auto [low, high] = cluster(interior, i);
      sum += samples.cost(low, high, interior[i]);
    }
    return sum;
  }

  /// One frame: some splits, or all, move to the means of their clusters; a split whose samples
  /// weigh nothing may teleport. Returns the largest move.
  double step(const lloyd_samples& samples) {
    if (splits_.empty() || samples.empty()) return 0;
    const std::size_t count =
        options_.splits_per_frame == 0
            ? splits_.size()
            : std::min(splits_.size(), static_cast<std::size_t>(options_.splits_per_frame));
    std::vector<double> moved = splits_;
    bool idle = false;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = (next_ + n) % splits_.size();
      const auto [low, high] = cluster(splits_, i);
      const auto sums = samples.between(low, high);
      if (sums.weight > 0) {
        moved[i] = sums.mean();
      } else {
        idle = true;
      }
    }
    next_ = (next_ + count) % splits_.size();
    std::sort(moved.begin(), moved.end());
    if (idle && options_.teleport) teleport(moved, samples);
    double largest = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      largest = std::max(largest, std::fabs(moved[i] - splits_[i]));
    }
    splits_ = std::move(moved);
    return largest;
  }

  /// Steps until no split moves by more than `rest` in as many frames as visit each split once.
  /// Returns the number of frames.
  int relax(const lloyd_samples& samples, int most_frames, double rest = split_grid) {
    int still = 0;
    const int round = options_.splits_per_frame == 0 || splits_.empty()
                          ? 1
                          : (static_cast<int>(splits_.size()) + options_.splits_per_frame - 1) /
                                options_.splits_per_frame;
    for (int frame = 1; frame <= most_frames; ++frame) {
      still = step(samples) <= rest ? still + 1 : 0;
      if (still >= round) return frame;
    }
    return most_frames;
  }

 private:
  struct range {
    double low, high;
  };
  /// The samples that are nearest to split i: between the midpoints beside it.
  static range cluster(std::span<const double> splits, std::size_t i) {
    return {i == 0 ? 0.0 : (splits[i - 1] + splits[i]) / 2,
            i + 1 == splits.size() ? 2.0 : (splits[i] + splits[i + 1]) / 2};
  }

  /// Drops one split without samples and splits the heaviest layer at the mean of its samples,
  /// provided that the cost falls by the hysteresis: the cost bounds how often that can happen.
  void teleport(std::vector<double>& splits, const lloyd_samples& samples) const {
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const auto [low, high] = cluster(splits, i);
      if (samples.between(low, high).weight > 0) continue;
      std::vector<double> without = splits;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      double from = 0, best = 0;
      std::uint64_t heaviest = 0;
      for (std::size_t j = 0; j <= without.size(); ++j) {
        const double to = j < without.size() ? without[j] : 2.0;
        const auto sums = samples.between(from, to);
        if (sums.weight > heaviest) {
          heaviest = sums.weight;
          best = sums.mean();
        }
        from = to;
      }
      if (heaviest == 0) return;
      std::vector<double> with = without;
      with.insert(std::upper_bound(with.begin(), with.end(), best), best);
      if (cost(with, samples) < (1 - options_.hysteresis) * cost(splits, samples)) {
        splits = std::move(with);
        return;  // one a frame
      }
    }
  }

  std::vector<double> splits_;
  lloyd_options options_;
  std::size_t next_ = 0;
};

}  // namespace bitshade
