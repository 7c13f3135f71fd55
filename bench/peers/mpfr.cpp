#include <mpfr.h>

#include "peers/peers.hpp"

namespace peers {

void by_mpfr_round(const float* in, float* out, std::size_t n) {
  // Half's exponents: 2^-24 is 0.5 * 2^-23, 65504 lies below 2^16.
  const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
  mpfr_set_emin(-23);
  mpfr_set_emax(16);
  mpfr_t x;
  mpfr_init2(x, 11);
  for (std::size_t j = 0; j < n; ++j) {
    const int inexact = mpfr_set_flt(x, in[j], MPFR_RNDN);
    mpfr_subnormalize(x, mpfr_check_range(x, inexact, MPFR_RNDN), MPFR_RNDN);
    out[j] = mpfr_get_flt(x, MPFR_RNDN);
  }
  mpfr_clear(x);
  mpfr_set_emin(low);
  mpfr_set_emax(high);
}

}  // namespace peers
