// Just enough arithmetic of natural numbers to read a number of any length exactly, at compile time too.
#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "bitshade/formats/wide_integer.hpp"

namespace bitshade {

/// A natural number, 64 bits a limb, lowest first, without leading zero limbs.
class natural {
 public:
  constexpr natural() = default;
  constexpr explicit natural(std::uint64_t x) {
    if (x != 0) limbs_.push_back(x);
  }

  constexpr bool is_zero() const { return limbs_.empty(); }
  constexpr std::int64_t width() const {
    return limbs_.empty() ? 0 : 64 * static_cast<std::int64_t>(limbs_.size()) - std::countl_zero(limbs_.back());
  }

  /// *this * factor + term.
  constexpr void multiply_add(std::uint64_t factor, std::uint64_t term) {
    std::uint64_t carry = term;
    for (std::uint64_t& limb : limbs_) {
      const uint128 sum = uint128{limb} * factor + carry;
      limb = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    if (carry != 0) limbs_.push_back(carry);
    trim();
  }

  /// *this * 5^n.
  constexpr void multiply_power_of_5(std::int64_t n) {
    constexpr std::uint64_t five_27 = 7450580596923828125u;
    for (; n >= 27; n -= 27) multiply_add(five_27, 0);
    std::uint64_t rest = 1;
    for (; n > 0; --n) rest *= 5;
    multiply_add(rest, 0);
  }

  constexpr void shift_left(std::int64_t n) {
    if (n <= 0 || is_zero()) return;
    const auto whole = static_cast<std::size_t>(n / 64);
    const int part = static_cast<int>(n % 64);
    if (part != 0) multiply_add(std::uint64_t{1} << part, 0);
    limbs_.insert(limbs_.begin(), whole, 0);
  }

  constexpr bool less_than(const natural& b) const {
    if (limbs_.size() != b.limbs_.size()) return limbs_.size() < b.limbs_.size();
    for (std::size_t i = limbs_.size(); i-- > 0;) {
      if (limbs_[i] != b.limbs_[i]) return limbs_[i] < b.limbs_[i];
    }
    return false;
  }

  /// *this - b, where b is not greater.
  constexpr void subtract(const natural& b) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      const uint128 take = uint128{i < b.limbs_.size() ? b.limbs_[i] : 0} + borrow;
      borrow = limbs_[i] < take ? 1 : 0;
      limbs_[i] = static_cast<std::uint64_t>(limbs_[i] - take);
    }
    trim();
  }

 private:
  constexpr void trim() {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  }
  std::vector<std::uint64_t> limbs_;
};

/// n 2^exponent, and something below n's last bit if sticky: 128 leading bits of a positive number.
struct leading_bits {
  uint128 n = 0;
  std::int64_t exponent = 0;
  bool sticky = false;
};

/// The leading bits of a / b, both positive, by schoolbook division.
constexpr leading_bits divide(natural a, natural b) {
  const std::int64_t shift = a.width() - b.width();
  b.shift_left(shift);
  a.shift_left(-shift);
  // a / b now lies in (1/2, 2): at most 129 steps give 128 bits.
  leading_bits q{0, shift + 1, false};
  while ((q.n >> 127) == 0) {
    if (a.is_zero()) return q;
    q.n <<= 1;
    q.exponent -= 1;
    if (!a.less_than(b)) {
      a.subtract(b);
      q.n |= 1;
    }
    a.shift_left(1);
  }
  q.sticky = !a.is_zero();
  return q;
}

}  // namespace bitshade
