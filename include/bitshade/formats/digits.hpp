// The digits of a number as they were written, of any count, kept without turning them into binary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitshade/formats/natural.hpp"

namespace bitshade {

/// An integer of decimal or hexadecimal digits, the first digit not 0: reading one more digit, multiplying by a small
/// factor and taking the leading digits all take linear time.
class digits {
 public:
  /// Limbs that hold every digit which can decide alone: 48 of them have at least 847 decimal digits, even after a
  /// multiplication whose carry is a limb of one digit.
  ///
  /// What a rounding compares with, ties and the borders of 64 random bits, is m 2^-s with m < 2^118 and, in binary64,
  /// s <= 1074 + 64: an integer m 5^s of fewer than log10(2^118) + 1138 log10 5 + 1 < 832 digits before its power of
  /// ten. Whatever follows the first 832 digits of a number can only tell whether it lies above such a border.
  static constexpr std::size_t deciding = 48;

  constexpr digits() = default;
  constexpr explicit digits(bool hexadecimal)
      : radix_(hexadecimal ? 16 : 10),
        base_(hexadecimal ? std::uint64_t{1} << 60 : 1'000'000'000'000'000'000u),
        digits_a_limb_(hexadecimal ? 15 : 18) {}

  constexpr bool is_zero() const { return limbs_.empty() && pending_ == 0; }
  constexpr bool is_hexadecimal() const { return radix_ == 16; }

  constexpr void append(unsigned digit) {
    if (is_zero() && digit == 0) return;
    pending_ = pending_ * radix_ + digit;
    if (++pending_digits_ == digits_a_limb_) {
      limbs_.push_back(pending_);
      pending_ = 0;
      pending_digits_ = 0;
    }
  }

  /// *this * factor, for a factor below 2^64.
  constexpr void multiply(std::uint64_t factor) {
    const std::uint64_t unit = power(pending_digits_);
    uint128 product = uint128{pending_} * factor;
    pending_ = static_cast<std::uint64_t>(product % unit);
    uint128 carry = product / unit;
    for (std::size_t i = limbs_.size(); i-- > 0;) {
      product = uint128{limbs_[i]} * factor + carry;
      limbs_[i] = static_cast<std::uint64_t>(product % base_);
      carry = product / base_;
    }
    for (; carry != 0; carry /= base_) limbs_.insert(limbs_.begin(), static_cast<std::uint64_t>(carry % base_));
  }

  /// The leading limbs as a number n; the whole is n radix^dropped, and something below n's last digit if cut.
  struct leading_part {
    natural n{0};
    std::int64_t dropped = 0;
    bool cut = false;
  };
  constexpr leading_part leading(std::size_t count = deciding) const {
    leading_part part;
    const std::size_t taken = count < limbs_.size() ? count : limbs_.size();
    for (std::size_t i = 0; i < taken; ++i) part.n.multiply_add(base_, limbs_[i]);
    if (taken == limbs_.size()) {
      part.n.multiply_add(power(pending_digits_), pending_);
      return part;
    }
    part.dropped = pending_digits_;
    part.cut = pending_ != 0;
    for (std::size_t i = taken; i < limbs_.size(); ++i) {
      part.dropped += digits_a_limb_;
      part.cut = part.cut || limbs_[i] != 0;
    }
    return part;
  }
  constexpr leading_part whole() const { return leading(limbs_.size()); }

 private:
  constexpr std::uint64_t power(int n) const {
    std::uint64_t p = 1;
    for (; n > 0; --n) p *= radix_;
    return p;
  }

  std::vector<std::uint64_t> limbs_;  ///< the first highest, all of them full
  std::uint64_t pending_ = 0;         ///< the last digits, too few for a limb
  int pending_digits_ = 0;
  std::uint64_t radix_ = 10, base_ = 1'000'000'000'000'000'000u;
  int digits_a_limb_ = 18;
};

}  // namespace bitshade
