// Rationals rounded to binary64 once, independently of the library.
#pragma once

#include <cmath>

#include "bitshade/interop/rational.hpp"

namespace bitshade::test {

/// The binary64 nearest to x >= 0, ties to even; normal results only.
inline double nearest_double(const rational& x) {
  using boost::multiprecision::cpp_int;
  if (x == 0) return 0;
  cpp_int n = numerator(x), d = denominator(x);
  int k = static_cast<int>(msb(d)) - static_cast<int>(msb(n)) + 52;
  if (k > 0)
    n <<= k;
  else
    d <<= -k;
  while (n < (d << 52)) n <<= 1, ++k;
  while (n >= (d << 53)) d <<= 1, --k;
  cpp_int q = n / d;
  const cpp_int twice = (n - q * d) * 2;
  if (twice > d || (twice == d && (q & 1) != 0)) ++q;
  return std::ldexp(q.convert_to<double>(), -k);
}

inline double nearest_double(const exact_rational& x) { return nearest_double(x.value()); }

}  // namespace bitshade::test
