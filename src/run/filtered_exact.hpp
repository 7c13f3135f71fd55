// Techniques that filter functions of a depth, without rounding: certified enclosures of what they
// store, filtered and shaded until each receiver's binary64 is decided.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/mip.hpp"
#include "run/engines.hpp"
#include "run/exact_lookup.hpp"
#include "run/exact_slope.hpp"
#include "run/parallel.hpp"

namespace bitshade {

/// Limbs of the first attempt, over the whole map, and of the further ones, each over the footprint
/// of a receiver that the one before left undecided. The last holds the products of four moments of
/// common depths without a rounding, so that singular matrices are seen to be.
inline constexpr std::size_t first_limbs = 3;
inline constexpr std::size_t second_limbs = 8;
inline constexpr std::size_t last_limbs = 28;

/// Technique: a Map as in texel_technique.hpp. One with
///
///   std::optional<double> flat_light(double x, double t) const;
///
/// decides itself where all texels of a footprint are x: what enclosures of e^x cannot. One with
///
///   bool slope_term;  template <class T> void add_slope(const T& slope, std::span<T> out) const;
///
/// adds a texel's slope_variance() to what it stores.
template <class Technique>
class filtered_exact {
 public:
  filtered_exact(run_context& run, const Technique& technique)
      : run_(run),
        technique_(technique),
        blur_(blur_of(run.how)),
        maps_(depth_maps(run.scene, run.look.samples)) {}

  /// Planes of one channel each, so that a pass needs one plane beside them.
  void generate() {
    using number = ball<first_limbs>;
    const stopwatch watch(run_.result.map_seconds);
    const image<float>& depth = run_.scene.depth;
    const std::size_t channels = technique_.channels();
    chains_.assign(channels, {});
    for (auto& chain : chains_) chain.emplace_back(depth.width, depth.height);
    for_rows(run_.threads, depth.height, [&](int y) {
      std::vector<number> texel(channels), sum(channels);
      for (int x = 0; x < depth.width; ++x) {
        const auto same = [&](const image<float>* map) {
          return map->at(x, y) == map->at(x - 1, y);
        };
        if (x == 0 || slope_term() || !std::all_of(maps_.begin(), maps_.end(), same)) {
          texel_at<first_limbs>(x, y, texel, sum);
        }
        for (std::size_t c = 0; c < channels; ++c) chains_[c].front().at(x, y) = sum[c];
      }
    });
    image<number> across(depth.width, depth.height);
    for (auto& chain : chains_) {
      if (blur_.weights.size() > 1) {
        for_rows(run_.threads, depth.height, [&](int y) {
          blur_row_x<number>(chain.front(), blur_, map_address, y, across.row(y));
        });
        for_rows(run_.threads, depth.height, [&](int y) {
          blur_row_y<number>(across, blur_, map_address, y, chain.front().row(y));
        });
      }
      if (!run_.look.mips) continue;
      const int levels = mip_levels(depth.width, depth.height);
      for (int level = 1; level < levels; ++level) {
        image<number> next(mip_size(depth.width, level), mip_size(depth.height, level));
        const image<number>& from = chain.back();
        for_rows(run_.threads, next.height,
                 [&](int y) { downsample_row<number>(from, map_mips, y, next.row(y)); });
        chain.push_back(std::move(next));
      }
    }
  }

  void shade() {
    const stopwatch watch(run_.result.shade_seconds);
    const auto& receivers = run_.scene.receivers;
    auto& visibility = run_.result.visibility;
    visibility.assign(receivers.size(), std::numeric_limits<double>::quiet_NaN());
    std::atomic<std::size_t> undecided = 0;
    for_ranges(run_.threads, receivers.size(), 64, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (!has_receiver(receivers[i])) continue;
        const auto [value, certain] = light_of(receivers[i]);
        visibility[i] = value;
        if (!certain) ++undecided;
      }
    });
    if (undecided > 0) {
      run_.result.notes.push_back(std::to_string(undecided) +
                                  " receivers lie too close to a rounding's boundary to be "
                                  "decided: their enclosures' midpoints are given");
    }
  }

 private:
  struct certified_light {
    double value;
    bool certain;
  };

  certified_light light_of(const receiver& r) const {
    const image<float>& depth = run_.scene.depth;
    std::vector<exact_lookup> lookups;
    each_lookup(r, run_.how.filtered.lookups, depth.width, depth.height,
                [&](const receiver& there) { lookups.push_back(exact_lookup_of(run_, there)); });
    const auto planes = [&](const exact_texel& at, std::span<ball<first_limbs>> out) {
      for (std::size_t c = 0; c < out.size(); ++c) {
        out[c] = chains_[c][static_cast<std::size_t>(at.level)].at(at.x, at.y);
      }
    };
    const auto from_planes = [&](const exact_lookup& at) {
      return light<first_limbs>(at, r.t, planes);
    };
    if (const auto p = decided(mean_light<first_limbs>(lookups, from_planes))) return {*p, true};
    const auto second = [&](const exact_lookup& at) {
      return flat_or_refined<second_limbs>(at, r.t);
    };
    if (const auto p = decided(mean_light<second_limbs>(lookups, second))) return {*p, true};
    const auto last = [&](const exact_lookup& at) { return flat_or_refined<last_limbs>(at, r.t); };
    const auto best = mean_light<last_limbs>(lookups, last);
    const auto p = decided(best);
    return {p ? *p : best.nearest(), p.has_value()};
  }

  template <std::size_t Limbs, class Light>
  static ball<Limbs> mean_light(const std::vector<exact_lookup>& lookups, Light light) {
    ball<Limbs> sum = light(lookups.front());
    if (lookups.size() == 1) return sum;
    for (std::size_t i = 1; i < lookups.size(); ++i) sum += light(lookups[i]);
    return sum / ball<Limbs>(static_cast<int>(lookups.size()));
  }
  template <std::size_t Limbs>
  ball<Limbs> flat_or_refined(const exact_lookup& lookup, float t) const {
    if (const auto p = flat_light(lookup, t)) return ball<Limbs>(*p);
    return refined<Limbs>(lookup, t);
  }

  /// What texel (x, y) stores, the mean of its samples; `one` is room for a sample.
  template <std::size_t Limbs>
  void texel_at(int x, int y, std::vector<ball<Limbs>>& one, std::vector<ball<Limbs>>& sum) const {
    using number = ball<Limbs>;
    const number share(1.0 / static_cast<double>(maps_.size()));
    for (std::size_t s = 0; s < maps_.size(); ++s) {
      technique_.template texel<number>(number(clamp_depth(maps_[s]->at(x, y))), one);
      if constexpr (knows_slopes) {
        if (technique_.slope_term) {
          technique_.add_slope(exact_slope_at<number>(*maps_[s], x, y), std::span(one));
        }
      }
      for (std::size_t c = 0; c < sum.size(); ++c) {
        sum[c] = s == 0 ? one[c] * share : sum[c] + one[c] * share;
      }
    }
  }

  static constexpr bool knows_slopes = requires(const Technique& t) { t.slope_term; };
  bool slope_term() const {
    if constexpr (knows_slopes) return technique_.slope_term;
    return false;
  }
  /// The light of a receiver from texels that `read` gives.
  template <std::size_t Limbs, class Read>
  ball<Limbs> light(const exact_lookup& lookup, float t, Read read) const {
    using number = ball<Limbs>;
    std::vector<number> sums(technique_.channels()), texel(sums.size());
    for (const exact_texel& at : lookup.texels) {
      read(at, std::span<number>(texel));
      const number weight = number(static_cast<double>(at.part) * 0x1p-48) *
                            number(static_cast<double>(at.share) * 0x1p-8);
      for (std::size_t c = 0; c < sums.size(); ++c) sums[c] = sums[c] + weight * texel[c];
    }
    if (lookup.probes > 1) {
      for (number& sum : sums) sum = sum / number(lookup.probes);
    }
    const number p = technique_.template light<number>(sums, number(clamp_depth(t)));
    const double alpha = on_split_grid(run_.how.bleeding_reduction);
    return alpha == 0 ? p : reduce_bleeding(p, number(alpha));
  }

  /// The same at a higher precision, from the depths themselves; nothing is known of footprints
  /// that are too large for it.
  template <std::size_t Limbs>
  ball<Limbs> refined(const exact_lookup& lookup, float t) const {
    using number = ball<Limbs>;
    using place = std::tuple<int, int, int>;
    if (base_texels(lookup) > most_refined_texels) return number::anything();
    std::map<place, std::vector<number>> stored, filtered;
    const auto texel = [&](int x, int y) -> const std::vector<number>& {
      x = wrap(x, run_.scene.depth.width, map_address);
      y = wrap(y, run_.scene.depth.height, map_address);
      auto& values = stored[{0, x, y}];
      if (values.empty()) {
        values.resize(technique_.channels());
        std::vector<number> one(values.size());
        texel_at<Limbs>(x, y, one, values);
      }
      return values;
    };
    const auto add = [](std::vector<number>& to, const std::vector<number>& values,
                        const number& weight) {
      for (std::size_t c = 0; c < to.size(); ++c) to[c] = to[c] + weight * values[c];
    };
    const auto value = [&](auto&& self, int level, int x, int y) -> const std::vector<number>& {
      auto& values = filtered[{level, x, y}];
      if (!values.empty()) return values;
      std::vector<number> sum(technique_.channels());
      if (level == 0) {
        const auto taps = static_cast<int>(blur_.weights.size());
        for (int j = 0; j < taps; ++j) {
          for (int i = 0; i < taps; ++i) {
            const number weight = number(blur_.weights[static_cast<std::size_t>(i)]) *
                                  number(blur_.weights[static_cast<std::size_t>(j)]);
            add(sum, texel(x + i - taps / 2, y + j - taps / 2), weight);
          }
        }
      } else {
        const auto across = mip_axis(map_mips, mip_size(run_.scene.depth.width, level - 1), x);
        const auto down = mip_axis(map_mips, mip_size(run_.scene.depth.height, level - 1), y);
        const number weight(1.0 / (across.denominator * down.denominator));
        for (int j = 0; j < down.count; ++j) {
          for (int i = 0; i < across.count; ++i) {
            add(sum, self(self, level - 1, across.first + i, down.first + j), weight);
          }
        }
      }
      // The map may have grown meanwhile, but its nodes stay where they are.
      values = std::move(sum);
      return values;
    };
    return light<Limbs>(lookup, t, [&](const exact_texel& at, std::span<number> out) {
      const auto& values = value(value, at.level, at.x, at.y);
      std::copy(values.begin(), values.end(), out.begin());
    });
  }

  static constexpr double most_refined_texels = 20000;
  static double base_texels(const exact_lookup& lookup) {
    double sum = 0;
    for (const exact_texel& at : lookup.texels) sum += std::ldexp(1.0, 2 * at.level);
    return sum;
  }

  /// What the technique says where every texel under the footprint has one depth.
  std::optional<double> flat_light(const exact_lookup& lookup, float t) const {
    if constexpr (requires { technique_.flat_light(0.0, 0.0); }) {
      const image<float>& depth = run_.scene.depth;
      const int radius = blur_.radius();
      const exact_texel& any = lookup.texels.front();
      const float x0 =
          clamp_depth(maps_.front()->at(std::min(any.x << any.level, depth.width - 1),
                                        std::min(any.y << any.level, depth.height - 1)));
      for (const exact_texel& at : lookup.texels) {
        const auto from = [&](int i) { return (i << at.level) - radius; };
        const auto to = [&](int i) { return ((i + 1) << at.level) + radius; };
        for (int y = std::max(0, from(at.y)); y < std::min(depth.height, to(at.y)); ++y) {
          for (int x = std::max(0, from(at.x)); x < std::min(depth.width, to(at.x)); ++x) {
            for (const image<float>* map : maps_) {
              if (clamp_depth(map->at(x, y)) != x0) return std::nullopt;
              if (slope_term() && has_slope(*map, x, y)) return std::nullopt;
            }
          }
        }
      }
      return technique_.flat_light(static_cast<double>(x0), static_cast<double>(clamp_depth(t)));
    } else {
      return std::nullopt;
    }
  }

  run_context& run_;
  const Technique& technique_;
  const kernel blur_;
  const std::vector<const image<float>*> maps_;
  std::vector<std::vector<image<ball<first_limbs>>>> chains_;
};

template <class Technique>
void run_filtered_exact(run_context& run, const Technique& technique) {
  filtered_exact<Technique> engine(run, technique);
  engine.generate();
  engine.shade();
}

}  // namespace bitshade
