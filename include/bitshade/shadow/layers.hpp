// Layers of an LVSM: which interval of depth each covers, and which one a receiver looks up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace bitshade {

/// Splits and overlaps are multiples of this, so that exact kernels keep a fixed width and binary32
/// holds every layer's bounds and width without rounding.
inline constexpr double split_grid = 0x1p-24;

/// The nearest multiple of split_grid, halves up; x in [0, 1].
constexpr double on_split_grid(double x) {
  return static_cast<double>(static_cast<std::int64_t>(x / split_grid + 0.5)) * split_grid;
}

/// The depths that a layer resolves: [near, far], both on the split grid, far > near.
struct interval {
  double near = 0;
  double far = 1;

  friend constexpr bool operator==(const interval&, const interval&) = default;
};

/// How a layer takes the depths beyond its ends.
///
///   clamped     as 0 and 1, (6): an occluder in front of the layer is at its near end
///   unclamped   where the line leads, (13) by the letter: below 0 and past 1
enum class layer_warp { clamped, unclamped };

/// Splits s_0 = 0 .. s_N = 1 at equal distances.
///
/// Failure  std::invalid_argument for no layer at all.
/// Source   [LauritzenMcCool08] section 4.
inline std::vector<double> uniform_splits(int layers) {
  if (layers < 1) throw std::invalid_argument("an LVSM needs at least one layer");
  std::vector<double> splits;
  for (int i = 0; i <= layers; ++i) {
    splits.push_back(on_split_grid(static_cast<double>(i) / layers));
  }
  return splits;
}

/// Splits s_0 = 0 .. s_N = 1 from the interior ones: onto the grid, in order, kept at least
/// `narrowest` apart from each other, from 0 and from 1. Coincident splits are merged.
///
/// Shapes   at most interior.size() + 2 splits, strictly rising.
/// Units    depth in [0,1]; narrowest on the split grid, at least one step of it.
inline std::vector<double> splits_from(std::span<const double> interior,
                                       double narrowest = split_grid) {
  std::vector<double> sorted(interior.begin(), interior.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> splits{0};
  for (const double s : sorted) {
    const double placed = on_split_grid(std::clamp(s, 0.0, 1.0));
    if (placed - splits.back() >= narrowest && 1 - placed >= narrowest) splits.push_back(placed);
  }
  splits.push_back(1);
  return splits;
}

/// The layers' intervals, widened by the overlap on every interior side, within [0, 1].
///
///   L_1 = [s_0, s_1 + delta], L_i = [s_(i-1) - delta, s_i + delta], L_N = [s_(N-1) - delta, s_N]
///
/// Shapes   N + 1 splits in, N intervals out.
/// Source   [LauritzenMcCool08] section 4.3.
inline std::vector<interval> layer_intervals(std::span<const double> splits, double overlap) {
  const double delta = on_split_grid(overlap);
  std::vector<interval> layers;
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    const bool first = i == 0, last = i + 2 == splits.size();
    layers.push_back({first ? splits[i] : std::max(0.0, splits[i] - delta),
                      last ? splits[i + 1] : std::min(1.0, splits[i + 1] + delta)});
  }
  return layers;
}

/// The layer of a receiver: i with t in (s_i, s_(i+1)]; a tie goes to the nearer layer.
///
/// Shapes   N + 1 rising splits; t may lie outside [0, 1]: the first or last layer.
/// Policy   comparisons in T, to which the grid's splits convert without rounding.
template <class T>
int layer_of(const T& t, std::span<const double> splits) {
  const auto last = static_cast<int>(splits.size()) - 2;
  int i = 0;
  while (i < last && static_cast<T>(splits[static_cast<std::size_t>(i) + 1]) < t) ++i;
  return i;
}

/// The layer of a receiver among N uniform ones, computed directly: ceil(t N) - 1, within 0 .. N-1.
///
/// Error    equals layer_of(t, uniform_splits(N)) where N is a power of two; for other N, splits
///          rounded to the grid may differ from i/N, and so may the layer of a t between them.
template <class T>
int uniform_layer_of(const T& t, int layers) {
  const auto scaled = static_cast<double>(t) * layers;
  if (!(scaled > 1)) return 0;
  if (scaled >= layers) return layers - 1;
  const int whole = static_cast<int>(scaled);
  return whole < scaled ? whole : whole - 1;
}

/// Two adjacent layers that a receiver blends: split `near + 1` lies between them.
struct layer_pair {
  int near = 0, far = 0;  ///< equal where the receiver looks up its own layer alone
};

/// The layers of a receiver whose transition is blended: those beside a split that lies closer
/// than delta.
///
/// Shapes   where two overlaps meet the nearer split counts, and of two at the same distance the
///          one nearer to the light.
/// Policy   comparisons in T.
/// Source   [LauritzenMcCool08] section 4.3.
template <class T>
layer_pair blended_layers(const T& t, std::span<const double> splits, double overlap) {
  const int own = layer_of(t, splits);
  const T delta = static_cast<T>(on_split_grid(overlap));
  const auto split = [&](int i) { return static_cast<T>(splits[static_cast<std::size_t>(i)]); };
  const auto last = static_cast<int>(splits.size()) - 2;
  const bool below = own > 0 && t - split(own) < delta;
  const bool above = own < last && split(own + 1) - t < delta;
  if (!below && !above) return {own, own};
  const bool use_below = below && (!above || t - split(own) <= split(own + 1) - t);
  return use_below ? layer_pair{own - 1, own} : layer_pair{own, own + 1};
}

/// The share of the further layer across the overlap of a split: 0 at s - delta, 1 at s + delta.
///
/// Policy   every operation is T's; s - delta and 2 delta are exact, so the share lies in [0, 1].
template <class T>
T transition_share(const T& t, double split, double overlap) {
  const double delta = on_split_grid(overlap);
  return (t - static_cast<T>(split - delta)) / static_cast<T>(delta + delta);
}

}  // namespace bitshade
