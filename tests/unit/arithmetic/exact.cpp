#include <bit>
#include <cmath>
#include <compare>
#include <sstream>
#include <stdexcept>

#include "bitshade/arithmetic/interval.hpp"
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

TEST_CASE("exact takes a long double as it is") {
  CHECK(exact_rational(0x1.0000000000000002p+0L).value() - rational(1) == rational(1) / rational(std::uint64_t{1} << 63));
  CHECK(exact_rational(-0x1p-16445L) * exact_rational(0x1p16000L) == exact_rational(-1) / exact_rational(0x1p445));
  CHECK_THROWS_AS(exact_rational(HUGE_VALL), std::domain_error);
}

TEST_CASE("exact becomes the nearest float, subnormal ones too") {
  // Just above the middle of two subnormal floats, and at it.
  for (const float x : {0x1.2345p-130f, 0x1.2346p-130f, 0x1p-149f, 0.0f}) {
    const float next = std::nextafter(x, 1.0f);
    const exact_rational middle = (exact_rational(x) + exact_rational(next)) / exact_rational(2);
    const exact_rational little = exact_rational(0x1p-1000);
    const bool even = (std::bit_cast<std::uint32_t>(x) & 1) == 0;
    CHECK(static_cast<float>(middle + little) == next);
    CHECK(static_cast<float>(middle - little) == x);
    CHECK(static_cast<float>(middle) == (even ? x : next));
    CHECK(static_cast<float>(-middle) == (even ? -x : -next));
  }
  const double d = 0x1.2345p-1060;
  const exact_rational third = exact_rational(std::nextafter(d, 1.0) - d) / exact_rational(3);
  CHECK(static_cast<double>(exact_rational(d) + third) == d);
  CHECK(static_cast<double>(exact_rational(d) + third + third) == std::nextafter(d, 1.0));
}

TEST_CASE("exact is ordered, counted up and written as its rational is") {
  exact_rational x(1);
  CHECK(x++ == exact_rational(1));
  CHECK(--(++x) == exact_rational(2));
  CHECK(std::is_lt(x <=> exact_rational(3)));
  std::ostringstream out;
  out << x / exact_rational(6) << ' ' << bitshade::interval<float>(1, 2);
  CHECK(out.str() == "1/3 [1, 2]");
}

TEST_CASE("exact refuses what is no rational") {
  for (const double x : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    CHECK_THROWS_AS(exact_rational(x), std::domain_error);
    CHECK_THROWS_AS(exact_rational(static_cast<float>(x)), std::domain_error);
  }
}
