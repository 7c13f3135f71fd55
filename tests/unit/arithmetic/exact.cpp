#include <cmath>
#include <stdexcept>

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

TEST_CASE("exact refuses what is no rational") {
  for (const double x : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    CHECK_THROWS_AS(exact_rational(x), std::domain_error);
    CHECK_THROWS_AS(exact_rational(static_cast<float>(x)), std::domain_error);
  }
}
