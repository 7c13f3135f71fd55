// Certified real numbers: a midpoint of fixed precision and a radius that holds the truth.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "bitshade/arithmetic/wide.hpp"

namespace bitshade {

/// What is known of a comparison between enclosures.
enum class known : std::uint8_t { no, yes, unknown };

constexpr known either(known a, known b) {
  if (a == known::yes || b == known::yes) return known::yes;
  return a == known::no && b == known::no ? known::no : known::unknown;
}

namespace detail {

/// An upper bound of a radius computed in binary64: the slop covers every rounding and underflow of
/// up to 2^10 operations, so that it is never 0; what overflowed or is NaN is no bound at all.
inline double radius_above(double x) {
  const double above = x * (1 + 0x1p-40) + 0x1p-1000;
  return above == above ? above : std::numeric_limits<double>::infinity();
}

/// x 2^exponent, never below the truth where it underflows; x >= 0.
inline double scaled_above(double x, std::int64_t exponent) {
  if (x == 0) return 0;
  if (exponent < -1900) return 0x1p-1000;
  if (exponent > 1900) return std::numeric_limits<double>::infinity();
  const auto power = [](std::int64_t e) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
  };
  for (; exponent > 1000; exponent -= 1000) x *= power(1000);
  for (; exponent < -1000; exponent += 1000) x *= power(-1000);
  return radius_above(x * power(exponent));
}

}  // namespace detail

/// All real numbers within a radius of a midpoint of 64 * Limbs bits.
///
/// Every operation on enclosures gives an enclosure of every result that members can have. A radius
/// of 0 is an exact number, and operations whose result fits keep it so.
///
/// Policy   comparisons are three-valued (`known`); select() of what is unknown is both.
/// Failure  a division by what may be 0 has an infinite radius. Radii below 2^-1000 are not told
///          from it: precision beyond a thousand bits serves exactness alone.
/// Source   midpoint-radius arithmetic, [Johansson17].
template <std::size_t Limbs>
class ball {
 public:
  using mantissa_type = wide<Limbs>;
  static constexpr int bits = static_cast<int>(64 * Limbs);

  ball() = default;
  ball(double x) {
    const auto word = std::bit_cast<std::uint64_t>(x);
    const int field = static_cast<int>(word >> 52 & 0x7ff);
    const std::uint64_t fraction = word & 0xfffffffffffff;
    if (field == 0x7ff) {
      radius_ = std::numeric_limits<double>::infinity();
      return;
    }
    *this = normalised<1>((word >> 63) != 0,
                          wide<1>(field == 0 ? fraction : fraction | std::uint64_t{1} << 52),
                          (field == 0 ? 1 : field) - 1075, 0);
  }
  ball(float x) : ball(static_cast<double>(x)) {}
  template <std::integral I>
  ball(I x) : ball(normalised(x < 0, wide<2>(x < 0 ? ~static_cast<uint128>(x) + 1 : static_cast<uint128>(x)), 0, 0)) {}

  /// +-mantissa 2^exponent, to within `radius`.
  template <std::size_t From>
  static ball normalised(bool negative, const wide<From>& mantissa, std::int64_t exponent,
                         double radius) {
    ball r;
    r.radius_ = radius;
    const int length = mantissa.bit_length();
    if (length == 0) return r;
    r.negative_ = negative;
    const int drop = length - bits;
    r.exponent_ = exponent + drop;
    if (drop <= 0) {
      r.mantissa_ = shifted_into<Limbs>(mantissa, -drop);
      return r;
    }
    const auto kept = mantissa >> drop;
    r.mantissa_ = narrowed<Limbs>(kept);
    if ((kept << drop) != mantissa) {
      r.radius_ = detail::radius_above(radius + detail::scaled_above(1, r.exponent_));
    }
    return r;
  }
  static ball within(const ball& middle, double extra) {
    ball r = middle;
    if (extra != 0) r.radius_ = detail::radius_above(r.radius_ + extra);
    return r;
  }
  static ball anything() { return within(ball(), std::numeric_limits<double>::infinity()); }

  bool negative() const { return negative_; }
  bool zero_middle() const { return mantissa_ == mantissa_type{}; }
  double radius() const { return radius_; }
  const mantissa_type& mantissa() const { return mantissa_; }
  std::int64_t exponent() const { return exponent_; }
  ball middle() const {
    ball r = *this;
    r.radius_ = 0;
    return r;
  }
  /// An upper bound of |middle|.
  double size_above() const {
    if (zero_middle()) return 0;
    return detail::scaled_above(static_cast<double>(mantissa_.limb[Limbs - 1]) * (1 + 0x1p-40),
                                exponent_ + bits - 64);
  }
  /// A lower bound of |middle|, 0 where it is too small for binary64.
  double size_below() const {
    if (zero_middle() || exponent_ + bits < -1000) return 0;
    if (exponent_ + bits > 1000) return 0x1p1000;
    return std::ldexp(static_cast<double>(mantissa_.limb[Limbs - 1]) * (1 - 0x1p-40),
                      static_cast<int>(exponent_ + bits - 64));
  }
  /// The nearest binary64 of the middle; below 2^-1000 it is 0.
  double nearest() const {
    if (zero_middle() || exponent_ + bits < -1000) return 0;
    const std::uint64_t top = mantissa_.limb[Limbs - 1];
    bool sticky = false;
    for (std::size_t i = 0; i + 1 < Limbs; ++i) sticky = sticky || mantissa_.limb[i] != 0;
    if (exponent_ + bits > 1024) return negative_ ? -HUGE_VAL : HUGE_VAL;
    const double x = detail::round_to_double(top, sticky, static_cast<int>(exponent_ + bits - 64));
    return negative_ ? -x : x;
  }

  friend ball operator-(const ball& a) {
    ball r = a;
    r.negative_ = !a.negative_ && !a.zero_middle();
    return r;
  }
  friend ball operator+(const ball& a, const ball& b) {
    const double radius =
        a.radius_ + b.radius_ == 0 ? 0 : detail::radius_above(a.radius_ + b.radius_);
    if (a.zero_middle()) return with_radius(b, radius);
    if (b.zero_middle()) return with_radius(a, radius);
    const bool a_first = a.exponent_ >= b.exponent_;
    const ball& high = a_first ? a : b;
    const ball& low = a_first ? b : a;
    const std::int64_t apart = high.exponent_ - low.exponent_;
    if (apart > bits + 64) return within(with_radius(high, radius), low.size_above());
    const auto upper = shifted_into<2 * Limbs + 2>(high.mantissa_, static_cast<int>(apart));
    const wide<2 * Limbs + 2> lower(low.mantissa_);
    if (high.negative_ == low.negative_) {
      return normalised(high.negative_, upper + lower, low.exponent_, radius);
    }
    return upper >= lower ? normalised(high.negative_, upper - lower, low.exponent_, radius)
                          : normalised(low.negative_, lower - upper, low.exponent_, radius);
  }
  friend ball operator-(const ball& a, const ball& b) { return a + -b; }
  friend ball operator*(const ball& a, const ball& b) {
    double radius = 0;
    if (a.radius_ != 0 || b.radius_ != 0) {
      radius = detail::radius_above(product_radius(a, b));
    }
    if (a.zero_middle() || b.zero_middle()) {
      const bool nothing = (a.exactly_zero() && b.radius_ < HUGE_VAL) ||
                           (b.exactly_zero() && a.radius_ < HUGE_VAL);
      return with_radius(ball(), nothing ? 0 : radius);
    }
    return normalised(a.negative_ != b.negative_, product(a.mantissa_, b.mantissa_),
                      a.exponent_ + b.exponent_, radius);
  }
  friend ball operator/(const ball& a, const ball& b) {
    const double least = b.size_below() - b.radius_;
    if (!(least > 0)) return anything();
    // Newton's steps on the quotient; whatever they leave is bounded by the last remainder.
    const double inverse = 1 / b.middle().nearest();
    ball quotient(a.middle().nearest() * inverse);
    ball rest = a.middle() - quotient.middle() * b.middle();
    for (int good = 50; good < bits + 50 && !rest.exactly_zero(); good += 50) {
      quotient = (quotient + ball(rest.nearest() * inverse)).middle();
      rest = a.middle() - quotient * b.middle();
    }
    if (rest.exactly_zero() && a.radius_ == 0 && b.radius_ == 0) return quotient;
    const double off =
        rest.size_above() + rest.radius_ + a.radius_ + quotient.size_above() * b.radius_;
    return within(quotient, detail::radius_above(off / least * (1 + 0x1p-40)));
  }
  ball& operator+=(const ball& b) { return *this = *this + b; }
  ball& operator-=(const ball& b) { return *this = *this - b; }
  ball& operator*=(const ball& b) { return *this = *this * b; }

  /// The square roots of the members that have one.
  friend ball sqrt(const ball& a) {
    const double size = a.size_below();
    if (a.exactly_zero()) return a;
    if (a.negative_ || !(size > a.radius_)) {
      const double most = (a.negative_ ? 0 : a.size_above()) + a.radius_;
      return within(ball(), detail::radius_above(std::sqrt(most) * (1 + 0x1p-40)));
    }
    const double near = std::sqrt(a.middle().nearest());
    const double inverse = 0.5 / near;
    ball root(near);
    ball rest = a.middle() - root * root;
    for (int good = 50; good < bits + 50 && !rest.exactly_zero(); good += 50) {
      root = (root + ball(rest.middle().nearest() * inverse)).middle();
      rest = a.middle() - root * root;
    }
    if (rest.exactly_zero() && a.radius_ == 0) return root;
    const double off = rest.size_above() + rest.radius_ + a.radius_;
    return within(root, detail::radius_above(off / root.size_below() * (1 + 0x1p-40)));
  }

  friend known operator<(const ball& a, const ball& b) {
    const ball d = a - b;
    if (d.exactly_zero()) return known::no;
    if (!(d.size_below() > d.radius_)) {
      return d.radius_ == 0 ? (d.negative_ ? known::yes : known::no) : known::unknown;
    }
    return d.negative_ ? known::yes : known::no;
  }
  friend known operator>(const ball& a, const ball& b) { return b < a; }
  friend known operator<=(const ball& a, const ball& b) { return negated(b < a); }
  friend known operator>=(const ball& a, const ball& b) { return negated(a < b); }
  friend known operator==(const ball& a, const ball& b) {
    const ball d = a - b;
    if (d.exactly_zero()) return known::yes;
    return d.radius_ == 0 || d.size_below() > d.radius_ ? known::no : known::unknown;
  }
  friend known operator!=(const ball& a, const ball& b) { return negated(a == b); }

  bool exactly_zero() const { return radius_ == 0 && zero_middle(); }

  /// Both where it is unknown which.
  friend ball select(known mask, const ball& a, const ball& b) {
    if (mask != known::unknown) return mask == known::yes ? a : b;
    const ball apart = b - a;
    const double reach = apart.size_above() + apart.radius_ + a.radius_ + b.radius_;
    return reach == 0 ? a : within(a.middle(), detail::radius_above(reach));
  }
  friend known not_a_number(const ball&) { return known::no; }
  /// A guess by the middle: enough where both answers are right.
  friend bool leans_negative(const ball& a) { return a.negative_; }

 private:
  static known negated(known k) {
    return k == known::unknown ? k : k == known::yes ? known::no : known::yes;
  }
  static ball with_radius(const ball& a, double radius) {
    ball r = a;
    r.radius_ = radius;
    return r;
  }
  static double product_radius(const ball& a, const ball& b) {
    // 0 times infinity is unknown, not 0: such a product is NaN, which radius_above takes so.
    return a.size_above() * b.radius_ + b.size_above() * a.radius_ + a.radius_ * b.radius_;
  }
  /// The full product; low limbs of zeros, as small data have, cost nothing.
  static wide<2 * Limbs> product(const mantissa_type& a, const mantissa_type& b) {
    wide<2 * Limbs> r;
    std::size_t from = 0;
    while (b.limb[from] == 0) ++from;
    for (std::size_t i = 0; i < Limbs; ++i) {
      if (a.limb[i] == 0) continue;
      std::uint64_t carry = 0;
      for (std::size_t j = from; j < Limbs; ++j) {
        const uint128 sum = static_cast<uint128>(a.limb[i]) * b.limb[j] + r.limb[i + j] + carry;
        r.limb[i + j] = static_cast<std::uint64_t>(sum);
        carry = static_cast<std::uint64_t>(sum >> 64);
      }
      r.limb[i + Limbs] = carry;
    }
    return r;
  }
  /// a 2^shift in To limbs; the caller promises that it fits.
  template <std::size_t To, std::size_t From>
  static wide<To> shifted_into(const wide<From>& a, int shift) {
    if constexpr (To >= From) {
      wide<To> r;
      for (std::size_t i = 0; i < From; ++i) r.limb[i] = a.limb[i];
      return r << shift;
    } else {
      return narrowed<To>(a << shift);
    }
  }

  mantissa_type mantissa_{};  ///< its highest bit is set, or it is 0
  double radius_ = 0;
  std::int64_t exponent_ = 0;
  bool negative_ = false;
};

/// The binary64 nearest to every member, if that is one and the same; below 2^-1000 that is 0.
template <std::size_t Limbs>
std::optional<double> decided(const ball<Limbs>& a) {
  if (a.radius() == 0) return a.nearest();
  if (!(a.radius() < 0x1p1000)) return std::nullopt;
  const double low = (a.middle() - ball<Limbs>(a.radius())).nearest();
  const double high = (a.middle() + ball<Limbs>(a.radius())).nearest();
  if (low == high) return low;
  return std::nullopt;
}

}  // namespace bitshade
