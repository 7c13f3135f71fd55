// Eigen solves the same system in three formats and exactly: the error that is left is the format's.
#include "bitshade/interop/eigen.hpp"

#include <cstdio>

#if __has_include(<Eigen/LU>)
#include <Eigen/LU>
#else
#include <eigen3/Eigen/LU>
#endif

#include "bitshade/interop/rational.hpp"

using namespace bitshade;

/// The first unknown of Hilbert's 3 x 3 system with the right side (1, 0, 0): 9.
template <class T>
double solve() {
  Eigen::Matrix<T, 3, 3> a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = T(1) / T(i + j + 1);
  Eigen::Matrix<T, 3, 1> b;
  b << T(1), T(0), T(0);
  const Eigen::Matrix<T, 3, 1> x = a.partialPivLu().solve(b);
  return static_cast<double>(x(0));
}

int main() {
  std::printf("exact    %.7g\n", solve<exact_rational>());
  std::printf("binary32 %.7g\n", solve<real<binary32>>());
  std::printf("binary16 %.7g\n", solve<real<binary16>>());
  std::printf("bfloat16 %.7g\n", solve<real<bfloat16>>());
}
// Prints:
// exact    9
// binary32 8.999981
// binary16 9.21875
// bfloat16 7.6875
