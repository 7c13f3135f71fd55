// What there is to count of an operation: its exact result against what its format can say.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

/// What the operations of one stage did.
struct operation_counts {
  std::uint64_t operations = 0;
  std::uint64_t roundings = 0;      ///< inexact results
  std::uint64_t cancellations = 0;  ///< sums that lost at least half of their leading bits
  std::uint64_t overflows = 0;      ///< finite operands, a rounded result beyond the largest number; clamps
  std::uint64_t subnormals = 0;     ///< results below the smallest normal number, flushed or not, zero excepted

  friend bool operator==(const operation_counts&, const operation_counts&) = default;
};

/// One row a stage; stages are numbered by whoever counts.
template <std::size_t Stages>
using tally = std::array<operation_counts, Stages>;

namespace detail {

/// The format and rules of a real, and of float and double.
template <class T>
struct arithmetic_of {
  static constexpr encoding format = shape_of<T>::value;
  static constexpr rules policy{};
  using emulated = real<bitshade::format<format>>;
};
template <real_number T>
struct arithmetic_of<T> {
  static constexpr encoding format = T::encoding_value;
  static constexpr rules policy = T::rules_value;
  using emulated = T;
};

/// The same steps as a norm's or a fixed-point format's, in 64 bits with a sign: what is clamped has room there.
constexpr encoding with_room(const encoding& e) {
  if (e.kind == family::binary) return e;
  return {is_norm(e) ? family::snorm : family::fixed, 0, e.fraction_bits, 64, specials::ieee, true};
}

/// A number of the format E as the bits of with_room(E).
template <encoding E>
constexpr std::uint64_t roomy_bits(double x) {
  const std::uint64_t bits = encode(E, x);
  if (E.kind == family::binary || (bits & sign_bit(E)) == 0) return bits;
  return bits | ~low_bits(E.width);
}

/// Counts an operation, given as a function from rules to the bits of its result in with_room(E).
template <encoding E, rules R, class At>
constexpr void count_operation(operation_counts& n, bool finite_operands, At at) {
  constexpr encoding wide = with_room(E);
  rules r = R;
  r.subnormal = flushes_input(R.subnormal) ? subnormals::flush_input : subnormals::preserve;
  r.overflow = overflow::infinity;
  const std::uint64_t got = at(r);
  r.overflow = overflow::ieee;
  r.direction = rounding::down;
  const std::uint64_t low = at(r);
  r.direction = rounding::up;
  const std::uint64_t high = at(r);

  n.operations += 1;
  // An exact operation gives the same number down and up; a sum that is exactly 0 differs in its sign alone.
  if (decode(wide, low) < decode(wide, high)) n.roundings += 1;
  if constexpr (E.kind == family::binary) {
    const auto magnitude = [](std::uint64_t bits) { return bits & ~sign_bit(E); };
    const auto is_number = [&](std::uint64_t bits) { return magnitude(bits) <= max_bits(E); };
    // A pole, x / 0 or log 0, is infinite in every direction, and what is invalid is NaN in every direction.
    if (finite_operands && !is_number(got) && (is_number(low) || is_number(high))) n.overflows += 1;
    if (magnitude(got) != 0 && magnitude(got) < min_normal_bits(E)) n.subnormals += 1;
  } else {
    const auto steps = static_cast<std::int64_t>(got), most = static_cast<std::int64_t>(max_bits(E));
    const std::int64_t least = E.kind == family::fixed ? -most - 1 : E.has_sign ? -most : 0;
    if (steps < least || steps > most) n.overflows += 1;
  }
}

/// Whether the exact x + y has lost at least half of the leading bits that a format keeps.
constexpr bool cancels(const encoding& e, const exact_result& x, const exact_result& y) {
  if (!x.is_finite() || !y.is_finite() || x.n == 0 || y.n == 0) return false;
  const auto lead = [](const exact_result& u) { return u.exponent + bit_width(u.n); };
  const int digits = e.kind == family::binary ? precision(e) : e.width - (e.has_sign ? 1 : 0);
  const exact_result z = sum_of(x, y, rounding::nearest_even);
  return z.is_zero() || (lead(x) > lead(y) ? lead(x) : lead(y)) - lead(z) >= (digits + 1) / 2;
}

}  // namespace detail

}  // namespace bitshade
