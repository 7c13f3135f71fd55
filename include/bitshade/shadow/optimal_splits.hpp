// The best splits that there are, by dynamic programming: what Lloyd's are compared with.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "bitshade/shadow/lloyd_samples.hpp"

namespace bitshade {

/// Splits of least cost, the sum over samples of weight * (value - nearest split)^2.
///
/// Sorted values fall into consecutive clusters, each with its mean as its split; the best first j
/// clusters of the first n groups extend to j + 1. Samples are grouped into at most `groups`
/// intervals of depth first, of equal width where there are more distinct values.
///
/// Shapes   `count` splits asked for; fewer come back where there are fewer groups with weight.
/// Error    exact over the groups; grouping by width g moves no split by more than g.
/// Policy   time count * groups^2.
inline std::vector<double> optimal_splits(const lloyd_samples& samples, std::size_t count,
                                          std::size_t groups = 1024) {
  std::vector<double> starts = samples.values();
  if (starts.size() > groups) {
    starts.clear();
    for (std::size_t i = 0; i < groups; ++i) {
      const double low = static_cast<double>(i) / static_cast<double>(groups);
      const double high =
          i + 1 == groups ? 2.0 : static_cast<double>(i + 1) / static_cast<double>(groups);
      if (samples.between(low, high).weight > 0) starts.push_back(low);
    }
  }
  const std::size_t n = starts.size();
  count = std::min(count, n);
  if (count == 0) return {};
  starts.push_back(2.0);

  constexpr double endless = std::numeric_limits<double>::infinity();
  std::vector<double> best(n + 1, endless);  // of the first i groups in j clusters
  std::vector<std::vector<std::size_t>> from(count + 1, std::vector<std::size_t>(n + 1, 0));
  best[0] = 0;
  for (std::size_t j = 1; j <= count; ++j) {
    std::vector<double> next(n + 1, endless);
    for (std::size_t i = j; i <= n; ++i) {
      for (std::size_t k = j - 1; k < i; ++k) {
        if (best[k] == endless) continue;
        const double mean = samples.between(starts[k], starts[i]).mean();
        const double cost = best[k] + samples.cost(starts[k], starts[i], mean);
        if (cost < next[i]) {
          next[i] = cost;
          from[j][i] = k;
        }
      }
    }
    best = std::move(next);
  }
  std::vector<double> splits;
  for (std::size_t j = count, i = n; j > 0; --j) {
    const std::size_t k = from[j][i];
    splits.push_back(samples.between(starts[k], starts[i]).mean());
    i = k;
  }
  std::reverse(splits.begin(), splits.end());
  return splits;
}

}  // namespace bitshade
