// Intervals hold the exact result, and their comparisons say where they cannot know.
#include <cstdio>

#include "bitshade/arithmetic/interval.hpp"

using namespace bitshade;
using bounds = interval<float>;

const char* word(truth t) { return t == truth::yes ? "yes" : t == truth::no ? "no" : "maybe"; }

int main() {
  const bounds tenth = bounds(1) / bounds(10);
  bounds sum(0);
  for (int i = 0; i < 10; ++i) sum += tenth;
  std::printf("ten tenths lie in [%.9g, %.9g]\n", static_cast<double>(sum.lower()), static_cast<double>(sum.upper()));
  std::printf("below 1? %s.  below 1.001? %s.\n", word(sum < bounds(1)), word(sum < bounds(1.001f)));
  const bounds either = select(sum < bounds(1), bounds(0), bounds(1));  // both sides are possible
  std::printf("select gives [%g, %g]\n", static_cast<double>(either.lower()), static_cast<double>(either.upper()));
}
// Prints:
// ten tenths lie in [0.999999821, 1.00000024]
// below 1? maybe.  below 1.001? yes.
// select gives [0, 1]
