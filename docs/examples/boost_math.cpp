// Boost.Math brackets a root in an emulated format, to that format's last place.
#include <boost/math/tools/roots.hpp>
#include <cstdio>

#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/real_text.hpp"

using namespace bitshade;

template <class T>
void root_of_two(const char* name) {
  const auto f = [](T x) { return x * x - T(2); };
  const boost::math::tools::eps_tolerance<T> close(std::numeric_limits<T>::digits - 1);
  const auto [low, high] = boost::math::tools::bisect(f, T(1), T(2), close);
  std::printf("%-9s %.8g to %.8g\n", name, static_cast<double>(low), static_cast<double>(high));
}

int main() {
  root_of_two<real<binary32>>("binary32");
  root_of_two<real<binary16>>("binary16");
  root_of_two<real<bfloat16>>("bfloat16");
}
// Prints:
// binary32  1.4142132 to 1.4142137
// binary16  1.4140625 to 1.4140625
// bfloat16  1.40625 to 1.4375
