// Exact visibility functions: the light that passes through a filter region at every depth.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace bitshade {

/// A visibility function as steps: from `depth` on (exclusive), `light` is left.
template <class T>
struct visibility_step {
  T depth;
  T light;
};

/// The light left at every depth: 1 in front of the first step, non-increasing.
///
/// Shapes   steps of rising depths and falling light.
/// Source   [LokovicVeach00] section 2; opaque texels make steps alone.
template <class T>
class visibility_function {
 public:
  visibility_function() = default;
  explicit visibility_function(std::vector<visibility_step<T>> steps) : steps_(std::move(steps)) {}

  /// P(x >= t): a receiver at a texel's own depth is lit by it.
  T light(const T& t) const {
    const auto after =
        std::lower_bound(steps_.begin(), steps_.end(), t,
                         [](const visibility_step<T>& s, const T& d) { return s.depth < d; });
    return after == steps_.begin() ? static_cast<T>(1) : std::prev(after)->light;
  }
  std::span<const visibility_step<T>> steps() const { return steps_; }

 private:
  std::vector<visibility_step<T>> steps_;
};

/// One texel under the filter.
template <class T>
struct weighted_depth {
  T depth;
  T weight;
};

/// The function of a filter region: each texel takes its weight away at its depth.
///
/// Shapes   any order of texels; weights that sum to 1.
/// Policy   sums are T's, from the furthest texel on, so that light left far behind is not what
///          remains of cancelled numbers.
/// Error    none for exact T: percentage-closer filtering at every depth at once.
/// Source   [LokovicVeach00] section 3.1.
template <class T>
visibility_function<T> visibility_of(std::vector<weighted_depth<T>> texels) {
  std::sort(texels.begin(), texels.end(),
            [](const auto& a, const auto& b) { return b.depth < a.depth; });
  std::vector<visibility_step<T>> steps;
  T light = static_cast<T>(0);
  for (std::size_t i = 0; i < texels.size();) {
    const T depth = texels[i].depth;
    steps.push_back({depth, light});
    for (; i < texels.size() && texels[i].depth == depth; ++i) light = light + texels[i].weight;
  }
  std::reverse(steps.begin(), steps.end());
  return visibility_function<T>(std::move(steps));
}

/// The function at the middles of `slices` equal intervals of depth, constant over each.
///
/// Error    none at the middles; elsewhere, by the light that the function loses within a slice.
/// Source   [KimNeumann01].
template <class T>
std::vector<T> opacity_map(const visibility_function<T>& exact, int slices) {
  std::vector<T> light;
  for (int i = 0; i < slices; ++i) {
    light.push_back(
        exact.light((static_cast<T>(i) + static_cast<T>(0.5)) / static_cast<T>(slices)));
  }
  return light;
}

/// What an opacity map of that many slices says at t.
template <class T>
T opacity_lookup(std::span<const T> light, const T& t) {
  const auto count = static_cast<double>(light.size());
  const double at = static_cast<double>(t) * count;
  const auto last = static_cast<std::ptrdiff_t>(light.size()) - 1;
  const auto slice = at > 0 ? static_cast<std::ptrdiff_t>(std::min(at, count)) : 0;
  return light[static_cast<std::size_t>(std::min(slice, last))];
}

/// Fewer steps, none of them off by more than `tolerance`.
///
/// Greedy from the light's side: a step is kept as long as one level serves all that follow it.
///
/// Shapes   tolerance >= 0; 0 merges steps of equal light alone.
/// Error    |compressed - exact| <= tolerance at every depth, for exact T.
/// Source   [LokovicVeach00] section 3.2 with constant instead of linear pieces.
template <class T>
visibility_function<T> compressed(const visibility_function<T>& exact, const T& tolerance) {
  std::vector<visibility_step<T>> kept;
  const auto steps = exact.steps();
  T level = static_cast<T>(1);
  for (std::size_t i = 0; i < steps.size();) {
    if (!(tolerance < level - steps[i].light)) {  // the level before still serves
      ++i;
      continue;
    }
    const T from = steps[i].light;
    level = from - tolerance;
    if (level < static_cast<T>(0)) level = static_cast<T>(0);
    kept.push_back({steps[i].depth, level});
    ++i;
  }
  return visibility_function<T>(std::move(kept));
}

}  // namespace bitshade
