// The generator of stochastic rounding in vectors: the same words as rounding_stream's in formats/random.hpp, which
// kernels may not call, since it is inline and compiled elsewhere with fewer instructions.
#pragma once

#include <cstddef>

#include "bulk/plan.hpp"

namespace bitshade::bulk_kernels {

/// Random bits for 32 numbers at a time, from a counter that 32 divides: the upper 32 bits for binary32 lanes, all 64
/// for binary64 ones. The first 16 numbers and the second share half of the work.
template <class V>
class random_block {
  using i = typename V::i;
  static i both(std::uint32_t w) { return V::words(w, w); }

 public:
  static constexpr std::size_t numbers = 32;
  static constexpr std::size_t parts = 16 / V::width;  ///< vectors in half a block

  /// Before that block's numbers, counted from the one that holds the plan's counter.
  [[gnu::always_inline]] explicit random_block(const plan& p, std::size_t block = 0)
      : middle_(V::words(p.random_middle[0], p.random_middle[1])), stride_(both(p.random_weyl * 16)) {
    for (int k = 0; k < 3; ++k) factor_[k] = both(p.random_factors[k]);
    const i weyl = both(p.random_weyl);
    const i start = V::words(p.random_start[0], p.random_start[1]);
    for (std::size_t k = 0; k < parts; ++k) {
      const auto place = static_cast<std::uint32_t>(16 * block + k * V::width);
      const i step = V::word_add(V::lane_numbers(), both(p.random_step + place));
      place_[k] = V::word_add(start, V::word_multiply(step, weyl));
    }
  }

  /// Goes on to the next 32 numbers, at first to the first.
  [[gnu::always_inline]] void draw() {
    for (std::size_t k = 0; k < parts; ++k) {
      const i z = V::word_multiply(V::xor_(place_[k], V::template word_shift<16>(place_[k])), factor_[0]);
      mixed_[k] = V::xor_(V::xor_(z, V::template word_shift<15>(z)), middle_);
      place_[k] = V::word_add(place_[k], stride_);
    }
  }

  /// Of the block's k-th vector.
  [[gnu::always_inline]] i bits(std::size_t k) const {
    if (k < parts) return V::word_multiply(mixed_[k], factor_[1]);
    return V::word_multiply(V::word_reverse(mixed_[k - parts]), factor_[2]);
  }

 private:
  i middle_, stride_, factor_[3], place_[parts], mixed_[parts];
};

}  // namespace bitshade::bulk_kernels
