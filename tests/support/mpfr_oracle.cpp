#include "support/mpfr_oracle.hpp"

#include <cstdio>

namespace oracle {
namespace {

using bitshade::encoding;
using bitshade::family;

bool normalised(const encoding& e) { return e.kind == family::unorm || e.kind == family::snorm; }
std::uint64_t ones(int n) { return n >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1; }
long least_exponent(const encoding& e) { return 2 - (1L << (e.exponent_bits - 1)); }

}  // namespace

void rounder::set_steps(mpfr_srcptr x) {
  nan_ = mpfr_nan_p(x) != 0;
  infinite_ = mpfr_inf_p(x) != 0;
  negative_ = mpfr_signbit(x) != 0;
  const mpfr_prec_t precision = mpfr_get_prec(x) + 64;  // whatever is multiplied below stays exact
  if (mpfr_get_prec(steps_) != precision) {
    mpfr_set_prec(steps_, precision);
    mpfr_set_prec(rounded_, precision);
    mpfr_set_prec(rest_, precision);
  }
  mpfr_abs(steps_, x, MPFR_RNDN);
}

void rounder::set(mpfr_srcptr x) {
  set_steps(x);
  if (nan_ || infinite_) return;
  if (normalised(e_)) {
    mpfr_mul_ui(steps_, steps_, ones(e_.kind == family::snorm ? e_.width - 1 : e_.width), MPFR_RNDN);
  } else if (e_.kind != family::binary) {
    mpfr_mul_2si(steps_, steps_, e_.fraction_bits, MPFR_RNDN);
  } else {
    ulp_ = least_exponent(e_) - e_.fraction_bits;
    if (mpfr_zero_p(x) == 0) {
      const long lead = mpfr_get_exp(x) - 1;
      if (lead > least_exponent(e_)) ulp_ = lead - e_.fraction_bits;
    }
    mpfr_mul_2si(steps_, steps_, -ulp_, MPFR_RNDN);
  }
}

void rounder::round(bitshade::rounding direction, std::uint64_t random, int random_bits) {
  using bitshade::rounding;
  direction_ = direction;
  huge_ = infinite_;
  count_ = ~std::uint64_t{0};
  if (nan_ || infinite_) return;
  switch (direction) {
    case rounding::nearest_even: mpfr_roundeven(rounded_, steps_); break;
    case rounding::nearest_away: mpfr_round(rounded_, steps_); break;
    case rounding::toward_zero: mpfr_trunc(rounded_, steps_); break;
    case rounding::up: negative_ ? mpfr_trunc(rounded_, steps_) : mpfr_ceil(rounded_, steps_); break;
    case rounding::down: negative_ ? mpfr_ceil(rounded_, steps_) : mpfr_trunc(rounded_, steps_); break;
    case rounding::to_odd:
      mpfr_trunc(rounded_, steps_);
      if (mpfr_integer_p(steps_) == 0 && (mpfr_get_ui(rounded_, MPFR_RNDZ) & 1) == 0) mpfr_ceil(rounded_, steps_);
      break;
    case rounding::stochastic: {
      // floor(2^n f) + (the n leading random bits) >= 2^n
      mpfr_frac(rest_, steps_, MPFR_RNDZ);
      mpfr_mul_2si(rest_, rest_, random_bits, MPFR_RNDZ);
      mpfr_floor(rest_, rest_);
      mpfr_trunc(rounded_, steps_);
      const std::uint64_t share = mpfr_get_ui(rest_, MPFR_RNDZ), drawn = random >> (64 - random_bits);
      if (share != 0 && drawn >= (ones(random_bits) - share) + 1) mpfr_add_ui(rounded_, rounded_, 1, MPFR_RNDZ);
      break;
    }
  }
  huge_ = mpfr_cmp_ui_2exp(rounded_, 1, 64) >= 0;
  count_ = huge_ ? ~std::uint64_t{0} : mpfr_get_ui(rounded_, MPFR_RNDZ);
}

std::uint64_t rounder::bits(bool flush, bitshade::overflow policy) const {
  using bitshade::overflow;
  using bitshade::rounding;
  const bool binary = e_.kind == family::binary;
  const bool outward = direction_ == rounding::nearest_even || direction_ == rounding::nearest_away ||
                       direction_ == rounding::stochastic || (direction_ == rounding::up && !negative_) ||
                       (direction_ == rounding::down && negative_);
  const bool ocp = e_.special == bitshade::specials::single_nan;
  const std::uint64_t sign = negative_ && e_.has_sign ? std::uint64_t{1} << (e_.width - 1) : 0;
  const std::uint64_t exponent_ones = binary ? ones(e_.exponent_bits) << e_.fraction_bits : 0;
  const std::uint64_t nan = ocp       ? exponent_ones | ones(e_.fraction_bits)
                            : !binary ? 0  // norms and integers have no fraction to put it in
                                      : exponent_ones | (std::uint64_t{1} << (e_.fraction_bits - 1));
  const std::uint64_t infinity = ocp ? nan : exponent_ones;
  const std::uint64_t largest = ocp ? nan - 1 : exponent_ones - 1;
  if (nan_) return binary ? nan : 0;
  if (negative_ && !e_.has_sign) return 0;
  if (infinite_ && binary) return sign | (policy == overflow::saturate ? largest : infinity);
  if (!binary) {
    if (!negative_) {
      const std::uint64_t most = ones(e_.has_sign ? e_.width - 1 : e_.width);
      return count_ < most ? count_ : most;
    }
    const std::uint64_t most = e_.kind == family::fixed ? std::uint64_t{1} << (e_.width - 1) : ones(e_.width - 1);
    return (0 - (count_ < most ? count_ : most)) & ones(e_.width);
  }
  // count 2^ulp: the exponent field says how far ulp lies above the subnormals'.
  const long field = ulp_ - (least_exponent(e_) - e_.fraction_bits);
  const bool huge = huge_ || field > (2L << e_.exponent_bits);
  const std::uint64_t magnitude = huge ? ~std::uint64_t{0} : (static_cast<std::uint64_t>(field) << e_.fraction_bits) + count_;
  if (magnitude > largest) {
    const bool finite = policy == overflow::saturate || (policy == overflow::ieee && !outward);
    return sign | (finite ? largest : infinity);
  }
  if (flush && magnitude < (std::uint64_t{1} << e_.fraction_bits)) return sign;
  return sign | magnitude;
}

void make_odd(mpfr_ptr x, int ternary) {
  if (ternary == 0 || mpfr_number_p(x) == 0) return;
  // x was rounded toward zero: half a unit farther lies strictly inside the interval.
  mpfr_prec_round(x, mpfr_get_prec(x) + 1, MPFR_RNDZ);
  if (mpfr_signbit(x) != 0) mpfr_nextbelow(x);
  else mpfr_nextabove(x);
}

void value(mpfr_ptr x, const encoding& e, std::uint64_t bits) {
  const bool negative = e.has_sign && ((bits >> (e.width - 1)) & 1) != 0;
  if (e.kind != family::binary) {
    std::int64_t code = static_cast<std::int64_t>(bits);
    if (negative) code = static_cast<std::int64_t>(bits | ~ones(e.width));
    if (normalised(e)) {
      const long most = static_cast<long>(ones(e.kind == family::snorm ? e.width - 1 : e.width));
      if (code < -most) code = -most;
      mpfr_set_si(x, code, MPFR_RNDN);
      make_odd(x, mpfr_div_si(x, x, most, MPFR_RNDZ));
    } else if (e.has_sign) {
      mpfr_set_si_2exp(x, code, -e.fraction_bits, MPFR_RNDN);
    } else {
      mpfr_set_ui_2exp(x, bits, -e.fraction_bits, MPFR_RNDN);
    }
    return;
  }
  const std::uint64_t fraction = bits & ones(e.fraction_bits);
  const auto field = static_cast<long>((bits >> e.fraction_bits) & ones(e.exponent_bits));
  const bool top = field == static_cast<long>(ones(e.exponent_bits));
  if (e.special == bitshade::specials::single_nan ? top && fraction == ones(e.fraction_bits) : top && fraction != 0) {
    mpfr_set_nan(x);
    return;
  }
  if (top && e.special == bitshade::specials::ieee) {
    mpfr_set_inf(x, negative ? -1 : 1);
    return;
  }
  const std::uint64_t whole = field == 0 ? fraction : fraction | (std::uint64_t{1} << e.fraction_bits);
  mpfr_set_ui_2exp(x, whole, (field == 0 ? 1 : field) - 1 + least_exponent(e) - e.fraction_bits, MPFR_RNDN);
  mpfr_setsign(x, x, negative ? 1 : 0, MPFR_RNDN);
}

std::string hex(std::uint64_t bits) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(bits));
  return text;
}

}  // namespace oracle
