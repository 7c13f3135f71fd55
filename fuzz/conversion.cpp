// A format, a rule and a number, all of them arbitrary: encode against MPFR, and back.
#include <mpfr.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "bitshade/formats/decode.hpp"

using namespace bitshade;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 12) return 0;
  const encoding e = binary_encoding(2 + data[0] % 9, 1 + data[1] % 51);
  double x = 0;
  std::memcpy(&x, data + 4, 8);
  const std::uint64_t bits = encode(e, x);
  const double back = decode(e, bits);
  if (x != x) {
    if (back == back) std::abort();
    return 0;
  }
  if (encode(e, back) != bits) std::abort();
  // MPFR with the format's exponents, subnormals included.
  const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
  mpfr_t want;
  mpfr_init2(want, precision(e));
  mpfr_set_emin(min_ulp_exponent(e) + 1);
  mpfr_set_emax(bias(e) + 1);
  const int ternary = mpfr_check_range(want, mpfr_set_d(want, x, MPFR_RNDN), MPFR_RNDN);
  mpfr_subnormalize(want, ternary, MPFR_RNDN);
  const double expected = mpfr_get_d(want, MPFR_RNDN);
  mpfr_clear(want);
  mpfr_set_emin(low);
  mpfr_set_emax(high);
  if (std::bit_cast<std::uint64_t>(expected) != std::bit_cast<std::uint64_t>(back)) std::abort();
  return 0;
}
