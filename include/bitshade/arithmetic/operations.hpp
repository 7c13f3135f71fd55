// Correctly rounded operations on bit patterns, for every format, direction and policy, known at run time or not.
#pragma once

#include "bitshade/arithmetic/exact_result.hpp"

namespace bitshade {

namespace detail {

constexpr bool counts_steps(const encoding& e) { return e.kind != family::binary; }

/// The operand that the bits stand for; of a norm or fixed-point number, its code as an integer.
constexpr exact_result operand(const encoding& e, std::uint64_t bits, const rules& r) {
  bits &= low_bits(e.width);
  const bool negative = (bits & sign_bit(e)) != 0;
  if (counts_steps(e)) {
    std::uint64_t n = negative ? (~bits + 1) & low_bits(e.width) : bits;
    if (e.kind == family::snorm && n > max_bits(e)) n = max_bits(e);
    return {exact_result::kind::finite, negative, n, 0, false};
  }
  const std::uint64_t magnitude = bits & ~sign_bit(e);
  if (magnitude > max_bits(e))
    return has_infinity(e) && magnitude == infinity_bits(e) ? exact_result::infinity(negative) : exact_result::nan();
  const std::uint64_t field = magnitude >> e.fraction_bits;
  if (field == 0) {
    const bool zero = magnitude == 0 || flushes_input(r.subnormal);
    return {exact_result::kind::finite, negative, zero ? 0 : magnitude, zero ? 0 : min_ulp_exponent(e), false};
  }
  const std::uint64_t n = (magnitude & low_bits(e.fraction_bits)) | (std::uint64_t{1} << e.fraction_bits);
  return {exact_result::kind::finite, negative, n, min_ulp_exponent(e) + static_cast<std::int64_t>(field) - 1, false};
}

/// Steps to one: a norm's 2^N - 1, or 2^F.
constexpr uint128 one_in_steps(const encoding& e) {
  return is_norm(e) ? uint128{steps_to_one(e)} : uint128{1} << e.fraction_bits;
}

/// |n| / d steps, rounded; d is at most 2^64.
constexpr std::uint64_t round_steps(const encoding& e, bool negative, uint128 n, uint128 d, const rules& r,
                                    std::uint64_t random) {
  const uint128 whole = n / d, rest = n % d;
  if ((whole >> 64) != 0) return assemble(e, negative, 0, {~std::uint64_t{0}, 0, true}, r, random);
  // rest < 2^64, so that 64 more digits fit.
  const uint128 scaled_rest = rest << 64;
  const quotient q{static_cast<std::uint64_t>(whole), static_cast<std::uint64_t>(scaled_rest / d),
                   scaled_rest % d != 0};
  return assemble(e, negative, 0, q, r, random);
}

/// The end of a norm or fixed-point format, which everything beyond goes to.
constexpr std::uint64_t clamp_end(const encoding& e, bool negative, const rules& r) {
  return assemble(e, negative, 0, {~std::uint64_t{0}, 0, true}, r, 0);
}

}  // namespace detail

/// a + b, rounded once.
constexpr std::uint64_t add(const encoding& e, std::uint64_t a, std::uint64_t b, const rules& r = {},
                            std::uint64_t random = 0) {
  const exact_result x = detail::operand(e, a, r), y = detail::operand(e, b, r);
  using kind = exact_result::kind;
  if (x.what == kind::nan || y.what == kind::nan) return nan_bits(e);
  if (x.what == kind::infinite) {
    if (y.what == kind::infinite && x.negative != y.negative) return nan_bits(e);
    return round_result(e, x, r, random);
  }
  if (y.what == kind::infinite) return round_result(e, y, r, random);
  if (detail::counts_steps(e)) {
    const bool like = x.negative == y.negative, less = x.n < y.n;
    const uint128 n = like ? x.n + y.n : less ? y.n - x.n : x.n - y.n;
    return detail::round_steps(e, like || !less ? x.negative : y.negative, n, 1, r, random);
  }
  return round_result(e, sum_of(x, y, r.direction), r, random);
}

/// a - b, rounded once: not add of a negated code, since norms and fixed point may not hold the negative.
constexpr std::uint64_t subtract(const encoding& e, std::uint64_t a, std::uint64_t b, const rules& r = {},
                                 std::uint64_t random = 0) {
  if (!detail::counts_steps(e) && e.has_sign) return add(e, a, b ^ sign_bit(e), r, random);
  const exact_result x = detail::operand(e, a, r);
  exact_result y = detail::operand(e, b, r);
  y.negative = !y.negative;
  using kind = exact_result::kind;
  if (x.what == kind::nan || y.what == kind::nan) return nan_bits(e);
  if (!x.is_finite() || !y.is_finite()) {
    if (!x.is_finite() && !y.is_finite() && x.negative != y.negative) return nan_bits(e);
    return round_result(e, x.is_finite() ? y : x, r, random);
  }
  if (!detail::counts_steps(e)) return round_result(e, sum_of(x, y, r.direction), r, random);
  const bool like = x.negative == y.negative, less = x.n < y.n;
  const uint128 n = like ? x.n + y.n : less ? y.n - x.n : x.n - y.n;
  return detail::round_steps(e, like || !less ? x.negative : y.negative, n, 1, r, random);
}

/// a * b, rounded once.
constexpr std::uint64_t multiply(const encoding& e, std::uint64_t a, std::uint64_t b, const rules& r = {},
                                 std::uint64_t random = 0) {
  exact_result x = detail::operand(e, a, r);
  const exact_result y = detail::operand(e, b, r);
  using kind = exact_result::kind;
  if (x.what == kind::nan || y.what == kind::nan) return nan_bits(e);
  x.negative = x.negative != y.negative;
  if (!x.is_finite() || !y.is_finite()) {
    if (x.is_zero() || y.is_zero()) return nan_bits(e);
    return round_result(e, exact_result::infinity(x.negative), r, random);
  }
  x.n *= y.n;
  x.exponent += y.exponent;
  if (detail::counts_steps(e)) return detail::round_steps(e, x.negative, x.n, detail::one_in_steps(e), r, random);
  return round_result(e, x, r, random);
}

/// a / b, rounded once. x / 0 is infinite, or the end of a norm or fixed-point format; 0 / 0 is NaN, or 0 there.
constexpr std::uint64_t divide(const encoding& e, std::uint64_t a, std::uint64_t b, const rules& r = {},
                               std::uint64_t random = 0) {
  const exact_result x = detail::operand(e, a, r), y = detail::operand(e, b, r);
  using kind = exact_result::kind;
  const bool negative = x.negative != y.negative;
  if (x.what == kind::nan || y.what == kind::nan || (!x.is_finite() && !y.is_finite()) ||
      (x.is_zero() && y.is_zero()))
    return nan_bits(e);
  if (!x.is_finite() || y.is_zero()) {
    if (detail::counts_steps(e)) return detail::clamp_end(e, negative, r);
    return round_result(e, exact_result::infinity(negative), r, random);
  }
  if (!y.is_finite() || x.is_zero()) return round_result(e, exact_result::zero(negative), r, random);
  if (detail::counts_steps(e))
    return detail::round_steps(e, negative, x.n * detail::one_in_steps(e), y.n, r, random);
  return round_result(e, quotient_of(x, y), r, random);
}

/// The square root, rounded once; of a negative number NaN (0 in norms and fixed point), of -0 -0.
constexpr std::uint64_t square_root(const encoding& e, std::uint64_t a, const rules& r = {},
                                    std::uint64_t random = 0) {
  exact_result x = detail::operand(e, a, r);
  if (x.is_zero()) return round_result(e, x, r, random);
  if (x.what == exact_result::kind::nan || x.negative) return nan_bits(e);
  if (!x.is_finite()) return round_result(e, x, r, random);
  if (!detail::counts_steps(e)) return round_result(e, root_of(x), r, random);
  x.n *= detail::one_in_steps(e);
  const exact_result root = root_of(x);
  return assemble(e, false, 0, scaled(root.n, root.exponent, root.sticky), r, random);
}

/// a * b + c, rounded once.
constexpr std::uint64_t fused_multiply_add(const encoding& e, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                                           const rules& r = {}, std::uint64_t random = 0) {
  exact_result x = detail::operand(e, a, r);
  const exact_result y = detail::operand(e, b, r), z = detail::operand(e, c, r);
  using kind = exact_result::kind;
  if (x.what == kind::nan || y.what == kind::nan || z.what == kind::nan) return nan_bits(e);
  const bool negative = x.negative != y.negative;
  if (!x.is_finite() || !y.is_finite()) {
    if (x.is_zero() || y.is_zero() || (!z.is_finite() && z.negative != negative)) return nan_bits(e);
    return round_result(e, exact_result::infinity(negative), r, random);
  }
  if (!z.is_finite()) return round_result(e, z, r, random);
  x.negative = negative;
  x.n *= y.n;
  x.exponent += y.exponent;
  if (!detail::counts_steps(e)) return round_result(e, sum_of(x, z, r.direction), r, random);
  const uint128 one = detail::one_in_steps(e), shifted = z.n * one;
  if (x.negative != z.negative) {
    const bool less = x.n < shifted;
    return detail::round_steps(e, less ? z.negative : x.negative, less ? shifted - x.n : x.n - shifted, one, r, random);
  }
  if (x.n + shifted < shifted) return detail::clamp_end(e, x.negative, r);  // beyond 2^128 / 2^64 steps
  return detail::round_steps(e, x.negative, x.n + shifted, one, r, random);
}

/// A number of one format in another, rounded once: also where a norm's value is no number of any binary format.
constexpr std::uint64_t convert(const encoding& to, const encoding& from, std::uint64_t bits, const rules& r = {},
                                std::uint64_t random = 0) {
  exact_result x = detail::operand(from, bits, r);
  if (!is_norm(from)) {
    if (from.kind != family::binary) x.exponent = -from.fraction_bits;
    return round_result(to, x, r, random);
  }
  if (!detail::counts_steps(to)) return norm_to(to, x.negative, static_cast<std::uint64_t>(x.n), from.fraction_bits, r, random);
  return detail::round_steps(to, x.negative, x.n * detail::one_in_steps(to), steps_to_one(from), r, random);
}

/// The bits of an exact result; of a norm's, which counts its steps.
constexpr std::uint64_t round_on_grid(const encoding& e, const exact_result& x, const rules& r = {},
                                      std::uint64_t random = 0) {
  if (!is_norm(e)) return round_result(e, x, r, random);
  if (x.what == exact_result::kind::nan) return nan_bits(e);
  if (!x.is_finite()) return detail::clamp_end(e, x.negative, r);
  return assemble(e, x.negative, 0, scaled(x.n, x.exponent, x.sticky), r, random);
}

}  // namespace bitshade
