// exact and interval in code that has never heard of them: std::complex, Boost.Math, GLM, Eigen. What these libraries
// cannot do with them is in tests/refused.
#include <boost/math/statistics/univariate_statistics.hpp>
#include <boost/math/tools/polynomial.hpp>
#include <boost/math/tools/rational.hpp>
#include <complex>
#include <vector>

#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/interop/eigen.hpp"
#include "bitshade/interop/glm.hpp"
#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

#if __has_include(<Eigen/LU>)
#include <Eigen/LU>
#else
#include <eigen3/Eigen/LU>
#endif

using namespace bitshade;

namespace {

using bounds = interval<double>;

/// An interval that holds a number, and no more than `ulps` last places of it.
bool holds(const bounds& x, const exact_rational& exact, double ulps = 8) {
  const double size = static_cast<double>(abs(exact));
  return exact_rational(x.lower()) <= exact && exact <= exact_rational(x.upper()) && x.width() <= ulps * size * 0x1p-52;
}
exact_rational ratio(int a, int b) { return exact_rational(a) / exact_rational(b); }
bounds enclosed(int a, int b) { return bounds(a) / bounds(b); }

}  // namespace

TEST_CASE("std::complex multiplies and divides exact numbers exactly, and encloses them in intervals") {
  const std::complex<exact_rational> a(ratio(1, 3), ratio(2, 7)), b(ratio(3, 5), ratio(-1, 9));
  CHECK((a * b / b == a));
  CHECK(std::norm(a) == ratio(1, 9) + ratio(4, 49));
  CHECK(std::conj(a).imag() == ratio(-2, 7));
  const std::complex<bounds> c(enclosed(1, 3), enclosed(2, 7)), d(enclosed(3, 5), enclosed(-1, 9));
  const std::complex<bounds> product = c * d, quotient = c / d;
  CHECK(holds(product.real(), (a * b).real()));
  CHECK(holds(product.imag(), (a * b).imag()));
  CHECK(holds(quotient.real(), (a / b).real(), 32));
  CHECK(holds(quotient.imag(), (a / b).imag(), 32));
}

TEST_CASE("Boost.Math's polynomials and statistics take exact and interval") {
  const exact_rational c[] = {ratio(1, 3), ratio(-2, 7), ratio(5, 11)};
  const bounds d[] = {enclosed(1, 3), enclosed(-2, 7), enclosed(5, 11)};
  const exact_rational value = boost::math::tools::evaluate_polynomial(c, ratio(1, 10));
  CHECK(value == ratio(1, 3) - ratio(2, 70) + ratio(5, 1100));
  CHECK(holds(boost::math::tools::evaluate_polynomial(d, enclosed(1, 10)), value));
  const boost::math::tools::polynomial<exact_rational> p{{ratio(1, 3), ratio(1, 2)}};
  CHECK((p * p).evaluate(exact_rational(2)) == ratio(16, 9));
  const std::vector<exact_rational> v{ratio(1, 3), ratio(1, 5), ratio(1, 7)};
  const std::vector<bounds> w{enclosed(1, 3), enclosed(1, 5), enclosed(1, 7)};
  CHECK(boost::math::statistics::mean(v) == ratio(71, 315));
  CHECK(holds(boost::math::statistics::mean(w), ratio(71, 315)));
  const exact_rational mean = ratio(71, 315), square = ratio(1, 9) + ratio(1, 25) + ratio(1, 49);
  CHECK(boost::math::statistics::variance(v) == square / exact_rational(3) - mean * mean);
}

TEST_CASE("GLM's vectors and matrices of intervals add, multiply and transform") {
  using vector = glm::vec<2, bounds>;
  const vector a(enclosed(1, 3), enclosed(1, 7)), b(enclosed(1, 5), enclosed(1, 9));
  CHECK(holds((a + b).x, ratio(8, 15)));
  CHECK(holds((a * b).y, ratio(1, 63)));
  CHECK(holds((a / b).x, ratio(5, 3)));
  const glm::mat<2, 2, bounds> m(bounds(2), bounds(1), bounds(1), bounds(3));
  CHECK(holds((m * a).x, ratio(2, 3) + ratio(1, 7)));
  CHECK(holds((m * a).y, ratio(1, 3) + ratio(3, 7)));
}

TEST_CASE("Eigen solves exactly in rationals") {
  Eigen::Matrix<exact_rational, 3, 3> hilbert;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) hilbert(i, j) = ratio(1, i + j + 1);
  Eigen::Matrix<exact_rational, 3, 1> right;
  right << ratio(1, 1), ratio(0, 1), ratio(-1, 2);
  const Eigen::Matrix<exact_rational, 3, 1> x = hilbert.partialPivLu().solve(right);
  const Eigen::Matrix<exact_rational, 3, 1> back = hilbert * x;
  for (int i = 0; i < 3; ++i) CHECK(back(i) == right(i));
  CHECK(hilbert.determinant() == ratio(1, 2160));
}
