// A stranger's program over the installed package: headers found, contract flags inherited, the
// compiled kernels linked.
#include <cstdio>

#include "bitshade/texture/image.hpp"

#ifndef BITSHADE_CONTRACTION_OFF
#error "the target's contract definitions did not arrive"
#endif

int main() {
  const bitshade::image<float> one(1, 1, 1, 1.0f);
  return one.at(0, 0) == 1.0f ? 0 : 1;
}
