// Rounding as MPFR does it: the independent word on what encode and the operations must give.
#pragma once

#include <mpfr.h>

#include <cstdint>
#include <string>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"

namespace oracle {

/// An MPFR number that cleans up after itself.
class number {
 public:
  explicit number(mpfr_prec_t precision = 320) { mpfr_init2(x_, precision); }
  number(const number&) = delete;
  number& operator=(const number&) = delete;
  ~number() { mpfr_clear(x_); }
  operator mpfr_ptr() { return x_; }
  operator mpfr_srcptr() const { return x_; }

 private:
  mpfr_t x_;
};

/// An exact real number between or on the steps of a format.
///
/// Steps are rounded by mpfr_rint and its kin; all that this adds is where a format's steps lie, counted
/// from the definition of its bits.
class rounder {
 public:
  explicit rounder(const bitshade::encoding& e) : e_(e) {}

  /// Fixes x (exact; more bits of it than MPFR's precision must have been made odd, see make_odd).
  void set(mpfr_srcptr x);
  /// The same for a norm, x counting its steps.
  void set_steps(mpfr_srcptr x);
  /// The integer of steps that x becomes; stochastic rounding looks at `random_bits` leading bits of `random`.
  void round(bitshade::rounding direction, std::uint64_t random = 0, int random_bits = 64);
  /// The bits of what was rounded, for each policy of subnormals and overflow.
  std::uint64_t bits(bool flush, bitshade::overflow policy) const;
  /// Both at once.
  std::uint64_t bits(bitshade::rounding direction, bool flush, bitshade::overflow policy) {
    round(direction);
    return bits(flush, policy);
  }

 private:
  bitshade::encoding e_;
  number steps_, rounded_, rest_;
  bitshade::rounding direction_ = bitshade::rounding::nearest_even;
  std::uint64_t count_ = 0;  ///< the rounded steps; all ones from 2^64 on
  bool huge_ = false;
  long ulp_ = 0;
  bool nan_ = false, negative_ = false, infinite_ = false;
};

/// Turns a result that MPFR truncated (ternary != 0) into one that no direction takes for exact.
void make_odd(mpfr_ptr x, int ternary);

/// The value of bits, from the definition, without decode.
void value(mpfr_ptr x, const bitshade::encoding& e, std::uint64_t bits);

std::string hex(std::uint64_t bits);

}  // namespace oracle
