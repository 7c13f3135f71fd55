// Rationals lose nothing; what is irrational is enclosed, as closely as you ask.
#include <cstdio>

#include "bitshade/arithmetic/enclosure.hpp"
#include "bitshade/interop/rational.hpp"

using namespace bitshade;

int main() {
  const exact_rational third = exact_rational(1) / exact_rational(3);
  std::printf("1/3 + 1/3 + 1/3 = 1: %s\n", third + third + third == exact_rational(1) ? "yes" : "no");
  for (const int bits : {8, 40}) {
    const auto root = sqrt_enclosure(exact_rational(2), bits), power = exp_enclosure(third, bits);
    std::printf("%2d bits: sqrt 2 in [%.13g, %.13g], exp 1/3 in [%.13g, %.13g]\n", bits, static_cast<double>(root.lower()),
                static_cast<double>(root.upper()), static_cast<double>(power.lower()), static_cast<double>(power.upper()));
  }
}
// Prints:
// 1/3 + 1/3 + 1/3 = 1: yes
//  8 bits: sqrt 2 in [1.414211438475, 1.414215686275], exp 1/3 in [1.395541838134, 1.395679012346]
// 40 bits: sqrt 2 in [1.414213562373, 1.414213562373], exp 1/3 in [1.395612425086, 1.395612425086]
