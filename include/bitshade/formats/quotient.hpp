// Every rounding in one place: a magnitude in units of the last place, and the integer that it becomes.
#pragma once

#include "bitshade/formats/rules.hpp"
#include "bitshade/formats/wide_integer.hpp"

namespace bitshade {

/// |x| / ulp = whole + fraction / 2^64 (+ something below 2^-64 if sticky).
struct quotient {
  std::uint64_t whole = 0;
  std::uint64_t fraction = 0;
  bool sticky = false;

  constexpr bool exact() const { return fraction == 0 && !sticky; }
  friend constexpr bool operator==(const quotient&, const quotient&) = default;
};

/// n * 2^shift (+ something below n's last bit if sticky) as a quotient; beyond 2^64 it stays just below.
constexpr quotient scaled(uint128 n, std::int64_t shift, bool sticky = false) {
  constexpr quotient beyond{~std::uint64_t{0}, ~std::uint64_t{0}, true};
  if (n == 0) return {0, 0, sticky};
  const int width = bit_width(n);
  if (shift > 64 || width + shift > 64) return beyond;
  if (shift >= 0) return {static_cast<std::uint64_t>(n << shift), 0, sticky};
  if (shift < -192) return {0, 0, true};
  const int s = static_cast<int>(-shift);
  quotient q;
  q.whole = s < 128 ? static_cast<std::uint64_t>(n >> s) : 0;
  if (s <= 64) {
    q.fraction = static_cast<std::uint64_t>(n << (64 - s));
  } else {
    const int t = s - 64;
    q.fraction = t < 128 ? static_cast<std::uint64_t>(n >> t) : 0;
    sticky = sticky || (t >= 128 ? n != 0 : (n & ((uint128{1} << t) - 1)) != 0);
  }
  q.sticky = sticky;
  return q;
}

/// Whether a magnitude between two integers goes to the upper one.
constexpr bool rounds_up(const quotient& q, bool negative, const rules& r, std::uint64_t random) {
  constexpr std::uint64_t half = std::uint64_t{1} << 63;
  switch (r.direction) {
    case rounding::nearest_even: return q.fraction > half || (q.fraction == half && (q.sticky || (q.whole & 1)));
    case rounding::nearest_away: return q.fraction >= half;
    case rounding::toward_zero: return false;
    case rounding::up: return !negative && !q.exact();
    case rounding::down: return negative && !q.exact();
    case rounding::to_odd: return !q.exact() && !(q.whole & 1);
    case rounding::stochastic: {
      // n bits of the fraction plus n random bits carry with probability floor(2^n f) / 2^n.
      const int drop = 64 - r.random_bits;
      const std::uint64_t f = q.fraction >> drop, x = random >> drop;
      return f != 0 && x >= (low_bits(r.random_bits) - f) + 1;
    }
  }
  return false;
}

/// The integer; 2^64 - 1 stands for everything from there on.
constexpr std::uint64_t round_quotient(const quotient& q, bool negative, const rules& r, std::uint64_t random) {
  return q.whole + ((q.whole != ~std::uint64_t{0} && rounds_up(q, negative, r, random)) ? 1 : 0);
}

}  // namespace bitshade
