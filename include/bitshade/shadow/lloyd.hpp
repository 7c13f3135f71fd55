// Lloyd relaxation of the splits: clusters belong to the interior split points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/shadow/lloyd_samples.hpp"

namespace bitshade {

/// Where a split goes that teleports.
///
///   layer_mean     the mean of the samples between the two splits that have most weight between
///                  them: the source's words
///   layer_middle   the middle of that layer
///   costly_half    the mean of the costliest cluster's samples on the costlier side of its split
enum class teleport_target { layer_mean, layer_middle, costly_half };

/// Whose weights decide where a split teleports to.
///
///   all     every layer's
///   frame   only of layers beside a split that the frame sums anyway: no reduction is added
enum class teleport_scope { all, frame };

/// What must hold still for splits to be at rest, through one visit to each of them.
///
///   move   each split: it moves by no more than `rest`
///   cost   the cost: it changes by no more than the share `rest` of it
enum class rest_measure { move, cost };

/// The choices that the source leaves open, or makes and one may want to undo.
struct lloyd_options {
  int splits_per_frame = 0;  ///< 0: all; the source moves two a frame
  int latency = 0;           ///< frames until what was reduced is read back and used
  bool teleport = true;      ///< a split whose samples weigh nothing moves to the heaviest layer
  teleport_target target = teleport_target::layer_mean;
  double hysteresis = 0.01;  ///< a teleportation must lower the cost by this share of it
  teleport_scope scope = teleport_scope::all;
  rest_measure measure = rest_measure::move;
  double rest = split_grid;

  friend bool operator==(const lloyd_options&, const lloyd_options&) = default;
};

/// The splits while they relax. Equal inputs give equal splits.
///
/// A Field has between(low, high), whose result has `weight` and `mean()`, cost(low, high, split)
/// and empty(): lloyd_samples, or lloyd_pyramid with a device's own sums.
///
/// Source   [LauritzenMcCool08] section 5.
class lloyd_relaxation {
 public:
  explicit lloyd_relaxation(std::vector<double> interior, lloyd_options options = {})
      : splits_(std::move(interior)), options_(options) {
    std::sort(splits_.begin(), splits_.end());
  }

  const std::vector<double>& interior() const { return splits_; }
  /// How many teleportations there were.
  int teleportations() const { return teleportations_; }
  /// Whether a field said of a sum that its samples had weight and it lost all of it.
  bool lost() const { return lost_; }

  /// The cost of splits: each sample's weight times its squared distance to the nearest split.
  template <class Field>
  static double cost(std::span<const double> interior, const Field& field) {
    double sum = 0;
    for (std::size_t i = 0; i < interior.size(); ++i) {
      const auto [low, high] = cluster(interior, i);
      sum += field.cost(low, high, interior[i]);
    }
    return sum;
  }

  /// One frame: some splits, or all, move to the means of their clusters; a split whose samples
  /// weigh nothing may teleport. With a latency, what the frame computes is used later, and what
  /// was computed that many frames ago now. Returns the largest move.
  template <class Field>
  double step(const Field& field) {
    if (splits_.empty() || field.empty()) return 0;
    pending_.push_back(decide(field));
    if (pending_.size() <= static_cast<std::size_t>(options_.latency)) return 0;
    const decision now = std::move(pending_.front());
    pending_.pop_front();
    const std::vector<double> before = splits_;
    if (now.teleported) {
      splits_ = now.all;
      ++teleportations_;
      pending_.clear();  // what was decided for the splits as they were means nothing now
    } else {
      for (const auto& [i, split] : now.moves) splits_[i] = split;
      std::sort(splits_.begin(), splits_.end());
    }
    double largest = 0;
    for (std::size_t i = 0; i < splits_.size(); ++i) {
      largest = std::max(largest, std::fabs(splits_[i] - before[i]));
    }
    return largest;
  }

  /// Steps until the splits are at rest for as many frames as visit each split once and read it
  /// back. Returns the number of frames.
  template <class Field>
  int relax(const Field& field, int most_frames) {
    int still = 0;
    const int round = (options_.splits_per_frame == 0 || splits_.empty()
                           ? 1
                           : (static_cast<int>(splits_.size()) + options_.splits_per_frame - 1) /
                                 options_.splits_per_frame) +
                      options_.latency;
    const bool by_cost = options_.measure == rest_measure::cost;
    double before = by_cost ? cost(splits_, field) : 0;
    for (int frame = 1; frame <= most_frames; ++frame) {
      const double move = step(field);
      bool rests = move <= options_.rest;
      if (by_cost) {
        const double now = cost(splits_, field);
        rests = std::fabs(now - before) <= options_.rest * before;
        before = now;
      }
      still = rests ? still + 1 : 0;
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

  /// What a frame's sums say: new places of some splits, or all splits after a teleportation.
  struct decision {
    std::vector<std::pair<std::size_t, double>> moves;
    bool teleported = false;
    std::vector<double> all;
  };

  template <class Field>
  decision decide(const Field& field) {
    const std::size_t count =
        options_.splits_per_frame == 0
            ? splits_.size()
            : std::min(splits_.size(), static_cast<std::size_t>(options_.splits_per_frame));
    decision result;
    bool idle = false;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = (next_ + n) % splits_.size();
      const auto [low, high] = cluster(splits_, i);
      const auto sums = field.between(low, high);
      if constexpr (requires { sums.lost; }) lost_ = lost_ || sums.lost;
      if (sums.weight > 0) {
        result.moves.emplace_back(i, std::clamp(sums.mean(), 0.0, 1.0));
      } else {
        idle = true;
      }
    }
    next_ = (next_ + count) % splits_.size();
    if (idle && options_.teleport) {
      result.all = splits_;
      for (const auto& [i, split] : result.moves) result.all[i] = split;
      std::sort(result.all.begin(), result.all.end());
      std::vector<double> summed;
      for (const auto& [i, split] : result.moves) summed.push_back(split);
      result.teleported = teleport(result.all, summed, field);
    }
    return result;
  }

  /// Where the samples that n splits serve worst would have one more; below 0 if nowhere.
  template <class Field>
  double target(const std::vector<double>& splits, std::span<const double> summed,
                const Field& field) const {
    double most = 0, place = -1;
    const auto counts = [&](double split) {
      return options_.scope == teleport_scope::all ||
             std::find(summed.begin(), summed.end(), split) != summed.end();
    };
    if (options_.target == teleport_target::costly_half) {
      for (std::size_t i = 0; i < splits.size(); ++i) {
        if (!counts(splits[i])) continue;
        const auto [low, high] = cluster(splits, i);
        for (const auto& [from, to] : {range{low, splits[i]}, range{splits[i], high}}) {
          const double cost = field.cost(from, to, splits[i]);
          const auto sums = field.between(from, to);
          if (cost > most && sums.weight > 0) {
            most = cost;
            place = sums.mean();
          }
        }
      }
      return place;
    }
    double from = 0;
    for (std::size_t j = 0; j <= splits.size(); ++j) {
      const double to = j < splits.size() ? splits[j] : 2.0;
      if ((j > 0 && counts(from)) || (j < splits.size() && counts(to)) || splits.empty()) {
        const auto sums = field.between(from, to);
        if (static_cast<double>(sums.weight) > most) {
          most = static_cast<double>(sums.weight);
          place = options_.target == teleport_target::layer_mean ? sums.mean()
                                                                 : (from + std::min(to, 1.0)) / 2;
        }
      }
      from = to;
    }
    return place;
  }

  /// Drops one split without samples, merging two layers, and places it at the target instead,
  /// provided that the cost falls by the hysteresis: the cost bounds how often that can happen.
  template <class Field>
  bool teleport(std::vector<double>& splits, std::span<const double> summed,
                const Field& field) const {
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const auto [low, high] = cluster(splits, i);
      if (field.between(low, high).weight > 0) continue;
      std::vector<double> with = splits;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(i));
      const double place = target(with, summed, field);
      if (place < 0) return false;
      const double inside = std::min(place, 1.0);
      with.insert(std::upper_bound(with.begin(), with.end(), inside), inside);
      if (cost(with, field) < (1 - options_.hysteresis) * cost(splits, field)) {
        splits = std::move(with);
        return true;  // one a frame
      }
    }
    return false;
  }

  std::vector<double> splits_;
  lloyd_options options_;
  std::deque<decision> pending_;
  std::size_t next_ = 0;
  int teleportations_ = 0;
  bool lost_ = false;
};

}  // namespace bitshade
