// Your own template in any format: write it for a type T, then say which.
#include <cstdio>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/arithmetic/real_math.hpp"

using namespace bitshade;

template <class T>
T length(T x, T y, T z) {
  return sqrt(x * x + y * y + z * z);
}

template <class T>
void show(const char* name) {
  std::printf("%-9s %.10g\n", name, static_cast<double>(length<T>(0.1, 0.2, 0.3)));
}

int main() {
  show<real<binary64>>("binary64");
  show<real<binary32>>("binary32");
  show<real<binary16>>("binary16");
  show<real<bfloat16>>("bfloat16");
  show<real<binary<6, 9>>>("e6m9");  // any exponent and fraction
  show<real<unorm<12>>>("unorm12");
  constexpr rules truncate{rounding::toward_zero};
  show<real<binary16, truncate>>("truncated");
}
// Prints:
// binary64  0.3741657387
// binary32  0.3741657734
// binary16  0.3742675781
// bfloat16  0.375
// e6m9      0.3740234375
// unorm12   0.3741147741
// truncated 0.3737792969
