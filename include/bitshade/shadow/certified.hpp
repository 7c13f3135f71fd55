// e^x, cos and sin of enclosures, so that the techniques' templates run on certified numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bitshade/arithmetic/ball.hpp"
#include "bitshade/shadow/exponential.hpp"
#include "bitshade/shadow/half_turns.hpp"

namespace bitshade {

namespace detail {

/// 1 + 1/x^2 / 3 + 1/x^4 / 5 .. over x (signs alternating or not): artanh(1/x) or arctan(1/x).
template <std::size_t Limbs>
ball<Limbs> inverse_series(int x, bool alternating) {
  using number = ball<Limbs>;
  // Radii know nothing below 2^-1000, however many limbs there are; the least size that
  // they can report must still end the sum.
  const double enough = std::ldexp(1.0, -std::min(number::bits + 20, 998));
  number power = number(1) / number(x), sum = power;
  const number square = number(x) * number(x);
  for (int n = 3;; n += 2) {
    power = power / square;
    const number term = power / number(n);
    if (term.size_above() < enough) {
      // What is left is less than the next power itself: x >= 3.
      return number::within(sum, power.size_above());
    }
    sum = alternating && n % 4 == 3 ? sum - term : sum + term;
  }
}

/// What the series need, derived once per precision.
template <std::size_t Limbs>
struct constants {
  using number = ball<Limbs>;
  /// Terms: |r| < 2^-9 leaves 2^-(9 terms); (pi/4)^n/n! < 2^-n for every n.
  static constexpr std::size_t exp_terms = static_cast<std::size_t>(number::bits) / 9 + 3;
  number ln2 = number(2) * inverse_series<Limbs>(3, false);
  number pi =
      number(16) * inverse_series<Limbs>(5, true) - number(4) * inverse_series<Limbs>(239, true);
  std::vector<number> inverse_factorials = reciprocals();

  static std::vector<number> reciprocals() {
    std::vector<number> result{number(1)};
    // Far enough that (pi/4)^n / n! is below every bit: n! > 2^(2n) from n = 9 on.
    const std::size_t most = static_cast<std::size_t>(number::bits) / 2 + 16;
    for (std::size_t n = 1; n < most; ++n) result.push_back(result.back() / number(n));
    return result;
  }
  static const constants& get() {
    static const constants c;
    return c;
  }
};

}  // namespace detail

/// e^x: every member's.
///
///   x = k ln 2 + 256 r;  e^x = 2^k (series of e^r)^256
///
/// Failure  an infinite radius where x is known to less than 1/2 or beyond +-600.
template <std::size_t Limbs>
ball<Limbs> exponential(const ball<Limbs>& x) {
  using number = ball<Limbs>;
  if (x.radius() == 0 && x.zero_middle()) return number(1);
  const double guess = x.nearest();
  if (!(guess < 600 && guess > -600)) return number::anything();
  const auto& c = detail::constants<Limbs>::get();
  const int k = static_cast<int>(guess * 0x1.71547652b82fep+0 + (guess < 0 ? -0.5 : 0.5));
  const number r = (x - number(k) * c.ln2) * number(0x1p-8);
  if (!(r.size_above() + r.radius() < 0x1p-9)) return number::anything();
  constexpr std::size_t terms = detail::constants<Limbs>::exp_terms;
  number sum = c.inverse_factorials[terms];
  for (std::size_t n = terms; n-- > 0;) sum = sum * r + c.inverse_factorials[n];
  // The tail is below |r|^(terms + 1) <= 2^-(9 terms + 9).
  sum = number::within(sum, detail::scaled_above(1, -9 * (static_cast<std::int64_t>(terms) + 1)));
  for (int i = 0; i < 8; ++i) sum = sum * sum;
  return sum * number(std::ldexp(1.0, k));
}

/// cos(n pi x), sin(n pi x): every member's.
template <std::size_t Limbs>
half_turn<ball<Limbs>> half_turns(const ball<Limbs>& x, int n) {
  using number = ball<Limbs>;
  const auto& c = detail::constants<Limbs>::get();
  const number y = x * number(n);
  const double guess = y.nearest();
  if (!(y.radius() < 0.125 && guess < 0x1p30 && guess > -0x1p30)) {
    const number any = number::within(number(), 1);
    return {any, any};
  }
  const auto quarters = static_cast<std::int64_t>(guess * 2 + (guess < 0 ? -0.5 : 0.5));
  const number a = (y - number(static_cast<double>(quarters) * 0.5)) * c.pi;
  const number square = a * a;
  const auto& f = c.inverse_factorials;
  // |a| <= 3 pi/8 (with the radius) < 5/4: the next term bounds the tail of an alternating series.
  std::size_t last = 0;
  double next = 1;
  while (last + 4 < f.size() && next > std::ldexp(1.0, -number::bits - 8)) {
    ++last;
    next *= 1.25 / static_cast<double>(last);
  }
  last += last % 2;
  number cosine = f[last], sine = f[last + 1];
  for (std::size_t i = last; i > 0;) {
    i -= 2;
    cosine = f[i] - square * cosine;
    sine = f[i + 1] - square * sine;
  }
  const double tail = detail::radius_above(next * 1.25);
  cosine = a.exactly_zero() ? number(1) : number::within(cosine, tail);
  sine = a.exactly_zero() ? number(0) : number::within(sine * a, tail);
  switch (quarters & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

template <std::size_t Limbs>
ball<Limbs> inverse_half_turns(const ball<Limbs>&, int n) {
  using number = ball<Limbs>;
  return number(1) / (detail::constants<Limbs>::get().pi * number(n));
}

}  // namespace bitshade
