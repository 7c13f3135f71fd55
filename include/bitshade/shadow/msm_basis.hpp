// What a four-moment map stores: an affine image of the moments that a quantised format keeps best.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bitshade {

/// Which affine image of the moments of y = 2x - 1 in [-1,1] a texel stores.
///
///   power      (1 + E[y]) / 2, E[y^2], (1 + E[y^3]) / 2, E[y^4]: only brought into [0,1]
///   dense      the image of largest volume, over all affine maps into [0,1]^4: sixteen
///   coefficients optimised  the image of largest volume among those that keep odd and even moments
///   apart: eight
enum class msm_basis : std::uint8_t { power, dense, optimised };

/// stored_i = offset_i + sum_j matrix_ij b_j, and the way back.
struct msm_transform {
  std::array<std::array<double, 4>, 4> matrix{};
  std::array<double, 4> offset{};
  std::array<std::array<double, 4>, 4> inverse{};
};

namespace detail {

/// Gauss-Jordan with the largest pivot of each column; the matrices here are well away from
/// singular.
constexpr std::array<std::array<double, 4>, 4> inverted(std::array<std::array<double, 4>, 4> a) {
  std::array<std::array<double, 4>, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) result[i][i] = 1;
  const auto size = [](double x) { return x < 0 ? -x : x; };
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t pivot = column;
    for (std::size_t i = column + 1; i < 4; ++i) {
      if (size(a[i][column]) > size(a[pivot][column])) pivot = i;
    }
    for (std::size_t j = 0; j < 4; ++j) {
      const double kept = a[column][j], also = result[column][j];
      a[column][j] = a[pivot][j], a[pivot][j] = kept;
      result[column][j] = result[pivot][j], result[pivot][j] = also;
    }
    const double first = a[column][column];
    for (std::size_t j = 0; j < 4; ++j) a[column][j] /= first, result[column][j] /= first;
    for (std::size_t i = 0; i < 4; ++i) {
      const double factor = a[i][column];
      if (i == column || factor == 0) continue;
      for (std::size_t j = 0; j < 4; ++j) {
        a[i][j] -= factor * a[column][j];
        result[i][j] -= factor * result[column][j];
      }
    }
  }
  return result;
}

constexpr msm_transform with_inverse(const std::array<std::array<double, 4>, 4>& matrix,
                                     const std::array<double, 4>& offset) {
  return {matrix, offset, inverted(matrix)};
}

}  // namespace detail

/// sqrt(3)/2 and 2 sqrt(3)/9, the coefficients of the second odd row.
inline constexpr double msm_half_root3 = 0x1.bb67ae8584caap-1;
inline constexpr double msm_two_ninths_root3 = 0x1.8a2345cc04426p-2;

/// The largest volume among maps that keep odd and even moments apart.
///
///   1/2 + 3/2 y - 2 y^3,   4 y^2 - 4 y^4,   1/2 + sqrt(3)/2 y - 2 sqrt(3)/9 y^3,   (y^2 + y^4) / 2
///
/// Each row maps [-1,1] into [0,1] and touches both ends; the determinant is 8/sqrt(3).
/// Source   [Peters17] section 2.3; tests/unit/shadow/msm_basis.cpp finds it by maximisation.
inline constexpr msm_transform msm_optimised_transform =
    detail::with_inverse({{{1.5, 0, -2, 0},
                           {0, 4, 0, -4},
                           {msm_half_root3, 0, -msm_two_ninths_root3, 0},
                           {0, 0.5, 0, 0.5}}},
                         {0.5, 0, 0.5, 0});

/// The largest volume over all affine maps into [0,1]^4: a determinant of 4.8512, 5 % above the
/// sparse one's, for twice the coefficients.
///
/// Eight decimals of what tests/unit/shadow/msm_basis.cpp finds by maximisation; every row keeps
/// [-1,1] within [0,1] to 2e-8. [PetersKlein15]'s matrix, made for [0,1], has the same volume.
inline constexpr msm_transform msm_dense_transform =
    detail::with_inverse({{{0, 0.54957133, 0, -1.49920657},
                           {0.94174936, -0.53411733, -0.49512240, 0.41619977},
                           {-0.91461273, -2.63428632, 1.41339893, 2.21005918},
                           {0.78909927, -2.89116705, -1.27110528, 2.46079571}}},
                         {0.94963525, 0.67126144, 0.92544055, 0.94836526});

/// The moments brought into [0,1] and nothing else.
inline constexpr msm_transform msm_power_transform = detail::with_inverse(
    {{{0.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.5, 0}, {0, 0, 0, 1}}}, {0.5, 0, 0.5, 0});

}  // namespace bitshade
