// One word for a whole pipeline, one line to change a stage: how the variance of a plane survives storage and filter.
#include <cstdio>

#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/chebyshev.hpp"

using namespace bitshade;

struct half_filter : policy<unorm16> {
  using filter = real<binary16>;
};

/// Light behind two texels of depth 0.4 and 0.6, at depth 0.7.
template <numeric_policy P>
double light() {
  using filter = typename P::filter;
  using shade = typename P::shade;
  const auto stored = [](double x) { return filter(round_to(P::store::value, x)); };
  const filter m1 = (stored(0.4) + stored(0.6)) * filter(0.5);
  const filter m2 = (stored(0.16) + stored(0.36)) * filter(0.5);
  const auto moments = mean_and_variance(static_cast<shade>(m1), static_cast<shade>(m2));
  return static_cast<double>(chebyshev(moments, shade(0.7), shade(0)));
}

int main() {
  std::printf("exact answer         0.2\n");
  std::printf("stored in unorm16    %.7g\n", light<policy<unorm16>>());
  std::printf("filtered in half     %.7g\n", light<half_filter>());
  std::printf("stored in unorm8     %.7g\n", light<policy<unorm8>>());
}
// Prints:
// exact answer         0.2
// stored in unorm16    0.2000976
// filtered in half     0.2001562
// stored in unorm8     0.2123554
