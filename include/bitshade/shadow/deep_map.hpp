// A footprint's exact visibility as a function of depth: what deep and opacity maps approximate.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace bitshade {

/// The share of a footprint that lies at or beyond t, for every t.
///
///   V(t) = sum of the weights with x >= t, over the sum of all weights
///
/// Shapes   any number of weighted depths, in any order; equal depths are merged.
/// Policy   sums and the one division are T's, farthest depths first.
/// Error    none for exact T.
/// Failure  an empty function is lit everywhere.
/// Source   [LokovicVeach00], with opaque surfaces.
template <class T>
class visibility_function {
 public:
  explicit visibility_function(std::vector<std::pair<T, T>> depths_and_weights) {
    auto& all = depths_and_weights;
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return b.first < a.first; });
    for (const auto& [depth, weight] : all) {
      if (!steps_.empty() && steps_.back().first == depth) {
        steps_.back().second = steps_.back().second + weight;
      } else {
        steps_.emplace_back(depth, steps_.empty() ? weight : steps_.back().second + weight);
      }
    }
  }

  /// Distinct depths: the steps that a deep map would have to store.
  std::size_t steps() const { return steps_.size(); }

  T operator()(const T& t) const {
    if (steps_.empty()) return static_cast<T>(1);
    // Steps fall in depth: the last one that t does not lie beyond.
    const auto past = std::partition_point(steps_.begin(), steps_.end(),
                                           [&](const auto& s) { return !(s.first < t); });
    return past == steps_.begin() ? static_cast<T>(0)
                                  : std::prev(past)->second / steps_.back().second;
  }

 private:
  std::vector<std::pair<T, T>> steps_;  ///< depth, falling, and the weight from there on
};

}  // namespace bitshade
