// What the operations of each stage did: a type that counts, put where the number stood.
#include <cstdio>

#include "bitshade/arithmetic/counted.hpp"

using namespace bitshade;
using half = counted<real<binary16>>;

void show(const char* stage, const operation_counts& n) {
  std::printf("%-8s %llu operations, %llu rounded, %llu cancelled, %llu overflowed, %llu subnormal\n", stage,
              static_cast<unsigned long long>(n.operations), static_cast<unsigned long long>(n.roundings),
              static_cast<unsigned long long>(n.cancellations), static_cast<unsigned long long>(n.overflows),
              static_cast<unsigned long long>(n.subnormals));
}

int main() {
  tally<2> counts;
  operation_counts& filter = counts[0];
  operation_counts& variance = counts[1];
  half m1(0.0f), m2(0.0f);
  for (const float depth : {0.5f, 0.501f, 0.502f, 0.503f}) {
    const half x(real<binary16>(depth), &filter);
    m1 += x * half(0.25f);
    m2 += x * x * half(0.25f);
  }
  const half v = m2.at(&variance) - m1.at(&variance) * m1.at(&variance);
  show("filter", filter);
  show("variance", variance);
  std::printf("variance %g\n", static_cast<double>(v));
}
// Prints:
// filter   20 operations, 3 rounded, 0 cancelled, 0 overflowed, 0 subnormal
// variance 2 operations, 1 rounded, 1 cancelled, 0 overflowed, 0 subnormal
// variance 0
