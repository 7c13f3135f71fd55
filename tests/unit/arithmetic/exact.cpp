#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

using bitshade::exact_rational;
using bitshade::rational;

TEST_CASE("exact takes every double as it is and loses nothing") {
  CHECK(exact_rational(0.1).value() == rational(3602879701896397) / rational(36028797018963968));
  CHECK(exact_rational(-0x1p-1074) * exact_rational(0x1p1023) * exact_rational(0x1p51) == exact_rational(-1));
  CHECK(exact_rational(1) / exact_rational(3) * exact_rational(3) == exact_rational(1));
  CHECK(static_cast<double>(exact_rational(1) / exact_rational(3)) == 1.0 / 3);
  CHECK(std::is_same_v<bitshade::policy<exact_rational>::filter, exact_rational>);
  CHECK(std::is_same_v<bitshade::policy<exact_rational>::store, bitshade::unrounded>);
}
