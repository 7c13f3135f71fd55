// What a VSM says about where the splits should lie, summed exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/formats/wide_integer.hpp"
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

  friend bool operator==(const weight_limits&, const weight_limits&) = default;
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

  /// The distinct values, rising, in depth.
  std::vector<double> values() const {
    std::vector<double> result;
    for (const auto v : values_) result.push_back(static_cast<double>(v) * split_grid);
    return result;
  }

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

}  // namespace bitshade
