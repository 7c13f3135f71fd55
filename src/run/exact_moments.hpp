// The moments of a layer's texels as integers of proven width: see exact.hpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bitshade/arithmetic/wide.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/texture/image.hpp"
#include "run/exact_grid.hpp"

namespace bitshade {

/// Bits below the depths' own, for the mean of up to 8 samples.
inline constexpr int exact_sample_bits = 3;

/// Second holds 2S + 4 bits and more.
template <int S, class Second>
class exact_moments {
 public:
  using depth_int = std::conditional_t<(S + 1 + exact_sample_bits <= 64), std::uint64_t,
                                       wide<limbs_for(S + 1 + exact_sample_bits)>>;

  exact_moments() = default;
  explicit exact_moments(const interval& layer)
      : near_(depth_of(static_cast<float>(layer.near))),
        width_(depth_of(static_cast<float>(layer.far)) - near_) {}

  const depth_int& width() const { return width_; }

  /// x * 2^S; binary32 holds every split and depth, and S bits hold their fractions.
  static depth_int depth_of(float x) {
    if constexpr (std::is_same_v<depth_int, std::uint64_t>) {
      return on_grid(static_cast<double>(x), S);
    } else {
      const auto bits = std::bit_cast<std::uint32_t>(x);
      const std::uint32_t field = bits >> 23 & 0xff;
      const std::uint64_t significand = (bits & 0x7fffff) | (field == 0 ? 0 : 0x800000);
      return depth_int(significand) << (S - 149 + (field == 0 ? 0 : static_cast<int>(field) - 1));
    }
  }
  /// The layer's own depth, in units of 2^-S.
  depth_int inside(float x) const {
    const depth_int depth = depth_of(x > 0 ? (x < 1 ? x : 1.0F) : 0.0F);
    if (depth < near_) return depth_int(std::uint64_t{0});
    const depth_int above = depth - near_;
    return above < width_ ? above : width_;
  }
  static Second squared(const depth_int& y) {
    if constexpr (std::is_same_v<Second, uint128>) {
      return static_cast<uint128>(y) * y;
    } else if constexpr (std::is_same_v<depth_int, std::uint64_t>) {
      return Second(static_cast<uint128>(y) * y);
    } else {
      return narrowed<std::tuple_size_v<decltype(Second::limb)>>(y * y);
    }
  }

  /// Row y of the moments in units of 2^-(S + 3) and 2^-(2S + 3): means over the samples' maps.
  void row(const std::vector<const image<float>*>& samples, int y, bool slope_term,
           std::vector<depth_int>& first, std::vector<Second>& second) const {
    const int shift = exact_sample_bits - std::countr_zero(static_cast<unsigned>(samples.size()));
    std::vector<depth_int> one(first.size());
    std::vector<Second> squares(first.size());
    std::fill(first.begin(), first.end(), depth_int{});
    std::fill(second.begin(), second.end(), Second{});
    for (const image<float>* depth : samples) {
      for (std::size_t x = 0; x < one.size(); ++x) {
        one[x] = inside(depth->row(y)[x]);
        squares[x] = squared(one[x]);
      }
      if (slope_term) add_slope(*depth, y, one, squares);
      for (std::size_t x = 0; x < one.size(); ++x) {
        first[x] += one[x] << shift;
        second[x] += squares[x] << shift;
      }
    }
  }

 private:
  /// The square of half of limited_slope(): depths are even, since S is a bit more than they need.
  static Second half_slope_squared(const depth_int& before, const depth_int& here,
                                   const depth_int& after) {
    if (before < here && here < after) {
      return squared(std::min<depth_int>(here - before, after - here) >> 1);
    }
    if (before > here && here > after) {
      return squared(std::min<depth_int>(before - here, here - after) >> 1);
    }
    return Second{};
  }
  /// Equation (12) on a row of squares.
  void add_slope(const image<float>& depth, int y, const std::vector<depth_int>& row,
                 std::vector<Second>& squares) const {
    const auto above = depth.row(std::max(y - 1, 0));
    const auto below = depth.row(std::min(y + 1, depth.height - 1));
    for (std::size_t x = 0; x < row.size(); ++x) {
      const auto left = x == 0 ? x : x - 1, right = x + 1 == row.size() ? x : x + 1;
      squares[x] += half_slope_squared(row[left], row[x], row[right]);
      squares[x] += half_slope_squared(inside(above[x]), row[x], inside(below[x]));
    }
  }

  depth_int near_{}, width_{};
};

}  // namespace bitshade
