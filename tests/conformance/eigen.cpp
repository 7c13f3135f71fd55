// Eigen: dense solve and QR in emulated formats, exactly in rationals, products in intervals.
#include "bitshade/interop/eigen.hpp"

#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>
#else
#include <eigen3/Eigen/Dense>
#endif

#include "bitshade/formats/random.hpp"
#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

template <class T, int N>
Eigen::Matrix<T, N, N> matrix() {
  Eigen::Matrix<T, N, N> m;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j)
      m(i, j) = T(static_cast<double>(random_bits(9, static_cast<std::uint64_t>(N * i + j)) % 64) / 16 + (i == j ? 8 : 0));
  return m;
}

template <class T>
double residual() {
  const auto a = matrix<T, 5>();
  Eigen::Matrix<T, 5, 1> b;
  for (int i = 0; i < 5; ++i) b(i) = T(i - 2);
  const Eigen::Matrix<T, 5, 1> lu = a.partialPivLu().solve(b), qr = a.householderQr().solve(b);
  const Eigen::Matrix<T, 5, 1> r = a * lu - b, s = a * qr - b;
  double most = 0;
  for (int i = 0; i < 5; ++i)
    most = std::max({most, std::abs(static_cast<double>(r(i))), std::abs(static_cast<double>(s(i)))});
  return most;
}

}  // namespace

TEST_CASE("Eigen solves and decomposes in emulated formats") {
  // Backward stability: residual <= c n u |A| |x|; here n = 5, |A| |x| < 24, and c = 4 is generous.
  CHECK(residual<real<binary64>>() < 4 * 5 * 24 * 0x1p-53);
  CHECK(residual<real<binary32>>() < 4 * 5 * 24 * 0x1p-24);
  CHECK(residual<real<binary16>>() < 4 * 5 * 24 * 0x1p-11);
  CHECK(residual<real<bfloat16>>() > residual<real<binary32>>());
}

TEST_CASE("Eigen in emulated binary32 gives what it gives in float") {
  const auto a = matrix<real<binary32>, 5>();
  const auto f = matrix<float, 5>();
  const real<binary32> d = a.determinant();
  Eigen::Matrix<real<binary32>, 5, 5> p = a * a;
  // A product's order of summation is Eigen's, and vectorised for float: compare one entry summed in order.
  float sum = 0;
  for (int k = 0; k < 5; ++k) sum += f(2, k) * f(k, 3);
  CHECK(std::abs(static_cast<float>(p(2, 3)) - sum) <= 5 * 0x1p-24f * std::abs(sum) * 2);
  CHECK(std::abs(static_cast<double>(d) - static_cast<double>(f.cast<double>().determinant())) <
        1e-5 * std::abs(static_cast<double>(d)));
}

TEST_CASE("Eigen in rationals is exact, in intervals it encloses") {
  const auto a = matrix<exact_rational, 3>();
  const exact_rational determinant = a.determinant();
  CHECK(determinant == a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
                           a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0)));
  Eigen::Matrix<interval<double>, 3, 3> b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) b(i, j) = interval<double>(static_cast<double>(a(i, j)) / 3);
  const Eigen::Matrix<interval<double>, 3, 3> c = b * b;
  exact_rational sum(0);
  for (int k = 0; k < 3; ++k) sum += exact_rational(b(1, k).lower()) * exact_rational(b(k, 2).lower());
  CHECK((exact_rational(c(1, 2).lower()) <= sum && sum <= exact_rational(c(1, 2).upper())));
}
