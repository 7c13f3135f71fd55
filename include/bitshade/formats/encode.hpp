// Numbers to bits. Integers alone: neither the caller's rounding direction nor its flush-to-zero reaches here.
#pragma once

#include <bit>

#include "bitshade/formats/limits.hpp"
#include "bitshade/formats/quotient.hpp"

namespace bitshade {

/// The bits of an infinite value, or of one that rounds beyond the largest finite number.
constexpr std::uint64_t overflow_bits(const encoding& e, bool negative, const rules& r, bool infinite) {
  const std::uint64_t sign = negative ? sign_bit(e) : 0;
  bool finite = r.overflow == overflow::saturate;
  if (r.overflow == overflow::ieee && !infinite) {
    finite = r.direction == rounding::toward_zero || r.direction == rounding::to_odd ||
             (r.direction == rounding::up && negative) || (r.direction == rounding::down && !negative);
  }
  if (finite) return sign | max_bits(e);
  return sign | (has_infinity(e) ? infinity_bits(e) : nan_bits(e));
}

/// Rounds a magnitude, given in units of the last place, and puts the bits together.
///
/// Shapes   binary: x = q * 2^ulp_exponent with ulp_exponent >= min_ulp_exponent(e), and q >= 2^M where it is
///          greater, q < 2^(M+1); other families: q in units of one code, ulp_exponent unused.
/// Failure  none: too large a magnitude overflows as r says, or clamps.
constexpr std::uint64_t assemble(const encoding& e, bool negative, std::int64_t ulp_exponent, const quotient& q,
                                 const rules& r, std::uint64_t random) {
  if (e.kind == family::binary) {
    if (negative && !e.has_sign) return 0;
    const std::uint64_t sign = negative ? sign_bit(e) : 0;
    const std::int64_t above = ulp_exponent - min_ulp_exponent(e);
    if (above >= (std::int64_t{1} << e.exponent_bits)) return overflow_bits(e, negative, r, false);
    const std::uint64_t whole = round_quotient(q, negative, r, random);
    // The hidden bit carries into the exponent field: subnormals need no case of their own.
    const std::uint64_t bits = (static_cast<std::uint64_t>(above) << e.fraction_bits) + whole;
    if (bits > max_bits(e)) return overflow_bits(e, negative, r, false);
    if (bits < min_normal_bits(e) && flushes_output(r.subnormal)) return sign;
    return sign | bits;
  }
  if (negative && !e.has_sign) return 0;
  const std::uint64_t whole = round_quotient(q, negative, r, random);
  if (!negative) return whole < max_bits(e) ? whole : max_bits(e);
  const std::uint64_t lowest = max_bits(e) + (e.kind == family::fixed ? 1 : 0);
  return (~(whole < lowest ? whole : lowest) + 1) & low_bits(e.width);
}

/// The bits of (-1)^negative n 2^exponent, plus something below n's last bit if sticky.
///
/// Failure  none where nothing is sticky. A sticky norm, which is multiplied by 2^N - 1 first, must not be so near to a
///          step or a tie that the missing bits decide.
constexpr std::uint64_t encode_scaled(const encoding& e, bool negative, uint128 n, std::int64_t exponent, bool sticky,
                                      const rules& r, std::uint64_t random) {
  if (n == 0 && !sticky) return negative && e.kind == family::binary ? sign_bit(e) : 0;
  switch (e.kind) {
    case family::binary: {
      const std::int64_t lead = exponent + bit_width(n) - 1;
      const std::int64_t low = min_exponent(e);
      const std::int64_t ulp = (lead > low ? lead : low) - e.fraction_bits;
      return assemble(e, negative, ulp, scaled(n, exponent - ulp, sticky), r, random);
    }
    case family::unorm:
    case family::snorm: {
      // n times 2^N - 1 with n's leading bit at the top: 96 + N bits, of which the 64 lowest lie below any random bit.
      const int up = 128 - bit_width(n);
      n <<= up;
      const uint128 low = uint128{static_cast<std::uint64_t>(n)} * steps_to_one(e);
      const uint128 high = (n >> 64) * steps_to_one(e) + (low >> 64);
      sticky = sticky || static_cast<std::uint64_t>(low) != 0;
      return assemble(e, negative, 0, scaled(high, exponent - up + 64, sticky), r, random);
    }
    case family::ufixed:
    case family::fixed: return assemble(e, negative, 0, scaled(n, exponent + e.fraction_bits, sticky), r, random);
  }
  return 0;
}

/// The bits of a NaN that came in with a sign and a 52-bit payload, quiet bit first.
constexpr std::uint64_t encode_nan(const encoding& e, bool negative, std::uint64_t payload, const rules& r) {
  if (e.kind != family::binary) return 0;
  if (r.nan == nan_payload::canonical) return nan_bits(e);
  const std::uint64_t sign = negative ? sign_bit(e) : 0;
  if (e.special == specials::single_nan) return sign | nan_bits(e);
  return sign | nan_bits(e) | (payload >> (52 - e.fraction_bits));
}

/// The bits of x, rounded once.
///
/// Policy   r; `random` is used by stochastic rounding alone (random.hpp makes it).
/// Error    none beyond the one rounding: norms multiply by 2^N - 1 in integers, not in binary64.
/// Failure  none: every double has an answer; NaN gives 0 in norms and fixed point.
constexpr std::uint64_t encode(const encoding& e, double x, const rules& r = {}, std::uint64_t random = 0) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const bool negative = (bits >> 63) != 0;
  const int field = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction = bits & low_bits(52);
  if (field == 0x7ff) {
    if (fraction != 0) return encode_nan(e, negative, fraction, r);
    if (e.kind == family::binary) return negative && !e.has_sign ? 0 : overflow_bits(e, negative, r, true);
    return assemble(e, negative, 0, {~std::uint64_t{0}, 0, false}, r, random);
  }
  const std::uint64_t significand = field == 0 ? fraction : fraction | (std::uint64_t{1} << 52);
  return encode_scaled(e, negative, significand, (field == 0 ? 1 : field) - 1075, false, r, random);
}

}  // namespace bitshade
