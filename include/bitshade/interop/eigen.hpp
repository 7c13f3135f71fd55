// Eigen matrices of real, exact and interval.
//
// real: everything dense (products, norms, LU, QR, Cholesky, eigenvalues). exact: products, determinants, LU with the
// first pivot that is not 0; nothing that takes a square root. interval: products and sums; decompositions choose
// pivots by comparing, which an interval cannot always answer, and do not compile.
#pragma once

#if __has_include(<Eigen/Core>)
#include <Eigen/Core>
#else
#include <eigen3/Eigen/Core>  // where distributions put it
#endif

#include "bitshade/arithmetic/exact.hpp"
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"

namespace Eigen {

template <class F, bitshade::rules R, class C>
struct NumTraits<bitshade::real<F, R, C>> : GenericNumTraits<bitshade::real<F, R, C>> {
  using Self = bitshade::real<F, R, C>;
  using Real = Self;
  using NonInteger = Self;
  using Nested = Self;
  using Literal = Self;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = F::value.has_sign, RequireInitialization = 0,
         ReadCost = 1, AddCost = 4, MulCost = 4 };
  static constexpr Self dummy_precision() { return Self(16) * std::numeric_limits<Self>::epsilon(); }
};

template <class Q>
struct NumTraits<bitshade::exact<Q>> : GenericNumTraits<bitshade::exact<Q>> {
  using Self = bitshade::exact<Q>;
  using Real = Self;
  using NonInteger = Self;
  using Nested = Self;
  using Literal = Self;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1,
         ReadCost = 10, AddCost = 500, MulCost = 500 };
  static Self epsilon() { return Self(0); }
  static Self dummy_precision() { return Self(0); }
  static Self lowest() { return Self(-1e300); }
  static Self highest() { return Self(1e300); }
  static int digits10() { return 0; }
};

template <class T>
struct NumTraits<bitshade::interval<T>> : GenericNumTraits<bitshade::interval<T>> {
  using Self = bitshade::interval<T>;
  using Real = Self;
  using NonInteger = Self;
  using Nested = Self;
  using Literal = Self;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1,
         ReadCost = 2, AddCost = 50, MulCost = 200 };
  static int digits10() { return 0; }
};

}  // namespace Eigen
