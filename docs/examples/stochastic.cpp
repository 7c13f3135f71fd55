// Sixteen samples, each rounded at random: the digits on which they agree are the ones to trust.
#include <cstdio>

#include "bitshade/arithmetic/samples.hpp"

using namespace bitshade;
using single = samples<binary32, 16>;

int main() {
  const single a(0.1, 1), b(0.3, 2);
  const single sum = a + b, left = sum - b - a;  // 0 but for the roundings
  std::printf("sum         %.9g, %.0f bits\n", sum.mean(), sum.significant_bits());
  const single small = (single(1) + a * single(0x1p-17)) - single(1);
  std::printf("cancelled   %.3g, %.0f bits\n", small.mean(), small.significant_bits());
  std::printf("a zero      %.0f bits\n", left.significant_bits());
}
// Prints:
// sum         0.400000004, 24 bits
// cancelled   7.75e-07, 4 bits
// a zero      0 bits
