// The bases of four-moment maps, found again by maximising the volume of their image.
#include "bitshade/shadow/msm_basis.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

using namespace bitshade;

namespace {

using matrix = std::array<std::array<double, 4>, 4>;

double determinant(matrix m) {
  double det = 1;
  for (std::size_t c = 0; c < 4; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < 4; ++i) {
      if (std::fabs(m[i][c]) > std::fabs(m[pivot][c])) pivot = i;
    }
    if (pivot != c) std::swap(m[pivot], m[c]), det = -det;
    if (m[c][c] == 0) return 0;
    det *= m[c][c];
    for (std::size_t i = c + 1; i < 4; ++i) {
      const double factor = m[i][c] / m[c][c];
      for (std::size_t j = c; j < 4; ++j) m[i][j] -= factor * m[c][j];
    }
  }
  return det;
}

/// Largest and smallest value of a row's polynomial on [-1,1]: a scan, refined by Newton's step on
/// the parabola through three points.
std::array<double, 2> range_of(const std::array<double, 4>& row, double offset) {
  const auto at = [&](double y) {
    return offset + y * (row[0] + y * (row[1] + y * (row[2] + y * row[3])));
  };
  std::array<double, 2> range{std::min(at(-1), at(1)), std::max(at(-1), at(1))};
  const int steps = 20000;
  const double h = 2.0 / steps;
  for (int i = 1; i < steps; ++i) {
    const double y = -1 + i * h, a = at(y - h), b = at(y), c = at(y + h);
    const double bend = a - 2 * b + c;
    const bool peak = (b - a) * (c - b) <= 0 && bend != 0;
    const double top = peak ? b - (c - a) * (c - a) / (8 * bend) : b;
    range[0] = std::min({range[0], b, top});
    range[1] = std::max({range[1], b, top});
  }
  return range;
}

/// Half the width of what a polynomial of two coefficients covers on [-1,1]: its norm.
double half_range(double first, double second, bool odd) {
  const std::array<double, 4> row =
      odd ? std::array<double, 4>{first, 0, second, 0} : std::array<double, 4>{0, first, 0, second};
  // Closed forms keep the search below fast: extrema at 0, 1 and where the derivative vanishes.
  const auto at = [&](double y) { return y * (row[0] + y * (row[1] + y * (row[2] + y * row[3]))); };
  const double inner = odd ? -first / (3 * second) : -first / (2 * second);
  const double turn = inner > 0 && inner < 1 ? at(std::sqrt(inner)) : 0;
  const double low = std::min({0.0, at(1), turn}), high = std::max({0.0, at(1), turn});
  return odd ? std::max(high, -low) : (high - low) / 2;
}

/// The largest determinant of two such polynomials, both of half range 1/2.
double best_pair(bool odd) {
  constexpr double pi = 3.14159265358979323846;
  const auto reach = [&](double angle) {
    return 0.5 / half_range(std::cos(angle), std::sin(angle), odd);
  };
  double best = 0, a = 0, b = 0, width = pi;
  const int steps = 200;
  for (int round = 0; round < 12; ++round) {
    const double from_a = a, from_b = b;
    for (int i = -steps; i <= steps; ++i)
      for (int j = -steps; j <= steps; ++j) {
        const double x = from_a + width * i / steps, y = from_b + width * j / steps;
        const double volume = reach(x) * reach(y) * std::fabs(std::sin(x - y));
        if (volume > best) best = volume, a = x, b = y;
      }
    width /= 8;
  }
  return best;
}

/// Rows of a dense basis: coordinate ascent on log det. In one row the problem is concave, and
/// solved by Newton's method with a logarithmic barrier that keeps it within [-1,1] on a grid.
class dense_search {
 public:
  explicit dense_search(std::uint64_t seed) {
    for (int i = 0; i <= points; ++i) {
      const double y = -std::cos(3.14159265358979323846 * i / points);
      powers_.push_back({1, y, y * y, y * y * y, y * y * y * y});
    }
    const std::array<std::array<double, 5>, 4> chebyshev{
        {{0, 1, 0, 0, 0}, {-1, 0, 2, 0, 0}, {0, -3, 0, 4, 0}, {1, 0, -8, 0, 8}}};
    for (row& r : rows_) {
      // Random sums of Chebyshev's polynomials, well inside [-1,1].
      double total = 0;
      std::array<double, 4> share{};
      for (double& x : share) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        x = static_cast<double>(seed >> 40) * 0x1p-23 - 1;
        total += std::fabs(x);
      }
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t j = 0; j < 5; ++j) r[j] += 0.9 * share[k] / total * chebyshev[k][j];
    }
    for (int sweep = 0; sweep < 12; ++sweep)
      for (std::size_t i = 0; i < 4; ++i) {
        for (double& x : rows_[i]) x /= 2;  // back inside, for a barrier that starts anew
        for (double barrier = 1e-2; barrier > 1e-8; barrier /= 4) improve(i, barrier);
      }
  }

  /// In [0,1] instead of [-1,1], shrunk by what the grid let pass.
  matrix result(std::array<double, 4>& offset) const {
    matrix m{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::array<double, 4> found{rows_[i][1], rows_[i][2], rows_[i][3], rows_[i][4]};
      const auto range = range_of(found, rows_[i][0]);
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = found[j] / (range[1] - range[0]);
      offset[i] = (rows_[i][0] - range[0]) / (range[1] - range[0]);
    }
    return m;
  }

 private:
  static constexpr int points = 400;
  using row = std::array<double, 5>;

  void improve(std::size_t i, double barrier) {
    row gradient_of_det{};  // the determinant is linear in a row: its cofactors
    for (std::size_t j = 0; j < 4; ++j) {
      matrix m{};
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = 0; l < 4; ++l) m[k][l] = k == i ? (l == j ? 1 : 0) : rows_[k][l + 1];
      gradient_of_det[j + 1] = determinant(m);
    }
    const auto value = [&](const row& a) {
      double det = 0, sum = 0;
      for (std::size_t j = 1; j < 5; ++j) det += gradient_of_det[j] * a[j];
      if (det == 0) return -1e300;
      for (const row& p : powers_) {
        const double q = a[0] + a[1] * p[1] + a[2] * p[2] + a[3] * p[3] + a[4] * p[4];
        if (!(q > -1 && q < 1)) return -1e300;
        sum += std::log1p(-q * q);
      }
      return std::log(std::fabs(det)) + barrier * sum;
    };
    row& a = rows_[i];
    for (int step = 0; step < 6; ++step) {
      double det = 0;
      for (std::size_t j = 1; j < 5; ++j) det += gradient_of_det[j] * a[j];
      row g{};
      std::array<row, 5> h{};
      for (std::size_t j = 0; j < 5; ++j) {
        g[j] = gradient_of_det[j] / det;
        for (std::size_t k = 0; k < 5; ++k) {
          h[j][k] = gradient_of_det[j] * gradient_of_det[k] / (det * det);
        }
      }
      for (const row& p : powers_) {
        const double q = a[0] + a[1] * p[1] + a[2] * p[2] + a[3] * p[3] + a[4] * p[4];
        const double room = 1 - q * q;
        const double first = -2 * q / room, second = 2 * (1 + q * q) / (room * room);
        for (std::size_t j = 0; j < 5; ++j) {
          g[j] += barrier * first * p[j];
          for (std::size_t k = 0; k < 5; ++k) h[j][k] += barrier * second * p[j] * p[k];
        }
      }
      const row direction = solved(h, g);
      double length = 1;
      const double before = value(a);
      for (int halving = 0; halving < 40; ++halving, length /= 2) {
        row next = a;
        for (std::size_t j = 0; j < 5; ++j) next[j] += length * direction[j];
        if (value(next) > before) {
          a = next;
          break;
        }
      }
    }
  }

  static row solved(std::array<row, 5> h, row g) {
    for (std::size_t c = 0; c < 5; ++c) {
      std::size_t pivot = c;
      for (std::size_t i = c + 1; i < 5; ++i) {
        if (std::fabs(h[i][c]) > std::fabs(h[pivot][c])) pivot = i;
      }
      std::swap(h[pivot], h[c]);
      std::swap(g[pivot], g[c]);
      for (std::size_t i = c + 1; i < 5; ++i) {
        const double factor = h[i][c] / h[c][c];
        for (std::size_t j = c; j < 5; ++j) h[i][j] -= factor * h[c][j];
        g[i] -= factor * g[c];
      }
    }
    for (std::size_t i = 5; i-- > 0;) {
      for (std::size_t j = i + 1; j < 5; ++j) g[i] -= h[i][j] * g[j];
      g[i] /= h[i][i];
    }
    return g;
  }

  std::vector<row> powers_;
  std::array<row, 4> rows_{};
};

}  // namespace

TEST_CASE("the sparse basis has the largest volume of those that keep odd and even apart") {
  CHECK(best_pair(true) == Approx(2 / std::sqrt(3.0)).epsilon(1e-6));
  CHECK(best_pair(false) == Approx(4).epsilon(1e-6));
  CHECK(std::fabs(determinant(msm_optimised_transform.matrix)) ==
        Approx(best_pair(true) * best_pair(false)).epsilon(1e-6));
  CHECK(msm_half_root3 == std::sqrt(3.0) / 2);
  CHECK(std::fabs(msm_two_ninths_root3 - 2 * std::sqrt(3.0L) / 9) < 0x1p-55L);
}

TEST_CASE("every basis maps depths into [0,1] and its inverse undoes it") {
  for (const msm_transform& t :
       {msm_power_transform, msm_dense_transform, msm_optimised_transform}) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto range = range_of(t.matrix[i], t.offset[i]);
      CAPTURE(i, range[0], range[1]);
      CHECK(range[0] >= -2e-8);
      CHECK(range[1] <= 1 + 2e-8);
      for (std::size_t j = 0; j < 4; ++j) {
        double product = 0;
        for (std::size_t k = 0; k < 4; ++k) product += t.matrix[i][k] * t.inverse[k][j];
        CHECK(std::fabs(product - (i == j ? 1 : 0)) < 1e-13);
      }
    }
  }
}

TEST_CASE(
    "the dense basis has the largest volume that maximisation finds, above the sparse one's") {
  double best = 0;
  for (std::uint64_t seed = 1; seed <= 7; ++seed) {
    std::array<double, 4> offset{};
    best = std::max(best, std::fabs(determinant(dense_search(seed).result(offset))));
  }
  const double dense = std::fabs(determinant(msm_dense_transform.matrix));
  CAPTURE(best, dense);
  CHECK(dense == Approx(best).epsilon(1e-3));
  CHECK(dense >= best * (1 - 1e-4));
  CHECK(dense > 1.04 * std::fabs(determinant(msm_optimised_transform.matrix)));
}
