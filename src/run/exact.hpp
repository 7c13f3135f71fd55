// A layer of a variance shadow map in exact arithmetic, as integers of proven width.
//
// In exact arithmetic p does not change when a layer's depths are scaled, so a layer is evaluated
// in units of clamp(x - near, 0, far - near), without its division and with the floor of the whole
// depth range: sums and products of integers, until p = num / den is rounded once.
//
// Widths, with S the depths' fraction bits and one more (so that half a difference is an integer),
// E and F of the mip levels and of the lookup:
//   y            S + 1 bits in units of 2^-S
//   samples      S + 4               2^-(S + 3)           a mean of up to 8, so is every other
//   texel first        S + 52 + E          2^-(S + 51 + E)      blur weights: two passes of 2^-24
//   second       2S + 52 + E         2^-(2S + 51 + E)
//   looked up    + F, and 5 for the sum of up to 16 probes
//   num, den     twice the looked-up first moment's, plus 1
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "bitshade/arithmetic/wide.hpp"
#include "run/engines.hpp"
#include "run/exact_grid.hpp"
#include "run/exact_mean.hpp"
#include "run/exact_moments.hpp"
#include "run/parallel.hpp"

namespace bitshade {

/// S: one more than the fraction bits of depths; General: mip levels or several probes a lookup.
template <int S, bool General>
class exact_engine {
 public:
  static constexpr int level_bits = General ? 28 : 0;    // 14 levels of 2x2 means
  static constexpr int lookup_bits = General ? 56 : 48;  // 2 x 24 of the texel grid, 8 of the level
  static constexpr int probe_bits = General ? 5 : 0;
  static constexpr int map_bits = exact_sample_bits + 48 + level_bits;
  static constexpr int scale = map_bits + lookup_bits;
  static constexpr std::size_t light_limbs = limbs_for(2 * (S + 1 + scale + probe_bits) + 1);
  using first_int =
      std::conditional_t<(S + 1 + map_bits <= 128), uint128, wide<limbs_for(S + 1 + map_bits)>>;
  using second_int = std::conditional_t<(2 * S + 1 + map_bits <= 128), uint128,
                                        wide<limbs_for(2 * S + 1 + map_bits)>>;
  using moments = exact_moments<S, second_int>;
  using depth_int = typename moments::depth_int;
  using light = fraction<light_limbs>;

  explicit exact_engine(run_context& run)
      : scene_(run.scene),
        how_(run.how),
        look_(run.look),
        threads_(run.threads),
        times_(run.result) {
    for (const double w : blur_of(how_).weights) blur_.push_back(on_grid(w, 24));
  }

  void generate(const interval& layer) {
    const stopwatch watch(times_.map_seconds);
    // Without the clamp a layer's depths are a line of the whole range's, on which p is the same.
    texels_ = moments(how_.warping == layer_warp::clamped ? layer : interval{0, 1});
    const auto width = moments(layer).width();
    const auto square = widened<light_limbs>(moments::squared(width)) << (2 * scale);
    layer_floor_ = square < floor_ ? square : floor_;
    levels_.clear();
    levels_.emplace_back(scene_.depth.width, scene_.depth.height);
    blur(levels_.front());
    if (!look_.mips) return;
    const int count = mip_levels(scene_.depth.width, scene_.depth.height);
    for (int level = 1; level < count; ++level) levels_.push_back(halved(levels_.back()));
  }

  template <class Use>
  void visit(std::span<const std::uint32_t> users, Use use) {
    const stopwatch watch(times_.shade_seconds);
    const auto light_of = [&](const receiver& r) { return light_at(r); };
    for_ranges(threads_, users.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) use(users[i], light_of);
    });
  }

  static light darker(const light& a, const light& b) {
    return b.num * a.den < a.num * b.den ? b : a;
  }

  fraction<2 * light_limbs + limbs_for(S + 2)> blended(const light& near, const light& far,
                                                       const receiver& r, double split) const {
    using share_int = wide<limbs_for(S + 2)>;
    const double delta = on_split_grid(how_.overlap);
    const auto grid = [](double x) { return share_int(moments::depth_of(static_cast<float>(x))); };
    const share_int all = grid(2 * delta);
    const share_int share =
        grid(r.t) - grid(std::max(0.0, split - delta)) + grid(std::max(0.0, delta - split));
    const auto den = near.den * far.den;
    return {near.num * far.den * (all - share) + far.num * near.den * share, den * all};
  }

  template <std::size_t Limbs>
  double finished(const fraction<Limbs>& p) const {
    if (how_.bleeding_reduction == 0) return quotient_to_double(p.num, p.den);
    const auto q = reduced(p);
    return quotient_to_double(q.num, q.den);
  }
  template <std::size_t Limbs>
  double mean(std::span<const fraction<Limbs>> all) const {
    if (how_.bleeding_reduction == 0) return mean_of(all);
    std::vector<fraction<Limbs + 1>> less;
    for (const auto& p : all) less.push_back(reduced(p));
    return mean_of(std::span<const fraction<Limbs + 1>>(less));
  }

 private:
  /// (p - alpha) / (1 - alpha), or 0.
  template <std::size_t Limbs>
  fraction<Limbs + 1> reduced(const fraction<Limbs>& p) const {
    const auto alpha = on_grid(on_split_grid(how_.bleeding_reduction), 24);
    const auto one = std::uint64_t{1} << 24;
    const auto lit = p.num * wide<1>(one), lost = p.den * wide<1>(alpha);
    const auto den = p.den * wide<1>(one - alpha);
    return {lit <= lost ? wide<Limbs + 1>{} : lit - lost, den};
  }
  struct level_map {
    level_map(int w, int h) : first(w, h), second(w, h) {}
    image<first_int> first;
    image<second_int> second;
  };
  template <class Int>
  static Int times(const Int& a, std::uint64_t b) {
    if constexpr (std::is_same_v<Int, uint128> || std::is_same_v<Int, std::uint64_t>) {
      return a * b;
    } else {
      return narrowed<std::tuple_size_v<decltype(a.limb)>>(a * wide<1>(b));
    }
  }
  template <std::size_t Limbs, class Int>
  static wide<Limbs> widened(const Int& a) {
    if constexpr (std::is_same_v<Int, uint128> || std::is_same_v<Int, std::uint64_t>) {
      return wide<Limbs>(a);
    } else {
      return narrowed<Limbs>(a);
    }
  }

  /// Two passes over the map; without a blur the texels are brought to the same unit.
  void blur(level_map& out) {
    const auto samples = depth_maps(scene_, look_.samples);
    const int width = scene_.depth.width, height = scene_.depth.height;
    const int radius = static_cast<int>(blur_.size() / 2);
    image<first_int> across1(width, height);
    image<second_int> across2(width, height);
    for_rows(threads_, height, [&](int y) {
      std::vector<depth_int> row(static_cast<std::size_t>(width));
      std::vector<second_int> squares(row.size());
      texels_.row(samples, y, how_.slope_term, row, squares);
      for (int x = 0; x < width; ++x) {
        first_int sum1{};
        second_int sum2{};
        for (std::size_t k = 0; k < blur_.size(); ++k) {
          const auto at =
              static_cast<std::size_t>(wrap(x - radius + static_cast<int>(k), width, map_address));
          sum1 += times(first_int(row[at]), blur_[k]);
          sum2 += times(squares[at], blur_[k]);
        }
        across1.at(x, y) = sum1;
        across2.at(x, y) = sum2;
      }
    });
    for_rows(threads_, height, [&](int y) {
      for (std::size_t k = 0; k < blur_.size(); ++k) {
        const int from = wrap(y - radius + static_cast<int>(k), height, map_address);
        for (int x = 0; x < width; ++x) {
          out.first.at(x, y) += times(across1.at(x, from), blur_[k]);
          out.second.at(x, y) += times(across2.at(x, from), blur_[k]);
        }
      }
      if constexpr (level_bits > 0) {
        for (auto& m : out.first.row(y)) m = m << level_bits;
        for (auto& m : out.second.row(y)) m = m << level_bits;
      }
    });
  }

  /// 2x2 means, or means of two along an axis of one texel: divisions by 4 or 2 without a rest.
  level_map halved(const level_map& from) const {
    const int width = from.first.width, height = from.first.height;
    level_map to(std::max(1, width / 2), std::max(1, height / 2));
    const auto mean = [&](const auto& in, auto& out, int y) {
      for (int x = 0; x < out.width; ++x) {
        auto sum = in.at(2 * x % width, 2 * y % height);
        int shift = 0;
        if (width > 1) sum += in.at(2 * x + 1, 2 * y % height), ++shift;
        if (height > 1) sum += in.at(2 * x % width, 2 * y + 1), ++shift;
        if (width > 1 && height > 1) sum += in.at(2 * x + 1, 2 * y + 1);
        out.at(x, y) = sum >> shift;
      }
    };
    for_rows(threads_, to.first.height, [&](int y) {
      mean(from.first, to.first, y);
      mean(from.second, to.second, y);
    });
    return to;
  }

  struct sums {
    wide<light_limbs> first, second;  // in units of 2^-(S + scale), 2^-(2S + scale)
  };

  /// Adds one lookup at (u, v) in steps of 2^-24, its weight `share` in units of 2^-(lookup - 48).
  void add_lookup(sums& total, const level_map& level, std::int64_t u, std::int64_t v,
                  std::uint64_t share) const {
    constexpr std::size_t limbs1 = limbs_for(S + 1 + scale + probe_bits);
    constexpr std::size_t limbs2 = limbs_for(2 * S + 1 + scale + probe_bits);
    for_fetched(look_, u, v, level.first.width, level.first.height,
                [&](int x, int y, std::uint64_t part) {
                  const auto w = wide<1>(part * share);
                  const auto& m1 = level.first.at(x, y);
                  const auto& m2 = level.second.at(x, y);
                  total.first += widened<light_limbs>(narrowed<limbs1>(widened<limbs1>(m1) * w));
                  total.second += widened<light_limbs>(narrowed<limbs2>(widened<limbs2>(m2) * w));
                });
  }

  light light_at(const receiver& r) const {
    const auto u = static_cast<std::int64_t>(static_cast<double>(r.u) * 0x1p24);
    const auto v = static_cast<std::int64_t>(static_cast<double>(r.v) * 0x1p24);
    sums total;
    std::uint64_t count = 1;
    if constexpr (!General) {
      add_lookup(total, levels_.front(), u, v, 1);
    } else {
      const auto probes =
          probes_of(r, scene_.depth.width, scene_.depth.height, look_.max_anisotropy);
      const auto blend =
          blend_levels(probes.lambda, static_cast<int>(levels_.size()), map_mip_bits);
      const auto far = on_grid(blend.fraction, map_mip_bits);
      count = probes.offsets.size();
      for (const auto& at : probes.offsets) {
        const auto pu = u + static_cast<std::int64_t>(at.du * 0x1p24);
        const auto pv = v + static_cast<std::int64_t>(at.dv * 0x1p24);
        add_lookup(total, levels_[static_cast<std::size_t>(blend.near)], pu, pv, 256 - far);
        if (far != 0) add_lookup(total, levels_[static_cast<std::size_t>(blend.far)], pu, pv, far);
      }
    }
    // Everything times the number of probes, whose mean this is.
    const auto n = wide<1>(count);
    const auto by = [&](const wide<light_limbs>& a) { return narrowed<light_limbs>(a * n); };
    const auto t = by(widened<light_limbs>(texels_.inside(r.t)) << scale);
    if (t <= total.first)
      return {wide<light_limbs>(std::uint64_t{1}), wide<light_limbs>(std::uint64_t{1})};
    const auto d = t - total.first;
    auto v2 = (by(total.second) << scale) - narrowed<light_limbs>(total.first * total.first);
    const auto floor = by(by(layer_floor_));
    if (v2 < floor) v2 = floor;
    return {v2, v2 + narrowed<light_limbs>(d * d)};
  }

  /// min_variance in units of 2^-2(S + scale): an integer, since configurations refuse the tiny.
  wide<light_limbs> floor_of(double min_variance) const {
    if (min_variance == 0) return {};
    const auto bits = std::bit_cast<std::uint64_t>(min_variance);
    const int exponent = static_cast<int>(bits >> 52) - 1075;
    const std::uint64_t significand = (bits & 0xfffffffffffff) | (std::uint64_t{1} << 52);
    return wide<light_limbs>(significand) << (exponent + 2 * (S + scale));
  }

  const frame& scene_;
  const configuration& how_;
  const lookup look_;
  const int threads_;
  cell& times_;
  std::vector<std::uint64_t> blur_;
  const wide<light_limbs> floor_ = floor_of(how_.min_variance);
  wide<light_limbs> layer_floor_;
  moments texels_;
  std::vector<level_map> levels_;
};

}  // namespace bitshade
