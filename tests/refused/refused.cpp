// What must not compile, one case a number; CMakeLists.txt says what the compiler has to complain of.
#if CASE == 1 || CASE == 2
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/interop/glm.hpp"
#elif CASE == 3 || CASE == 4
#include <complex>

#include "bitshade/interop/rational.hpp"
#include "bitshade/arithmetic/interval.hpp"
#elif CASE == 5 || CASE == 6
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>

#include "bitshade/interop/rational.hpp"
#include "bitshade/arithmetic/interval.hpp"
#elif CASE == 7 || CASE == 8
#include "bitshade/interop/eigen.hpp"
#include "bitshade/interop/rational.hpp"
#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>
#else
#include <eigen3/Eigen/Dense>
#endif
#else
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/arithmetic/real_text.hpp"
#endif

using namespace bitshade;

int main() {
#if CASE == 0  // a case that compiles: the others fail for what they say
  const real<binary16> x = 1;
  return static_cast<int>(x) - 1;
#elif CASE == 1
  const glm::vec<2, interval<double>> a(1, 2);
  return (glm::dot(a, a) < 1) == truth::no;
#elif CASE == 2
  const glm::vec<2, real<unorm16>> a(1, 0);
  return static_cast<int>(glm::length(a));
#elif CASE == 3
  return static_cast<int>(std::abs(std::complex<exact_rational>(3, 4)));
#elif CASE == 4
  const std::complex<interval<double>> a(1, 2);
  return a == a;
#elif CASE == 5
  const auto f = [](interval<double> x) { return x * x - interval<double>(2); };
  boost::math::tools::bisect(f, interval<double>(1), interval<double>(2), [](auto, auto) { return true; });
#elif CASE == 6
  return static_cast<int>(boost::math::tgamma(exact_rational(4)));
#elif CASE == 7
  Eigen::Matrix<interval<double>, 2, 2> a;
  a.setConstant(interval<double>(1));
  return a.partialPivLu().matrixLU()(0, 0).lower() > 0;
#elif CASE == 8
  Eigen::Matrix<exact_rational, 2, 2> a;
  a.setConstant(exact_rational(1));
  return a.householderQr().matrixQR()(0, 0) == exact_rational(0);
#elif CASE == 9
  const interval<double> a(0, 1), b(0.5, 2);
  if (a < b) return 1;
#elif CASE == 10
  const real<binary16> x(1.5);
  const float y = x;
  return static_cast<int>(y);
#elif CASE == 11
  const real<binary32> wide(1);
  const real<binary16> narrow = wide;
  return static_cast<int>(narrow);
#elif CASE == 12
  constexpr rules stochastic{rounding::stochastic};
  return static_cast<int>(real<binary16, stochastic>(1));
#elif CASE == 13
  return static_cast<int>(binary<12, 3>::value.width);
#elif CASE == 14
  using namespace bitshade::literals;
  return static_cast<int>(010_half);
#elif CASE == 15
  using namespace bitshade::literals;
  return static_cast<int>(0b101_half);
#endif
  return 0;
}
