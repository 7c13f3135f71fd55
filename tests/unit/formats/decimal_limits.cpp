// Decimal limits of every binary format against exact powers of ten.
#include "bitshade/formats/decimal_limits.hpp"

#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

/// 10^n against an exact number; n may be negative.
int compare_with_power_of_ten(mpfr_srcptr x, long n) {
  oracle::number left(4000), power(4000);
  mpfr_ui_pow_ui(power, 10, static_cast<unsigned long>(n < 0 ? -n : n), MPFR_RNDN);
  mpfr_set(left, x, MPFR_RNDN);
  if (n < 0) {
    mpfr_mul(left, left, power, MPFR_RNDN);
    return mpfr_cmp_ui(left, 1);
  }
  return mpfr_cmp(left, power);
}

}  // namespace

TEST_CASE("decimal exponents of every binary format: 10^n is within, 10^(n+1) beyond") {
  oracle::number number(128);
  for (int e = 2; e <= 11; ++e) {
    for (int m = 1; m <= 52; ++m) {
      const encoding formats[] = {binary_encoding(e, m), unsigned_binary_encoding(e, m), e4m3_encoding()};
      for (const encoding& format : formats) {
        INFO("e" << format.exponent_bits << "m" << format.fraction_bits << ": 10^" << min_exponent10(format) << " to 10^"
                 << max_exponent10(format));
        oracle::value(number, format, max_bits(format));
        CHECK(compare_with_power_of_ten(number, max_exponent10(format)) >= 0);
        CHECK(compare_with_power_of_ten(number, max_exponent10(format) + 1) < 0);
        oracle::value(number, format, min_normal_bits(format));
        CHECK(compare_with_power_of_ten(number, min_exponent10(format)) <= 0);
        CHECK(compare_with_power_of_ten(number, min_exponent10(format) - 1) > 0);
      }
    }
  }
  CHECK(max_exponent10(binary_encoding(9, 1)) == 76);
  CHECK(max_exponent10(binary_encoding(9, 2)) == 77);
}

TEST_CASE("decimal digits: 10^d < 2^(p-1) keeps d of them, and 10^(d-1) > 2^p tells all numbers apart") {
  oracle::number power(64);
  for (int p = 2; p <= 64; ++p) {
    INFO("precision " << p);
    const auto two_to = [&](int n) -> mpfr_srcptr {
      mpfr_set_ui_2exp(power, 1, n, MPFR_RNDN);
      return power;
    };
    CHECK(compare_with_power_of_ten(two_to(p - 1), decimal_digits(p)) >= 0);
    CHECK(compare_with_power_of_ten(two_to(p - 1), decimal_digits(p) + 1) < 0);
    CHECK(compare_with_power_of_ten(two_to(p), distinguishing_digits(p) - 1) < 0);
    CHECK(compare_with_power_of_ten(two_to(p), distinguishing_digits(p) - 2) >= 0);
  }
}
