// The operations as MPFR does them: exact, or truncated and made odd, then rounded by the rounder.
#pragma once

#include <vector>

#include "support/mpfr_oracle.hpp"

namespace oracle {

enum class operation { add, subtract, multiply, divide, square_root, fma };

/// One operation on the bits of a format, for any direction and policy.
class calculator {
 public:
  explicit calculator(const bitshade::encoding& e) : e_(e), rounder_(e) {}

  /// Fixes the exact result of a op b (op c).
  void compute(operation op, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);
  std::uint64_t bits(const bitshade::rules& r);

 private:
  void compute_steps(operation op);

  bitshade::encoding e_;
  rounder rounder_;
  // A product of numbers of a format, and its sum with another, fit in 4600 bits even in binary64.
  number a_{64}, b_{64}, c_{128}, exact_{320}, wide_{4600};
  bool zero_of_unlike_signs_ = false, nan_ = false;
};

/// What bitshade gives for the same operation, by operations.hpp.
std::uint64_t computed(operation op, const bitshade::encoding& e, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                       const bitshade::rules& r);

/// Codes where rules change: zeros, subnormal and normal ends, powers of two, ones, halves, largest, infinity, NaN.
std::vector<std::uint64_t> boundary_codes(const bitshade::encoding& e);

}  // namespace oracle
