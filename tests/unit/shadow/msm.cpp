// Four-moment bounds against an independent solution of the moment problem in 100 digits.
#include "bitshade/shadow/msm.hpp"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bitshade/arithmetic/real.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                          boost::multiprecision::et_off>;

struct atom {
  big at, mass;
};
using distribution = std::vector<atom>;

class random_numbers {
 public:
  explicit random_numbers(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 40) * 0x1p-24;
  }

 private:
  std::uint64_t state_;
};

distribution random_distribution(random_numbers& next, int atoms) {
  distribution result;
  big total = 0;
  for (int i = 0; i < atoms; ++i) {
    result.push_back({big(2 * next() - 1), big(next() + 0x1p-6)});
    total += result.back().mass;
  }
  for (atom& a : result) a.mass /= total;
  return result;
}

template <class F>
big mean(const distribution& d, F f) {
  big sum = 0;
  for (const atom& a : d) sum += a.mass * f(a.at);
  return sum;
}

four_moments<big> moments(const distribution& d) {
  const auto power = [&](int n) {
    return mean(d, [&](const big& x) -> big { return boost::multiprecision::pow(x, n); });
  };
  return {power(1), power(2), power(3), power(4)};
}

big share_from(const distribution& d, const big& y) {
  return mean(d, [&](const big& x) -> big { return x >= y ? 1 : 0; });
}

/// The eigenvalues of a symmetric 3x3 matrix and the squared first components of its vectors:
/// Jacobi's rotations. The nodes and weights of a quadrature ([GolubWelsch69]).
distribution quadrature(std::array<std::array<big, 3>, 3> a) {
  std::array<big, 3> first{1, 0, 0};
  for (int sweep = 0; sweep < 60; ++sweep) {
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const big theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const big t = (theta >= 0 ? big(1) : big(-1)) / (abs(theta) + sqrt(theta * theta + 1));
        const big c = 1 / sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < 3; ++k) {
          const big x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
        }
        for (std::size_t k = 0; k < 3; ++k) {
          const big x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        const big x = first[p], y = first[q];
        first[p] = c * x - s * y, first[q] = s * x + c * y;
      }
  }
  distribution result;
  for (std::size_t i = 0; i < 3; ++i) result.push_back({a[i][i], first[i] * first[i]});
  return result;
}

/// The distribution on y and two more depths with d's four moments: Stieltjes' recurrence over d's
/// own atoms, its last coefficient chosen so that y is an eigenvalue (Golub's modified matrix).
distribution canonical(const distribution& d, const big& y) {
  const auto p1 = [&](const big& x) -> big { return x - mean(d, [](const big& z) { return z; }); };
  const big a0 = mean(d, [](const big& x) { return x; });
  const big n1 = mean(d, [&](const big& x) -> big { return p1(x) * p1(x); });
  const big a1 = mean(d, [&](const big& x) -> big { return x * p1(x) * p1(x); }) / n1;
  const auto p2 = [&](const big& x) -> big { return (x - a1) * (x - a0) - n1; };
  const big n2 = mean(d, [&](const big& x) -> big { return p2(x) * p2(x); });
  const big beta2 = n2 / n1;
  const big a2 = y - beta2 * (y - a0) / p2(y);
  const big s1 = sqrt(n1), s2 = sqrt(beta2);
  return quadrature({{{a0, s1, 0}, {s1, a1, s2}, {0, s2, a2}}});
}

/// The mass at y or beyond it; y's own atom is found up to the rotations' error.
big mass_from(const distribution& d, const big& y) {
  return mean(d, [&](const big& x) -> big { return x >= y - big(1e-60) ? 1 : 0; });
}

}  // namespace

TEST_CASE("Hamburger's bound is the quadrature's that holds the receiver's depth") {
  random_numbers next(1);
  big worst = 0;
  double worst_double = 0;
  for (int i = 0; i < 300; ++i) {
    const distribution d = random_distribution(next, 3 + i % 5);
    const big y = 2 * next() - 1;
    const auto b = moments(d);
    const big expected = mass_from(canonical(d, y), y);
    const big got = hamburger_bound(b, y);
    worst = std::max<big>(worst, abs(got - expected));
    CAPTURE(i, got.str(25), expected.str(25));
    REQUIRE(abs(got - expected) < big("1e-60"));
    REQUIRE(got >= share_from(d, y) - big("1e-60"));  // an upper bound
    const auto narrow = [](const big& x) { return static_cast<double>(x); };
    const auto got_double = hamburger_bound<double>(
        biased<double>({narrow(b.b1), narrow(b.b2), narrow(b.b3), narrow(b.b4)}, 1e-7), narrow(y));
    const auto wanted = hamburger_bound(biased(b, 1e-7), y);
    worst_double = std::max(worst_double, std::fabs(got_double - narrow(wanted)));
  }
  CAPTURE(worst.str(5), worst_double);
  // With a bias alpha the Hankel matrix's inverse is at most 5/alpha in norm, so that 2^-53 in the
  // moments costs at most 9 * 25/alpha^2 * 2^-53 = 2.5 in principle; random distributions cost
  // less.
  CHECK(worst_double < 1e-6);
}

TEST_CASE("Hausdorff's bound is attained inside [-1,1], and between the truth and Hamburger's") {
  random_numbers next(7);
  int sharper = 0;
  for (int i = 0; i < 400; ++i) {
    const distribution d = random_distribution(next, 3 + i % 6);
    const big y = 2 * next() - 1;
    const auto b = moments(d);
    const big wide = hamburger_bound(b, y), got = hausdorff_bound(b, y);
    CAPTURE(i, wide.str(20), got.str(20));
    REQUIRE(got <= wide);
    REQUIRE(got >= share_from(d, y) - big("1e-60"));
    const distribution three = canonical(d, y);
    bool inside = true;
    for (const atom& a : three) inside = inside && abs(a.at) <= 1;
    if (inside) {
      REQUIRE(abs(got - wide) < big("1e-60"));
      continue;
    }
    ++sharper;
    // Masses on -1, y, z, 1 that give b0, b1, b2 and the bound; b3 and b4 must then follow.
    const big c0 = 1 - b.b2, c1 = b.b1 - b.b3, c2 = b.b2 - b.b4;
    const big z = (c2 - y * c1) / (c1 - y * c0);
    REQUIRE(abs(z) <= 1);
    const auto solve = [&](const std::array<big, 4>& nodes, std::array<big, 4> rhs) {
      // Lagrange: the mass at node i is E[l_i], a cubic's mean.
      std::array<big, 4> mass;
      for (std::size_t j = 0; j < 4; ++j) {
        std::array<big, 4> poly{1, 0, 0, 0};
        for (std::size_t k = 0; k < 4; ++k) {
          if (k == j) continue;
          const big scale = nodes[j] - nodes[k];
          for (std::size_t n = 4; n-- > 0;) {
            poly[n] = ((n > 0 ? poly[n - 1] : big(0)) - nodes[k] * poly[n]) / scale;
          }
        }
        mass[j] = poly[0] * rhs[0] + poly[1] * rhs[1] + poly[2] * rhs[2] + poly[3] * rhs[3];
      }
      return mass;
    };
    const std::array<big, 4> nodes{-1, y, z, 1};
    const auto mass = solve(nodes, {1, b.b1, b.b2, b.b3});
    big from = 0, fourth = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      REQUIRE(mass[j] >= 0);
      if (nodes[j] >= y) from += mass[j];
      fourth += mass[j] * boost::multiprecision::pow(nodes[j], 4);
    }
    REQUIRE(abs(fourth - b.b4) < big("1e-60"));
    REQUIRE(abs(from - got) < big("1e-60"));
  }
  CHECK(sharper > 50);
}

TEST_CASE("two planes and a receiver: four moments are exact where two are not") {
  // Depths a, b behind each other and the receiver itself lit by a share: three depths.
  const double a = -0.6, b = -0.2, t = 0.5;
  for (const auto& [ma, mb] :
       {std::array{0.25, 0.5}, std::array{0.125, 0.125}, std::array{0.4, 0.1}}) {
    const double mt = 1 - ma - mb;
    const auto power = [&](int n) {
      return ma * std::pow(a, n) + mb * std::pow(b, n) + mt * std::pow(t, n);
    };
    const four_moments<double> m{power(1), power(2), power(3), power(4)};
    CAPTURE(ma, mb);
    CHECK(hamburger_bound(m, t) == Approx(mt).epsilon(1e-9));
    CHECK(hausdorff_bound(m, t) == Approx(mt).epsilon(1e-9));
    CHECK(hamburger_bound(m, t) < chebyshev(mean_and_variance(m.b1, m.b2), t, 0.0));
  }
}

TEST_CASE("singular moments fall back to Chebyshev's bound and are never NaN") {
  const auto check = [](auto zero) {
    using T = decltype(zero);
    const four_moments<T> cases[] = {{T(0), T(0), T(0), T(0)},
                                     {T(1), T(1), T(1), T(1)},
                                     {T(-1), T(1), T(-1), T(1)},
                                     {T(0.5), T(0.5), T(0.5), T(0.5)},
                                     {T(0.5), T(0.25), T(0.125), T(0.0625)},
                                     {T(0), T(1), T(0), T(1)},
                                     {T(0.25), T(0.0625), T(0.5), T(0)}};
    for (const auto& b : cases)
      for (int i = -8; i <= 8; ++i)
        for (const double alpha : {0.0, 1e-6, 1e-3, 0.5}) {
          const T y = T(i / 8.0);
          const double wide = static_cast<double>(hamburger_bound(biased(b, alpha), y));
          const double sharp = static_cast<double>(hausdorff_bound(biased(b, alpha), y));
          CAPTURE(static_cast<double>(b.b1), static_cast<double>(b.b2), i, alpha);
          REQUIRE((wide >= 0 && wide <= 1));
          REQUIRE((sharp >= 0 && sharp <= wide));
        }
    const four_moments<T> single{T(0.5), T(0.25), T(0.125), T(0.0625)};
    CHECK(static_cast<double>(hamburger_bound(single, T(0.5))) == 1);
    CHECK(static_cast<double>(hamburger_bound(single, T(0.75))) == 0);
    const four_moments<T> halves{T(0), T(1), T(0), T(1)};  // half at -1, half at 1
    CHECK(static_cast<double>(hamburger_bound(halves, T(1))) == 0.5);
  };
  check(0.0f);
  check(0.0);
  check(real<binary16>(0.0));
  check(real<bfloat16>(0.0));
}

TEST_CASE("moments survive each basis and its inverse; rows equal texels") {
  std::vector<float> depth;
  for (int i = 0; i <= 512; ++i) depth.push_back(static_cast<float>(i) / 512);
  for (const msm_transform& basis :
       {msm_power_transform, msm_dense_transform, msm_optimised_transform}) {
    std::vector<float> row(4 * depth.size());
    msm_row<float>(depth, basis, row);
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const auto m = moments_of(static_cast<double>(depth[i]));
      const auto stored = to_basis(m, basis);
      const auto back = from_basis(stored, basis);
      for (const double s : stored) REQUIRE((s >= -2e-8 && s <= 1 + 2e-8));
      REQUIRE(std::fabs(back.b1 - m.b1) < 1e-14);
      REQUIRE(std::fabs(back.b2 - m.b2) < 1e-14);
      REQUIRE(std::fabs(back.b3 - m.b3) < 1e-14);
      REQUIRE(std::fabs(back.b4 - m.b4) < 1e-14);
      const auto narrow = to_basis(moments_of(depth[i]), basis);
      for (std::size_t k = 0; k < 4; ++k) REQUIRE(row[4 * i + k] == narrow[k]);
    }
  }
}

TEST_CASE("the bias vector is the best-conditioned one, and a sufficient bias suffices") {
  // Smallest eigenvalue of (1, 0, m; 0, m, 0; m, 0, k) over all k <= m <= 1, by search.
  double best = 0, best_m = 0, best_k = 0;
  for (int i = 1; i <= 1000; ++i)
    for (int j = 1; j <= i; ++j) {
      const double m = i / 1000.0, k = j / 1000.0;
      const double block = (1 + k - std::sqrt((1 - k) * (1 - k) + 4 * m * m)) / 2;
      const double smallest = std::min(block, m);
      if (smallest > best) best = smallest, best_m = m, best_k = k;
    }
  CHECK(best_m == Approx(msm_bias_even_moment).margin(1.5e-3));
  CHECK(best_k == Approx(msm_bias_even_moment).margin(1.5e-3));
  CHECK(best == Approx(msm_bias_eigenvalue).margin(1e-6));

  random_numbers next(3);
  for (const msm_transform& basis :
       {msm_power_transform, msm_dense_transform, msm_optimised_transform})
    for (const encoding& e : {unorm16::value, unorm8::value}) {
      const double alpha = msm_sufficient_bias(decode(e, 1), basis);
      CAPTURE(alpha, e.width);
      CHECK(alpha < 1);
      for (int i = 0; i < 2000; ++i) {
        const double x = next(), z = next(), w = i % 3 == 0 ? 0 : next();
        auto stored = to_basis(moments_of(x), basis);
        const auto other = to_basis(moments_of(z), basis);
        for (std::size_t k = 0; k < 4; ++k) {
          stored[k] = round_to(e, (1 - w) * stored[k] + w * other[k]);
        }
        const auto b = biased(from_basis(stored, basis), alpha);
        CAPTURE(x, z, w);
        REQUIRE_FALSE(detail::factorised(b).singular);
      }
    }
}
