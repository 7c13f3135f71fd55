// Gaussian and box weights as given data: the same bits everywhere, and a sum of exactly 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "bitshade/texture/elementary.hpp"

namespace bitshade {

/// The weights of a filter with an odd number of taps, the middle one at the texel itself.
struct kernel {
  std::vector<double> weights;

  int radius() const { return static_cast<int>(weights.size() / 2); }
  friend bool operator==(const kernel&, const kernel&) = default;
};

/// Kernel weights are multiples of this: exact kernels are integers of known width.
inline constexpr double kernel_grid = 0x1p-24;
/// Largest deviation of a weight of gaussian_kernel from the unrounded Gaussian's.
inline constexpr double gaussian_weight_abs_error = kernel_grid;

/// Samples of a Gaussian, normalised.
///
///   w_i = e^(-i^2 / (2 sigma^2)) / sum, on the grid of 2^-24
///
/// Shapes   taps weights, taps odd and >= 1; symmetric bit for bit.
/// Units    sigma in texels.
/// Error    each weight within gaussian_weight_abs_error; the sum is exactly 1.
/// Failure  std::invalid_argument for even taps or a sigma that is not positive.
inline kernel gaussian_kernel(int taps, double sigma) {
  if (taps < 1 || taps % 2 == 0)
    throw std::invalid_argument("a Gaussian kernel needs an odd number of taps");
  if (!(sigma > 0)) throw std::invalid_argument("a Gaussian kernel needs a positive sigma");
  const int radius = taps / 2;
  const auto at = [&](int i) { return exp_fixed(-(i / sigma) * (i / sigma) / 2); };
  double total = at(0);
  for (int i = 1; i <= radius; ++i) total += 2 * at(i);

  // Rounding the running sum from the tail inwards keeps every weight within one grid step and
  // gives the middle what is left, also within one step: no weight has to absorb all the errors.
  kernel result{std::vector<double>(static_cast<std::size_t>(taps))};
  double running = 0;
  std::int64_t spent = 0;
  for (int i = radius; i >= 1; --i) {
    running += at(i) / total;
    const auto upto = static_cast<std::int64_t>(running / kernel_grid + 0.5);
    const double weight = static_cast<double>(upto - spent) * kernel_grid;
    result.weights[static_cast<std::size_t>(radius - i)] = weight;
    result.weights[static_cast<std::size_t>(radius + i)] = weight;
    spent = upto;
  }
  result.weights[static_cast<std::size_t>(radius)] =
      static_cast<double>((std::int64_t{1} << 24) - 2 * spent) * kernel_grid;
  return result;
}

/// Equal weights, as far as the grid allows: the middle one takes what is left.
///
/// Shapes   taps weights, taps odd, 1 to 1023; symmetric bit for bit.
/// Error    each weight within taps / 2 grid steps of 1/taps, all but the middle within 1/2; the
///          sum is exactly 1.
/// Failure  std::invalid_argument for other taps.
inline kernel box_kernel(int taps) {
  if (taps < 1 || taps % 2 == 0 || taps > 1023)
    throw std::invalid_argument("a box kernel needs an odd number of taps, at most 1023");
  const std::int64_t whole = std::int64_t{1} << 24, each = (whole + taps / 2) / taps;
  kernel result{
      std::vector<double>(static_cast<std::size_t>(taps), static_cast<double>(each) * kernel_grid)};
  result.weights[static_cast<std::size_t>(taps / 2)] =
      static_cast<double>(whole - each * (taps - 1)) * kernel_grid;
  return result;
}

}  // namespace bitshade
