// GLM's vectors and functions in half.
#include "bitshade/interop/glm.hpp"

#include <cstdio>

using namespace bitshade;
using half = real<binary16>;
using vec3 = glm::vec<3, half>;

int main() {
  const vec3 light = glm::normalize(vec3(half(0.3), half(-1), half(0.2)));
  const vec3 normal(half(0), half(1), half(0));
  const vec3 mirrored = glm::reflect(light, normal);
  std::printf("%g %g %g\n", static_cast<double>(mirrored.x), static_cast<double>(mirrored.y), static_cast<double>(mirrored.z));
  std::printf("length %.7g\n", static_cast<double>(glm::length(mirrored)));
}
// Prints:
// 0.282471 0.941406 0.188232
// length 1
